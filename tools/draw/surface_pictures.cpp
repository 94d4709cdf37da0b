#include "draw/surface_pictures.h"

#include <algorithm>
#include <cmath>

#include "draw/page.h"
#include "draw/sample_spots.h"

namespace draw {

namespace {

using isolod::Surface;

std::string triangles_text(std::size_t count) { return grouped(count) + " triangles"; }

}  // namespace

bool draw_original(const std::string& file, const Frame& frame, const Surface& surface) {
  const Model model = lightened(model_of(surface), most_drawn_faces);
  Page page(frame, model, "Original: " + triangles_text(surface.mesh.face_count()), FeatureLines::legend(surface));
  const FeatureLines features(page.view(), surface);
  draw_faces(page.svg(), page.view(), plain_look(page.view(), 0));
  draw_outline(page.svg(), page.view());
  features.draw(page.svg(), 1.8);
  features.draw_corners(page.svg(), 6);
  return page.write(file);
}

bool draw_charts(const std::string& file, const Frame& frame, const Surface& surface, const isolod::Atlas& atlas) {
  const Model model = lightened(model_of(surface), most_drawn_faces);
  std::vector<LegendItem> legend = FeatureLines::legend(surface);
  legend.insert(legend.begin(), LegendItem{Mark::line, palette::seam, "seam"});
  Page page(frame, model, "Charts: " + grouped(atlas.chart_count()), legend);
  const View& view = page.view();
  const std::vector<std::uint32_t> colour = colour_charts(surface, atlas);
  FaceLook look;
  look.colour = [&](std::size_t f) {
    return lit(chart_colour(colour[atlas.chart_of_face[model.source[f]]]), 0.28 + 0.72 * view.light(f));
  };
  draw_faces(page.svg(), view, look);
  draw_outline(page.svg(), view);
  seam_lines(view, surface).draw(page.svg(), palette::seam, 1.0);
  const FeatureLines features(view, surface);
  features.draw(page.svg(), 1.8);
  features.draw_corners(page.svg(), 6);
  return page.write(file);
}

bool draw_samples(const std::string& file, const Frame& frame, const isolod::SampledSurface& samples,
                  std::size_t wished) {
  const Surface& surface = *samples.surface;
  const Model model = lightened(model_of(surface), most_drawn_faces);
  const std::size_t nodes = samples.numbers.node_count, lines = samples.numbers.line_count;
  const std::size_t count = nodes + lines + samples.places.count;
  const std::string title = count < wished ? "Samples of the coarsest level: " : "Samples: ";
  Page page(frame, model, title + grouped(count), SampleSpots::legend(samples));
  const SampleSpots spots(page.view(), samples, samples.places);
  draw_faces(page.svg(), page.view(), plain_look(page.view(), 0.45));
  draw_outline(page.svg(), page.view());
  seam_lines(page.view(), surface).draw(page.svg(), palette::faint, 0.7);
  const double diameter = std::clamp(0.4 * frame.camera.scale * spacing_of(model, count), 1.2, 6.5);
  spots.draw(page.svg(), diameter);
  return page.write(file);
}

bool draw_result(const std::string& file, const Frame& frame, const Model& result) {
  const Model model = lightened(result, most_drawn_faces);
  Page page(frame, model,
            "Result: " + grouped(result.point.size()) + " vertices, " + triangles_text(result.face.size()), {});
  FaceLook look = plain_look(page.view(), 0);
  const double spacing = frame.camera.scale * spacing_of(result, result.point.size());
  look.edge_width = std::clamp(0.045 * spacing, 0.1, 0.6);
  look.edge = mix(palette::outline, palette::clay, 0.3);
  draw_faces(page.svg(), page.view(), look);
  draw_outline(page.svg(), page.view());
  return page.write(file);
}

namespace {

struct Irregular {
  std::vector<std::uint32_t> five, seven, other;
};

/// By the number of edges at a vertex less that of a regular one: 6, on a boundary 4.
Irregular find_irregular(const Model& model) {
  std::vector<int> faces(model.point.size(), 0), open(model.point.size(), 0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const std::array<std::uint32_t, 3>& face : model.face) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++faces[face[k]];
      edges.emplace_back(std::min(face[k], face[(k + 1) % 3]), std::max(face[k], face[(k + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool is_single = (i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]);
    if (is_single) ++open[edges[i].first], ++open[edges[i].second];
  }
  Irregular found;
  for (std::uint32_t v = 0; v < model.point.size(); ++v) {
    const int excess = open[v] > 0 ? faces[v] - 3 : faces[v] - 6;
    if (excess == -1)
      found.five.push_back(v);
    else if (excess == 1)
      found.seven.push_back(v);
    else if (excess != 0)
      found.other.push_back(v);
  }
  return found;
}

bool has_thin_corner(const Model& model, std::size_t f) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = model.corner(f, (k + 1) % 3) - model.corner(f, k),
               b = model.corner(f, (k + 2) % 3) - model.corner(f, k);
    if (dot(a, b) > 0.8660254037844387 * length(a) * length(b)) return true;
  }
  return false;
}

void draw_vertices(Page& page, const std::vector<std::uint32_t>& vertices, Colour colour, double diameter) {
  SurfaceSpots spots(page.view());
  for (std::uint32_t v : vertices) {
    if (page.view().may_show_vertex(v)) spots.add(page.view().model().point[v]);
  }
  spots.draw(page.svg(), colour, diameter, 0.3);
}

}  // namespace

bool draw_valence(const std::string& file, const Frame& frame, const Model& result) {
  const Irregular irregular = find_irregular(result);
  const auto count = [](const auto& list) { return grouped(list.size()); };
  std::vector<std::uint8_t> thin(result.face.size(), 0);
  std::size_t thin_count = 0;
  for (std::size_t f = 0; f < thin.size(); ++f) thin_count += thin[f] = has_thin_corner(result, f);
  Page page(frame, result, "Irregular vertices",
            {{Mark::spot, palette::five, count(irregular.five) + " of valence 5"},
             {Mark::spot, palette::seven, count(irregular.seven) + " of valence 7"},
             {Mark::spot, palette::corner, count(irregular.other) + " others"},
             {Mark::area, palette::thin, grouped(thin_count) + " triangles with an angle under 30°"}});
  const View& view = page.view();
  FaceLook look;
  look.colour = [&](std::size_t f) {
    return thin[f] ? lit(palette::thin, 0.5 + 0.3 * view.light(f))
                   : mix(lit(palette::clay, view.light(f)), palette::paper, 0.5);
  };
  const double spacing = frame.camera.scale * spacing_of(result, result.point.size());
  look.edge_width = std::clamp(0.05 * spacing, 0.1, 0.6);
  look.edge = rgb(0x9aa3b0);
  draw_faces(page.svg(), view, look);
  draw_outline(page.svg(), view);
  const double diameter = std::clamp(0.5 * spacing, 1.8, 8.0);
  draw_vertices(page, irregular.five, palette::five, diameter);
  draw_vertices(page, irregular.seven, palette::seven, diameter);
  draw_vertices(page, irregular.other, palette::corner, diameter);
  return page.write(file);
}

}  // namespace draw
