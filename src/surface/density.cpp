#include "surface/density.h"

#include "base/elementary.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double least_curvature = 1, greatest_curvature = 256;  // in units of 1 / diagonal

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

/// The greatest of the densities that the caller gives, all of which must be positive.
Status find_greatest_given(const Surface& surface, double& greatest) {
  const double* given = surface.view->vertex_density;
  if (given == nullptr) return fail(Status::invalid_option, Element::option, 3);  // Options::density
  greatest = 0;
  for (std::uint32_t source : surface.source_vertex) {
    const double d = given[source];
    if (!(d > 0) || !(d < 1e300)) return fail(Status::density_not_positive, Element::vertex, source);
    greatest = greater(greatest, d);
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
  if (options.source == DensitySource::uniform) return {};
  if (options.source == DensitySource::given) {
    ISOLOD_TRY(find_greatest_given(surface, scale_));
  } else {
    scale_ = diagonal(surface);
  }
  ISOLOD_TRY(arena.result(surface.mesh.halfedge_count(), surface.wedge_density));
  phase_ = Phase::fill;
  return options.smoothing_passes == 0 ? Status() : arena.scratch(surface.mesh.face_count(), face_mean_);
}

void FindDensity::fill(Surface& surface, HalfedgeId h) const {
  if (options_.source == DensitySource::curvature) return fill_curvature(surface, h, scale_, options_.gamma);
  const double relative = surface.view->vertex_density[surface.source_vertex[surface.mesh.origin[h]]] / scale_;
  surface.wedge_density[h] = static_cast<float>(greater(relative, 1e-12));
}

void FindDensity::step(Surface& surface, Arena& arena) {
  const std::size_t halfedges = surface.mesh.halfedge_count(), faces = surface.mesh.face_count();
  switch (phase_) {
    case Phase::fill:
      if (!sweep_.over<HalfedgeId>(halfedges, [&](HalfedgeId h) { fill(surface, h); })) return;
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
