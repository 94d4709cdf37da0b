#include "surface/density.h"

#include "base/elementary.h"
#include "base/status.h"
#include "surface/tagged_edges.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double least_curvature = 1, greatest_curvature = 256;  // in units of 1 / diagonal
constexpr double least_density = 1e-12;                          // of the greatest one
constexpr double least_line_density = 1e-6, greatest_line_density = 1e12;

/// Calls visit(h) for each halfedge out of the origin of `first`, which starts a wedge, within that wedge.
template <class Visit>
void visit_wedge(const Surface& surface, HalfedgeId first, Visit visit) {
  HalfedgeId h = first;
  do {
    visit(h);
    h = surface.mesh.turn_left(h);
  } while (!h.is_none() && h != first && surface.line[h] == line_none);
}

/// A wedge starts at a line, or at `outgoing` where the vertex has none.
bool starts_wedge(const Surface& surface, HalfedgeId h) {
  if (surface.line[h] != line_none) return true;
  return surface.mesh.outgoing[surface.mesh.origin[h]] == h && wedge_start(surface, h) == h;
}

/// What one face gives to the operator at the origin of `h`.
struct CurvaturePart {
  Vec3 normal;  // half the sum of cotangents times edges
  Vec3 area_normal;
  double mixed_area;
};

CurvaturePart curvature_part(const Surface& surface, HalfedgeId h) {
  const Vec3 p = surface.position(surface.mesh.origin[h]);
  const Vec3 to_q = surface.position(surface.mesh.target(h)) - p;
  const Vec3 to_r = surface.position(surface.mesh.apex(h)) - p;
  const Vec3 along = to_r - to_q;
  const Vec3 normal = cross(to_q, to_r);
  const double twice_area = length(normal);
  const double cosine_p = dot(to_q, to_r), cosine_q = -dot(to_q, along), cosine_r = dot(to_r, along);
  const double cot_q = cosine_q / twice_area, cot_r = cosine_r / twice_area;
  CurvaturePart part{0.5 * (cot_r * to_q + cot_q * to_r), normal, 0};
  if (cosine_p < 0) {
    part.mixed_area = twice_area / 4;
  } else if (cosine_q < 0 || cosine_r < 0) {
    part.mixed_area = twice_area / 8;
  } else {
    part.mixed_area = (cot_r * dot(to_q, to_q) + cot_q * dot(to_r, to_r)) / 8;
  }
  return part;
}

double wedge_mean_curvature(const Surface& surface, HalfedgeId first) {
  CurvaturePart sum{{0, 0, 0}, {0, 0, 0}, 0};
  visit_wedge(surface, first, [&](HalfedgeId h) {
    const CurvaturePart part = curvature_part(surface, h);
    sum.normal = sum.normal + part.normal;
    sum.area_normal = sum.area_normal + part.area_normal;
    sum.mixed_area += part.mixed_area;
  });
  const double scale = length(sum.area_normal) * sum.mixed_area;
  return scale > 0 ? 0.5 * absolute(dot(sum.normal, sum.area_normal)) / scale : 0;
}

void fill_curvature(Surface& surface, HalfedgeId h, double scale, double gamma) {
  if (!starts_wedge(surface, h)) return;
  const double x = greater(least_curvature, smaller(greatest_curvature, scale * wedge_mean_curvature(surface, h)));
  const float d = static_cast<float>(power(x, gamma));
  visit_wedge(surface, h, [&](HalfedgeId w) { surface.wedge_density[w] = d; });
}

bool is_positive(double d) { return d > 0 && d < 1e300; }

