#include "draw/camera.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace draw {

namespace {

constexpr double pi = 3.14159265358979323846;

double along(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// How much of the area lies flat at the bottom, if that axis is up.
double base_share(const Model& model, int axis) {
  const Bounds bounds = bounds_of(model);
  const double low = along(bounds.low, axis), high = along(bounds.high, axis);
  double base = 0, all = 0;
  for (std::size_t f = 0; f < model.face.size(); ++f) {
    const Vec3 area = model.area_vector(f);
    const double size = length(area);
    all += size;
    const double height = (along(model.corner(f, 0), axis) - low) / std::max(high - low, 1e-300);
    if (height < 0.04 && -along(area, axis) > 0.95 * size) base += size;
  }
  return all > 0 ? base / all : 0;
}

/// The sides that have one triangle.
std::vector<std::array<Vec3, 2>> open_sides(const Model& model) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;
  for (const std::array<std::uint32_t, 3>& face : model.face) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % 3];
      ++faces[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::vector<std::array<Vec3, 2>> sides;
  for (const auto& edge : faces) {
    if (edge.second == 1) sides.push_back({model.point[edge.first.first], model.point[edge.first.second]});
  }
  return sides;
}

/// The part of the borders that lies at the lower end, if `up` is up.
double standing_share(const Model& model, const std::vector<std::array<Vec3, 2>>& sides, Vec3 up) {
  double low = dot(model.point[0], up), high = low, standing = 0, all = 0;
  for (const Vec3& p : model.point) low = std::min(low, dot(p, up)), high = std::max(high, dot(p, up));
  for (const std::array<Vec3, 2>& side : sides) {
    const double size = distance(side[0], side[1]);
    all += size;
    if (dot(side[0], up) < low + 0.1 * (high - low)) standing += size;
  }
  return all > 0 ? standing / all : 0;
}

/// How far the surface is from being its own mirror image along an axis: its odd moments, 0 for a mirrored shape.
double lopsidedness(const Model& model, int axis) {
  Vec3 middle{0, 0, 0};
  double all = 0;
  const auto each = [&model](auto visit) {
    for (std::size_t f = 0; f < model.face.size(); ++f) {
      visit(length(model.area_vector(f)), model.middle(f));
    }
  };
  each([&](double area, Vec3 p) { middle = middle + area * p, all += area; });
  middle = 1 / std::max(all, 1e-300) * middle;
  double moment[4] = {0, 0, 0, 0};
  each([&](double area, Vec3 p) {
    const Vec3 q = p - middle;
    const double x = along(q, axis), y = along(q, (axis + 1) % 3), z = along(q, (axis + 2) % 3);
    moment[0] += area * x * x * x, moment[1] += area * x * y * y, moment[2] += area * x * z * z;
    moment[3] += area * x * y * z;
  });
  return std::fabs(moment[0]) + std::fabs(moment[1]) + std::fabs(moment[2]) + std::fabs(moment[3]);
}

/// Open shapes stand on their borders where most of these lie at one end: cut-off necks and feet. Others stand on what
/// is flat, and nothing that has a left and a right stands on one of them.
Vec3 choose_up(const Model& model) {
  const std::vector<std::array<Vec3, 2>> sides = open_sides(model);
  Vec3 best{0, 1, 0};
  double most = 0.5;
  for (const Vec3& up : {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}}) {
    const double share = standing_share(model, sides, up);
    if (share > most + 0.01) most = share, best = up;
  }
  if (most > 0.5) return best;
  const bool lies_on_z = base_share(model, 2) > base_share(model, 1) + 0.01;
  const bool y_is_sideways = lopsidedness(model, 1) < 0.1 * lopsidedness(model, 2);
  return lies_on_z || y_is_sideways ? Vec3{0, 0, 1} : best;
}

/// The surface that this view shows; what is seen from the side or lies in shade counts less.
double shown_surface(const Model& model, Camera camera) {
  constexpr std::size_t size = 140;
  fit(camera, model, size, size);
  ItemImage image(size, size);
  for (std::size_t f = 0; f < model.face.size(); ++f) {
    image.paint(camera.project(model.corner(f, 0)), camera.project(model.corner(f, 1)),
                camera.project(model.corner(f, 2)), static_cast<std::uint32_t>(f));
  }
  double shown = 0;
  for (std::size_t pixel = 0; pixel < image.pixel_count(); ++pixel) {
    const std::uint32_t f = image.item(pixel);
    if (f == ItemImage::nothing) continue;
    Vec3 normal = unit(model.area_vector(f));
    const double facing = dot(normal, camera.toward);
    if (facing < 0) normal = -1.0 * normal;
    const double lit = 0.62 * std::fabs(facing) - 0.48 * dot(normal, camera.right) + 0.62 * dot(normal, camera.up);
    const double weight = facing < 0 ? 0.5 : std::min(1.0, facing / 0.45);  // backs of open surfaces are no good sight
    shown += weight * (0.8 + 0.2 * std::max(0.0, lit)) / std::max(std::fabs(facing), 0.08);
  }
  return shown / (camera.scale * camera.scale);
}

}  // namespace

Camera camera_from(Vec3 toward, Vec3 up) {
  Camera camera;
  camera.toward = unit(toward);
  camera.right = unit(cross(up, camera.toward));
  camera.up = cross(camera.toward, camera.right);
  camera.centre = {0, 0, 0};
  return camera;
}

Camera choose_camera(const Model& model) {
  const Model light = lightened(model, 20000);
  const Vec3 up = choose_up(light);
  const Vec3 east = up.x != 0 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, north = cross(up, east);
  Camera best;
  double most = -1;
  for (int height = 0; height < 3; ++height) {
    const double elevation = (14 + 12 * height) * pi / 180;
    for (int step = 0; step < 24; ++step) {
      const double turn = (step + 0.5) * pi / 12;
      const Vec3 level = std::cos(turn) * east + std::sin(turn) * north;
      const Camera camera = camera_from(std::cos(elevation) * level + std::sin(elevation) * up, up);
      const double shown = shown_surface(light, camera) * (height == 1 ? 1.02 : 1);
      if (shown > most) most = shown, best = camera;
    }
  }
  return best;
}

ScreenPoint fit(Camera& camera, const Model& model, double width, double height) {
  camera.scale = 1;
  camera.origin_x = camera.origin_y = 0;
  camera.centre = bounds_of(model).centre();
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  for (const Vec3& p : model.point) {
    const ScreenPoint s = camera.project(p);
    x0 = std::min(x0, s.x), x1 = std::max(x1, s.x);
    y0 = std::min(y0, s.y), y1 = std::max(y1, s.y);
  }
  const double w = std::max(x1 - x0, 1e-300), h = std::max(y1 - y0, 1e-300);
  camera.scale = std::min(width / w, height / h);
  camera.origin_x = width / 2 - camera.scale * (x0 + x1) / 2;
  camera.origin_y = height / 2 - camera.scale * (y0 + y1) / 2;
  return {camera.scale * w, camera.scale * h, 0};
}

}  // namespace draw
