#include "relax/middle_place.h"

#include "sample/descent.h"
#include "sample/surface_walk.h"

namespace isolod {
inline namespace v1 {

namespace {

/// The nearest place to a point so far.
class Nearest {
 public:
  Nearest(const Surface& surface, const Samples& samples, Vec3 point)
      : surface_(surface), samples_(samples), point_(point) {}

  void walk_from(SampleId s) {
    if (samples_.held[s]) return;
    SurfacePlace place;
    walk_straight(surface_, samples_.place[s], point_ - position_of(surface_, samples_, s), place);
    consider(place);
  }

  /// From the faces around an anchor: the right one is on the side of the point.
  void descend_from(SampleId s) {
    const LineAnchor& anchor = samples_.anchor[s];
    const VertexId v =
        anchor.along <= 0.5 ? surface_.mesh.origin[anchor.halfedge] : surface_.mesh.target(anchor.halfedge);
    visit_outgoing(surface_.mesh, v, [&](HalfedgeId h) { consider(descend(surface_, face(h), point_)); });
  }

  bool is_found() const { return !place_.face.is_none(); }
  SurfacePlace place() const { return place_; }

 private:
  void consider(const SurfacePlace& place) {
    const double d = distance(position_of(surface_, place), point_);
    if (is_found() && !(d < least_)) return;
    place_ = place;
    least_ = d;
  }

  const Surface& surface_;
  const Samples& samples_;
  Vec3 point_;
  SurfacePlace place_{none<FaceId>(), 0, 0};
  double least_ = 0;
};

}  // namespace

SurfacePlace middle_place(const Surface& surface, const Samples& samples, SampleId a, SampleId b) {
  Nearest nearest(surface, samples, midpoint(position_of(surface, samples, a), position_of(surface, samples, b)));
  nearest.walk_from(a);
  nearest.walk_from(b);
  if (!nearest.is_found()) nearest.descend_from(a);
  return nearest.place();
}

SurfacePlace middle_place(const Surface& surface, const Samples& samples, SampleId a, SampleId b, SampleId c) {
  const Vec3 sum =
      position_of(surface, samples, a) + position_of(surface, samples, b) + position_of(surface, samples, c);
  Nearest nearest(surface, samples, (1.0 / 3) * sum);
  nearest.walk_from(a);
  nearest.walk_from(b);
  nearest.walk_from(c);
  if (!nearest.is_found()) nearest.descend_from(a);
  return nearest.place();
}

}  // namespace v1
}  // namespace isolod
