// What `info`, `compare` and `validate` measure of a mesh file, and its JSON.
#pragma once

#include <cstddef>

#include "isolod/files.h"
#include "isolod/json.h"
#include "isolod/measure.h"

namespace tool {

struct MeshFacts {
  measure::Topology topology;
  measure::Quality quality;  ///< only where `is_measurable`

  /// Indices are in range and positions finite: what every other measure wants.
  bool is_measurable() const { return topology.bad_indices + topology.bad_positions == 0; }
  bool is_closed() const { return topology.boundary_edges == 0 && topology.is_oriented_manifold(); }
};

measure::Surface surface_of(const InputMesh& mesh);
MeshFacts facts_of(const InputMesh& mesh);

/// The first rule that the mesh breaks, in words, or "" for a mesh without fault.
std::string first_fault(const MeshFacts& facts);

void add_facts(JsonWriter& json, const char* key, const MeshFacts& facts, double diagonal);

/// Reads a file whose mesh can be measured: a vertex without a finite position is a failure.
InputMesh read_measurable(const std::string& path);

}  // namespace tool
