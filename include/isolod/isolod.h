// isolod: isotropic remeshing of triangle surfaces with an exact number of vertices, in a block of memory of yours.
//
//   static unsigned char block[64 << 20];
//
//   isolod::MeshView view;                // reads your arrays where they lie
//   view.positions = xyz;                 // double[3 * vertex_count]; floats and strides are fine too
//   view.vertex_count = vertex_count;
//   view.indices = corners;               // std::uint32_t[3 * triangle_count]; 16 bits are fine too
//   view.triangle_count = triangle_count;
//
//   isolod::Options options;
//   options.vertex_count = 5000;          // exactly so many come out
//   options.feature_angle = 40;           // degrees; edges as sharp stay edges
//
//   isolod::MeshSink sink;                // called only when the whole result is known to be good
//   sink.context = &out;
//   sink.vertices = take_vertices;        // bool (*)(void* context, const double* xyz, std::size_t count)
//   sink.triangles = take_triangles;      // bool (*)(void* context, const std::uint32_t* corners, std::size_t count)
//
//   isolod::Arena arena(block, sizeof block);
//   isolod::Report report;
//   const isolod::Status status = isolod::remesh(view, options, sink, &report, arena);
//   if (!status.is_ok()) {                // the sink has not been called, the block is as it was
//     std::printf("%s: %s %llu\n", name(status.code), name(status.element), (unsigned long long)status.value);
//   }
//
// To spread the work over frames, let a `Remesher` do the same in slices. Files are read and written by isolod/io.h,
// which this header leaves out: it belongs to a library of its own. For C there is isolod/isolod_c.h.
#pragma once

#include "isolod/arena.h"
#include "isolod/mesh.h"
#include "isolod/options.h"
#include "isolod/remesh.h"
#include "isolod/self_test.h"
#include "isolod/status.h"
#include "isolod/version.h"
