// A model as a camera sees it: which triangles can be seen, in which order they are painted, and how bright they are.
//
// Hidden triangles are found in an image of items (twice the picture's resolution) and left out. Of the others, each is
// painted before those that cover a part of it. So most of them, the wholly visible ones, may be painted in any order
// and share one path for each colour.
#pragma once

#include <utility>

#include "draw/camera.h"
#include "draw/svg.h"

namespace draw {

class View {
 public:
  static constexpr std::uint32_t hidden = UINT32_MAX;

  /// `width` and `height`: of the whole picture, in pixels. `model` must stay.
  View(const Model& model, const Camera& camera, double width, double height);

  const Model& model() const { return *model_; }
  const Camera& camera() const { return camera_; }

  /// 0 for a triangle that nothing covers, more for those that must be painted sooner; `hidden` for those not seen.
  std::uint32_t rank(std::size_t f) const { return rank_[f]; }
  bool is_back(std::size_t f) const { return dot(model_->area_vector(f), camera_.toward) < 0; }

  /// Light from the upper left, less in hollows; 0 to 1.
  double light(std::size_t f) const;

  Vec2 place(Vec3 p) const;
  Vec2 vertex(std::uint32_t v) const { return {screen_[v].x, screen_[v].y}; }
  /// Whether a point of the surface is in front. Near outlines that is a guess, so a face or vertex that it belongs to
  /// should be asked first; these always say yes for a model that was thinned out.
  bool shows(Vec3 p) const;
  bool may_show_face(std::size_t f) const { return model_->is_thinned || rank_[f] != hidden; }
  bool may_show_vertex(std::size_t v) const { return model_->is_thinned || vertex_seen_[v] != 0; }

 private:
  ScreenPoint in_image(const ScreenPoint& p) const;
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Pair> find_covers(std::vector<std::uint8_t>& seen) const;
  void find_ranks();
  double hollowness(std::size_t f, Vec3 normal) const;

  const Model* model_;
  Camera camera_;
  std::vector<ScreenPoint> screen_;  // per vertex, in pixels of the picture
  ItemImage image_;
  std::vector<std::uint32_t> rank_;
  std::vector<std::uint8_t> vertex_seen_;
  double bias_;
};

}  // namespace draw