/// The greatest of the densities that the caller gives, all of which must be positive.
Status find_greatest_given(const Surface& surface, double& greatest) {
  const double* at_vertex = surface.view->vertex_density;
  const double* at_corner = surface.view->corner_density;
  if (at_vertex == nullptr && at_corner == nullptr) return fail(Status::invalid_option, Element::option, 3);
  greatest = 0;
  if (at_corner != nullptr) {
    for (std::uint32_t source : surface.source_face) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = at_corner[3 * std::size_t{source} + k];
        if (!is_positive(d)) return fail(Status::density_not_positive, Element::triangle, source);
        greatest = greater(greatest, d);
      }
    }
    return {};
  }
  for (std::uint32_t source : surface.source_vertex) {
    const double d = at_vertex[source];
    if (!is_positive(d)) return fail(Status::density_not_positive, Element::vertex, source);
    greatest = greater(greatest, d);
  }
  return {};
}

/// A linear function on a triangle of the caller's, at a point of its plane; a point outside takes the nearest bounds.
double linear_at(const Vec3 (&corner)[3], const double* value, Vec3 p) {
  const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double w = greater(0, dot(normal, cross(corner[(k + 1) % 3] - p, corner[(k + 2) % 3] - p)));
    sum += w * value[k];
    weights += w;
  }
  return weights > 0 ? sum / weights : (value[0] + value[1] + value[2]) / 3;
}

/// What the caller gives at the origin of `h`, in its triangle. Welding may have replaced the vertex by one at the same
/// place, and the mending of a flat triangle may have put it on a side of the triangle.
double given_density_at(const Surface& surface, HalfedgeId h) {
  const MeshView& view = *surface.view;
  const std::uint32_t vertex = surface.source_vertex[surface.mesh.origin[h]];
  if (view.corner_density == nullptr) return view.vertex_density[vertex];
  const std::size_t first = 3 * std::size_t{surface.source_face[face(h)]};
  const double* const value = view.corner_density + first;
  const Vec3 p = read_position(view, vertex);
  Vec3 corner[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t v = read_index(view, first + k);
    corner[k] = read_position(view, v);
    if (v == vertex || distance(corner[k], p) == 0) return value[k];
  }
  return linear_at(corner, value, p);
}

/// The corners of a wedge take their mean, weighted by area.
void unite_wedge(Surface& surface, HalfedgeId h) {
  if (!starts_wedge(surface, h)) return;
  double mass = 0, area = 0, sum = 0, count = 0;
  visit_wedge(surface, h, [&](HalfedgeId w) {
    const double a = face_area(surface, face(w)), d = surface.density(w);
    mass += a * d, area += a, sum += d, count += 1;
  });
  const float mean = static_cast<float>(area > 0 ? mass / area : sum / count);
  visit_wedge(surface, h, [&](HalfedgeId w) { surface.wedge_density[w] = mean; });
}

/// Fills `given_line_density`, in units of `unit`; left empty where none is given.
Status take_line_densities(Surface& surface, double unit, Arena& arena) {
  const MeshView& view = *surface.view;
  surface.given_line_density = {};
  if (view.tagged_edge_density == nullptr || view.tagged_edge_count == 0) return {};
  for (std::size_t e = 0; e < view.tagged_edge_count; ++e) {
    const double d = view.tagged_edge_density[e];
    if (d != 0 && !is_positive(d)) return fail(Status::density_not_positive, Element::edge, e);
  }
  ISOLOD_TRY(arena.result(surface.mesh.halfedge_count(), surface.given_line_density));
  for (float& d : surface.given_line_density) d = 0;
  const ScratchScope scope(arena);
  TaggedEdges edges;
  ISOLOD_TRY(edges.begin(surface, arena));
  for (std::size_t e = 0; e < view.tagged_edge_count; ++e) {
    const double given = view.tagged_edge_density[e] / unit;
    const double clamped = smaller(greatest_line_density, greater(least_line_density, given));
    const float d = given > 0 ? static_cast<float>(clamped) : 0.0f;
    edges.visit_between(surface, view.tagged_edges[2 * e], view.tagged_edges[2 * e + 1],
                        [&](HalfedgeId h) { surface.given_line_density[h] = d; });
  }
  return {};
}

