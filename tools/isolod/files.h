// Meshes from and to files.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "isolod/arguments.h"
#include "isolod/io.h"
#include "isolod/output_file.h"
#include "isolod/run.h"

namespace tool {

/// A mesh as it came from its file, with the memory that it lies in.
struct InputMesh {
  std::unique_ptr<unsigned char[]> block;
  isolod::LoadedMesh loaded;
  std::vector<double> vertex_density;        ///< empty, or one a vertex
  std::vector<double> corner_density;        ///< empty, or three a triangle
  std::vector<std::uint32_t> feature_edges;  ///< two vertices an edge
  std::vector<double> feature_density;       ///< empty, or one a feature edge, 0 where the file gives none

  isolod::MeshView view() const;
};

/// The format is told by the name's ending, or by the content where the ending tells nothing. Throws a failure that
/// names the file and the place in it.
InputMesh read_mesh_file(const std::string& path);

/// One number a vertex, separated by blanks or line ends. Throws a failure that names the line.
std::vector<double> read_density_file(const std::string& path, std::size_t vertex_count);

/// The same, or three numbers a triangle where that is another count.
void read_density_file(const std::string& path, InputMesh& mesh);

/// An edge a line: two vertices, from 0, and where wished the density along it. What is behind a # is a comment. Throws
/// a failure that names the line.
void read_feature_file(const std::string& path, InputMesh& mesh);

/// How to write under that name. Throws where no mesh could be written so: before the work, not after it.
isolod::WriteOptions write_options(const std::string& path, bool ascii);

/// What a command that makes a mesh accepts besides: `print_hash`.
OptionRule hash_rule();

/// A line "hash  path", as the programs that sum files print it.
void print_hash(const TriangleMesh& mesh, const std::string& path);

/// Writes and commits. The file is opened long before, so that a closed folder is known before the work.
void write_mesh_file(OutputFile& file, const isolod::WriteOptions& options, const TriangleMesh& mesh);

}  // namespace tool
