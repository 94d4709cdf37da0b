// The structs of the C interface beside those of C++: one list of members for both directions.
//
// A member that is not in its list here is one that C cannot choose; tests/test_isolod_c.cpp counts them.
#pragma once

#include <cstring>
#include <type_traits>

#include "base/status.h"
#include "isolod/isolod_c.h"
#include "isolod/mesh.h"
#include "isolod/options.h"
#include "isolod/remesh.h"

namespace isolod {
inline namespace v1 {

/// Calls `visit(c_member, member)` for each in the order of `Options`, and for an enumeration `visit(c_member, member,
/// its_last_value)`.
template <class C, class Cpp, class Visit>
void visit_options(C& c, Cpp& options, Visit& visit) {
  visit(c.vertex_count, options.vertex_count);
  visit(c.feature_angle, options.feature_angle);
  visit(c.corner_angle, options.corner_angle);
  visit(c.density, options.density, DensitySource::curvature);
  visit(c.gamma, options.gamma);
  visit(c.smoothing_passes, options.smoothing_passes);
  visit(c.smooth_undersampled, options.smooth_undersampled);
  visit(c.atlas, options.atlas, AtlasKind::single);
  visit(c.cut, options.cut, CutKind::greedy);
  visit(c.fall_back_to_charts, options.fall_back_to_charts);
  visit(c.calibration, options.calibration, Calibration::paper);
  visit(c.fluency, options.fluency, Fluency::strip);
  visit(c.weight, options.weight, LloydWeight::paper);
  visit(c.centroids, options.centroids, Centroids::exact);
  visit(c.lloyd_iterations, options.lloyd_iterations);
  visit(c.remove_seams, options.remove_seams);
  visit(c.close_boundaries, options.close_boundaries);
  visit(c.fit, options.fit);
  visit(c.weld, options.weld);
  visit(c.validate, options.validate);
}

template <class C, class Cpp, class Visit>
void visit_mesh(C& c, Cpp& view, Visit& visit) {
  visit(c.positions, view.positions);
  visit(c.vertex_count, view.vertex_count);
  visit(c.position_stride, view.position_stride);
  visit(c.position_type, view.position_type, ScalarType::float64);
  visit(c.index_type, view.index_type, IndexType::uint32);
  visit(c.indices, view.indices);
  visit(c.triangle_count, view.triangle_count);
  visit(c.vertex_density, view.vertex_density);
  visit(c.corner_density, view.corner_density);
  visit(c.tagged_edges, view.tagged_edges);
  visit(c.tagged_edge_count, view.tagged_edge_count);
  visit(c.tagged_edge_density, view.tagged_edge_density);
  visit(c.triangle_materials, view.triangle_materials);
}

/// From C++ to C.
struct ToC {
  template <class T>
  void operator()(T& c, const T& member) const {
    c = member;
  }
  void operator()(std::int32_t& c, bool member) const { c = member ? 1 : 0; }
  template <class Choice>
  void operator()(std::int32_t& c, Choice member, Choice) const {
    c = static_cast<std::int32_t>(member);
  }
};

/// From C to C++, as far as the choices are such.
struct FromC {
  std::uint64_t place = 0;
  std::uint64_t first_bad = UINT64_MAX;  ///< the place of the first member that is no choice

  template <class T>
  void operator()(const T& c, T& member) {
    member = c;
    ++place;
  }
  void operator()(std::int32_t c, bool& member) {
    if (is_choice(c, 1)) member = c == 1;
  }
  template <class Choice>
  void operator()(std::int32_t c, Choice& member, Choice last) {
    if (is_choice(c, static_cast<std::int32_t>(last))) member = static_cast<Choice>(c);
  }

 private:
  bool is_choice(std::int32_t c, std::int32_t last) {
    const bool good = 0 <= c && c <= last;
    if (!good && first_bad == UINT64_MAX) first_bad = place;
    ++place;
    return good;
  }
};

/// The defaults of a struct of C, whole.
inline isolod_options c_options(const Options& options) {
  isolod_options c = {};
  ToC to_c;
  visit_options(c, options, to_c);
  c.struct_size = sizeof c;
  return c;
}
inline isolod_mesh c_mesh(const MeshView& view) {
  isolod_mesh c = {};
  ToC to_c;
  visit_mesh(c, view, to_c);
  c.struct_size = sizeof c;
  return c;
}

/// What the caller's struct says, with defaults for the members that it does not have yet. A size that no version ever
/// had, less than `least` or more than the struct of today, is invalid_option.
template <class C>
Status complete(const C* given, std::size_t least, C& whole) {
  if (given == nullptr || given->struct_size < least || given->struct_size > sizeof(C)) {
    return fail(Status::invalid_option);
  }
  std::memcpy(&whole, given, given->struct_size);
  return {};
}

/// The first of the caller's `bytes` as `whole` has them, the rest 0. Refused where there is no room for `least`.
template <class C>
std::int32_t init(C* given, std::size_t bytes, std::size_t least, C whole) {
  if (given == nullptr || bytes < least) return ISOLOD_INVALID_ARGUMENT;
  const std::size_t known = bytes < sizeof whole ? bytes : sizeof whole;
  whole.struct_size = static_cast<std::uint32_t>(known);
  std::memset(static_cast<void*>(given), 0, bytes);
  std::memcpy(given, &whole, known);
  return ISOLOD_OK;
}

}  // namespace v1
}  // namespace isolod