float mean_of_corners(const Surface& surface, FaceId f) {
  const double sum =
      surface.density(halfedge(f, 0)) + surface.density(halfedge(f, 1)) + surface.density(halfedge(f, 2));
  return static_cast<float>(sum / 3);
}

/// One pass of the low-pass at a wedge: the mean over its faces, weighted by area.
void spread_means(Surface& surface, HalfedgeId h, Span<const float> face_mean) {
  if (!starts_wedge(surface, h)) return;
  double mass = 0, area = 0;
  visit_wedge(surface, h, [&](HalfedgeId w) {
    const double a = face_area(surface, face(w));
    mass += a * static_cast<double>(face_mean[face(w)]);
    area += a;
  });
  const float mean = static_cast<float>(mass / area);
  visit_wedge(surface, h, [&](HalfedgeId w) { surface.wedge_density[w] = mean; });
}

}  // namespace

std::uint32_t undersampling_passes(std::size_t input_count, std::uint32_t vertex_count) {
  constexpr std::size_t passes_a_ratio = 10, most_passes = 200;
  if (input_count <= vertex_count) return 0;
  const std::size_t passes = passes_a_ratio * (input_count - vertex_count) / vertex_count;
  return static_cast<std::uint32_t>(passes < most_passes ? passes : most_passes);
}

Status FindDensity::begin(Surface& surface, const DensityOptions& options, Arena& arena) {
  options_ = options;
  phase_ = Phase::done;
  sweep_ = {};
  pass_ = 0;
  mark_ = arena.mark();
  surface.wedge_density = {};
  const bool is_given = options.source == DensitySource::given;
  if (is_given) ISOLOD_TRY(find_greatest_given(surface, scale_));
  ISOLOD_TRY(take_line_densities(surface, is_given ? square_root(scale_) : 1, arena));
  if (options.source == DensitySource::uniform) return {};
  if (!is_given) scale_ = diagonal(surface);
  ISOLOD_TRY(arena.result(surface.mesh.halfedge_count(), surface.wedge_density));
  phase_ = Phase::fill;
  return options.smoothing_passes == 0 ? Status() : arena.scratch(surface.mesh.face_count(), face_mean_);
}

void FindDensity::fill(Surface& surface, HalfedgeId h) const {
  if (options_.source == DensitySource::curvature) return fill_curvature(surface, h, scale_, options_.gamma);
  surface.wedge_density[h] = static_cast<float>(greater(given_density_at(surface, h) / scale_, least_density));
}

void FindDensity::step(Surface& surface, Arena& arena) {
  const std::size_t halfedges = surface.mesh.halfedge_count(), faces = surface.mesh.face_count();
  switch (phase_) {
    case Phase::fill:
      if (!sweep_.over<HalfedgeId>(halfedges, [&](HalfedgeId h) { fill(surface, h); })) return;
      phase_ = Phase::unite;
      if (options_.source == DensitySource::given && surface.view->corner_density != nullptr) return;
      break;
    case Phase::unite:
      if (!sweep_.over<HalfedgeId>(halfedges, [&](HalfedgeId h) { unite_wedge(surface, h); })) return;
      break;
    case Phase::mean:
      if (sweep_.over<FaceId>(faces, [&](FaceId f) { face_mean_[f] = mean_of_corners(surface, f); })) {
        phase_ = Phase::spread;
      }
      return;
    case Phase::spread:
      if (!sweep_.over<HalfedgeId>(halfedges, [&](HalfedgeId h) { spread_means(surface, h, face_mean_); })) return;
      ++pass_;
      break;
    case Phase::done:
      return;
  }
  phase_ = pass_ < options_.smoothing_passes ? Phase::mean : Phase::done;
  if (done()) arena.rewind_scratch(mark_);
}

Status find_density(Surface& surface, const DensityOptions& options, Arena& arena) {
  const ScratchScope scope(arena);
  FindDensity stage;
  ISOLOD_TRY(stage.begin(surface, options, arena));
  while (!stage.done()) stage.step(surface, arena);
  return {};
}

}  // namespace v1
}  // namespace isolod
