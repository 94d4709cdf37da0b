// Where a model is looked at from: parallel projection, and a direction that shows much of the surface.
#pragma once

#include "draw/item_image.h"
#include "draw/model.h"
#include "isolod/mesh.h"

namespace draw {

struct Camera {
  Vec3 right, up, toward;  ///< unit vectors; `toward` runs from the model to the eye
  Vec3 centre;             ///< lands at x = origin_x, y = origin_y
  double scale = 1;        ///< pixels a unit of length
  double origin_x = 0, origin_y = 0;

  ScreenPoint project(Vec3 p) const {
    const Vec3 q = p - centre;
    return {origin_x + scale * dot(q, right), origin_y - scale * dot(q, up), -scale * dot(q, toward)};
  }
};

/// A camera that looks along -toward, with `up` upwards in the picture. The scale is 1.
Camera camera_from(Vec3 toward, Vec3 up);

/// Tries directions around the model, a little from above, and takes the one that shows the most surface not too
/// much from the side. Up is y, or z where the model stands flat along z.
Camera choose_camera(const Model& model);

/// Sets scale and origin so that the model fits in the middle of a box of that size; returns the size that it takes.
ScreenPoint fit(Camera& camera, const Model& model, double width, double height);

}  // namespace draw
