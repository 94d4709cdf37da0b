#include "draw/sample_spots.h"

#include <algorithm>

#include "draw/page.h"
#include "sample/samples.h"

namespace draw {

using isolod::Surface;

Vec3 line_place(const isolod::SampledSurface& samples, const isolod::LinePlace& place) {
  const isolod::HalfedgeId h = samples.backbones->edge[place.edge];
  const Vec3 a = samples.surface->position(samples.surface->mesh.origin[h]);
  return a + place.along * (samples.surface->position(samples.surface->mesh.target(h)) - a);
}

SampleSpots::SampleSpots(const View& view, const isolod::SampledSurface& samples,
                         isolod::Span<const isolod::SurfacePlace> places)
    : corner_(view), feature_(view), seam_(view), inner_(view) {
  const Surface& surface = *samples.surface;
  for (const isolod::VertexId v : samples.backbones->node) {
    if (view.may_show_vertex(v.value)) (surface.corner[v] ? corner_ : seam_).add(surface.position(v));
  }
  for (std::size_t b = 0; b < samples.backbones->count(); ++b) {
    SurfaceSpots& spots = is_feature(surface, *samples.backbones, b) ? feature_ : seam_;
    for (std::size_t i = samples.lines->start[b]; i < samples.lines->start[b + 1]; ++i) {
      const isolod::LinePlace& place = samples.lines->place[i];
      if (may_show_edge(view, surface, samples.backbones->edge[place.edge])) spots.add(line_place(samples, place));
    }
  }
  for (const isolod::SurfacePlace& place : places) {
    if (view.may_show_face(place.face.value)) inner_.add(position_of(surface, place));
  }
}

void SampleSpots::draw(Svg& svg, double diameter) const {
  inner_.draw(svg, palette::surface_sample, diameter, 0);
  seam_.draw(svg, palette::seam_sample, diameter, 0);
  feature_.draw(svg, palette::line_sample, diameter * 1.1, 0);
  corner_.draw(svg, palette::corner, std::max(diameter * 1.5, 4.5), 1);
}

std::vector<LegendItem> SampleSpots::legend(const isolod::SampledSurface& samples) {
  const Surface& surface = *samples.surface;
  std::size_t corners = 0, features = 0;
  for (const isolod::VertexId v : samples.backbones->node) corners += surface.corner[v] != 0;
  for (std::size_t b = 0; b < samples.backbones->count(); ++b) {
    if (is_feature(surface, *samples.backbones, b)) features += samples.lines->inner_count(b);
  }
  const std::size_t seams = samples.numbers.node_count - corners + samples.numbers.line_count - features;
  std::vector<LegendItem> items = {
      {Mark::spot, palette::surface_sample, grouped(samples.places.count) + " on the surface"}};
  if (features > 0) items.push_back({Mark::spot, palette::line_sample, grouped(features) + " on features"});
  if (seams > 0) items.push_back({Mark::spot, palette::seam_sample, grouped(seams) + " on seams"});
  if (corners > 0) items.push_back({Mark::spot, palette::corner, grouped(corners) + " at corners"});
  return items;
}

}  // namespace draw
