#include "draw/view.h"

#include <algorithm>
#include <cmath>

namespace draw {

namespace {

constexpr double fineness = 2;  // pixels of the image for one of the picture

std::size_t image_size(double size) { return static_cast<std::size_t>(std::ceil(size * fineness)); }

}  // namespace

View::View(const Model& model, const Camera& camera, double width, double height)
    : model_(&model), camera_(camera), image_(image_size(width), image_size(height)) {
  screen_.reserve(model.point.size());
  for (const Vec3& p : model.point) screen_.push_back(camera.project(p));
  bias_ = 0.003 * fineness * camera.scale * bounds_of(model).diagonal();
  for (std::size_t f = 0; f < model.face.size(); ++f) {
    const std::array<std::uint32_t, 3>& corner = model.face[f];
    image_.paint(in_image(screen_[corner[0]]), in_image(screen_[corner[1]]), in_image(screen_[corner[2]]),
                 static_cast<std::uint32_t>(f));
  }
  find_ranks();
}

ScreenPoint View::in_image(const ScreenPoint& p) const { return {fineness * p.x, fineness * p.y, fineness * p.depth}; }

Vec2 View::place(Vec3 p) const {
  const ScreenPoint s = camera_.project(p);
  return {s.x, s.y};
}

bool View::shows(Vec3 p) const { return image_.shows(in_image(camera_.project(p)), bias_); }

/// Lists the pairs (a triangle that can be seen, one that is in front of it somewhere), and says which can be seen.
std::vector<View::Pair> View::find_covers(std::vector<std::uint8_t>& seen) const {
  for (std::size_t pixel = 0; pixel < image_.pixel_count(); ++pixel) {
    if (image_.item(pixel) != ItemImage::nothing) seen[image_.item(pixel)] = 1;
  }
  std::vector<Pair> behind;
  for (std::size_t f = 0; f < seen.size(); ++f) {
    const std::array<std::uint32_t, 3>& corner = model_->face[f];
    const std::ptrdiff_t before = static_cast<std::ptrdiff_t>(behind.size());
    bool is_fine = true;
    image_.cover(in_image(screen_[corner[0]]), in_image(screen_[corner[1]]), in_image(screen_[corner[2]]),
                 [&](std::size_t pixel, double) {
                   is_fine = false;
                   const std::uint32_t front = image_.item(pixel);
                   if (seen[f] && front != f) behind.emplace_back(static_cast<std::uint32_t>(f), front);
                 });
    // What falls between the pixels is seen if its middle is.
    if (is_fine) seen[f] = !is_back(f) && shows(model_->middle(f));
    std::sort(behind.begin() + before, behind.end());
    behind.erase(std::unique(behind.begin() + before, behind.end()), behind.end());
  }
  return behind;
}

/// A triangle's rank is greater than that of any other that is in front of it somewhere. Where triangles
/// cover one another in a ring, the bound on the rounds ends it.
void View::find_ranks() {
  const std::size_t count = model_->face.size();
  std::vector<std::uint8_t> seen(count, 0);
  const std::vector<Pair> behind = find_covers(seen);
  rank_.resize(count);
  vertex_seen_.assign(model_->point.size(), 0);
  for (std::size_t f = 0; f < count; ++f) {
    rank_[f] = seen[f] ? 0 : hidden;
    for (std::uint32_t v : model_->face[f]) vertex_seen_[v] |= seen[f];
  }
  bool changed = true;
  for (int round = 0; round < 24 && changed; ++round) {
    changed = false;
    for (const Pair& pair : behind) {
      if (rank_[pair.first] > rank_[pair.second]) continue;
      rank_[pair.first] = rank_[pair.second] + 1;
      changed = true;
    }
  }
}

/// The part of the surroundings, within 30 pixels, that rises over the triangle's plane.
double View::hollowness(std::size_t f, Vec3 normal) const {
  const double facing = std::max(dot(normal, camera_.toward), 0.2);
  const double slope_x = dot(normal, camera_.right) / facing, slope_y = -dot(normal, camera_.up) / facing;
  const ScreenPoint p = in_image(camera_.project(model_->middle(f)));
  double sum = 0;
  constexpr int turns = 12;
  for (int ring = 1; ring <= 4; ++ring) {
    const double radius = fineness * 7.5 * ring;
    for (int turn = 0; turn < turns; ++turn) {
      const double angle = (turn + 0.5 * (ring % 2)) * 6.283185307179586 / turns;
      const double dx = radius * std::cos(angle), dy = radius * std::sin(angle);
      const double rise = p.depth + slope_x * dx + slope_y * dy - image_.depth_at(p.x + dx, p.y + dy);
      if (!(rise > 0)) continue;  // also where nothing is painted
      const double steepness = rise / radius;
      sum += std::clamp((steepness - 0.1) / 0.9, 0.0, 1.0) / (1 + std::max(0.0, steepness - 2));
    }
  }
  return sum / (4 * turns);
}

double View::light(std::size_t f) const {
  Vec3 normal = unit(model_->area_vector(f));
  if (dot(normal, camera_.toward) < 0) normal = -1.0 * normal;
  const double x = dot(normal, camera_.right), y = dot(normal, camera_.up), z = dot(normal, camera_.toward);
  const double main = std::max(0.0, -0.48 * x + 0.62 * y + 0.62 * z);  // from the upper left, in front
  const double sky = 0.5 + 0.5 * y;
  const double side = std::max(0.0, 0.9 * x - 0.1 * y + 0.4 * z);
  const double open = 1 - 0.85 * hollowness(f, normal);
  return (0.20 + 0.58 * main + 0.12 * sky + 0.10 * side) * open;
}

}  // namespace draw
