// Files in memory for the tests of readers and writers: small ones of every format, and how to read and write them.
#pragma once

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "isolod/io.h"
#include "support/block.h"

namespace support {

inline isolod::Span<const unsigned char> bytes(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

/// What a reader gave, out of the arena.
struct Loaded {
  isolod::Status status;
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles, materials;
  bool welded = false;
};

inline Loaded load(const std::string& file, isolod::FileFormat format, std::size_t arena_bytes = std::size_t{1} << 20) {
  Block block(arena_bytes);
  isolod::LoadedMesh mesh;
  Loaded loaded;
  loaded.status = read_mesh(bytes(file), format, mesh, block.arena);
  loaded.positions.assign(mesh.positions.begin(), mesh.positions.end());
  loaded.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  loaded.materials.assign(mesh.triangle_materials.begin(), mesh.triangle_materials.end());
  loaded.welded = mesh.welded;
  return loaded;
}

inline isolod::Status write(std::string& out, const isolod::WriteOptions& options, const std::vector<double>& positions,
                            const std::vector<std::uint32_t>& triangles) {
  const auto append = [](void* context, const void* data, std::size_t count) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), count);
    return true;
  };
  return write_mesh(options, {positions.data(), positions.size()}, {triangles.data(), triangles.size()},
                    {&out, append});
}

/// The lowest bytes of a number, least significant first (or last).
inline std::string binary(std::uint64_t bits, int count, bool big_endian = false) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text.push_back(static_cast<char>(bits >> (8 * (big_endian ? count - 1 - i : i)) & 0xFF));
  }
  return text;
}

inline std::string binary_float(float value, bool big_endian = false) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return binary(bits, 4, big_endian);
}

inline std::string binary_double(double value, bool big_endian = false) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return binary(bits, 8, big_endian);
}

/// A GLB file of a JSON text and a binary chunk.
inline std::string glb(std::string json, std::string data) {
  while (json.size() % 4 != 0) json += ' ';
  while (data.size() % 4 != 0) data += '\0';
  const std::string chunks =
      binary(json.size(), 4) + "JSON" + json + binary(data.size(), 4) + std::string("BIN\0", 4) + data;
  return "glTF" + binary(2, 4) + binary(12 + chunks.size(), 4) + chunks;
}

/// Two triangles in binary STL with any header.
inline std::string stl_square(const std::string& header) {
  const float corner[6][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, -0.0F}, {1, 1, 0}, {0, 1, 0}};
  std::string file = header + std::string(80 - header.size(), ' ') + binary(2, 4);
  for (int t = 0; t < 2; ++t) {
    for (int i = 0; i < 3; ++i) file += binary_float(i == 2 ? 1.0F : 0.0F);
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) file += binary_float(corner[3 * t + k][i]);
    }
    file += binary(0, 2);
  }
  return file;
}

/// A triangle under a node that moves it by 10 along x: positions as floats, 16-bit indices.
inline std::string glb_triangle(const std::string& node = R"("translation":[10,0,0])", const std::string& more = "") {
  std::string data;
  for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 2.0F, 0.0F}) data += binary_float(x);
  for (const unsigned i : {0U, 1U, 2U}) data += binary(i, 2);
  const std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" +
      (node.empty() ? "" : "," + node) + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1)" +
      more +
      R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],)"
      R"("buffers":[{"byteLength":42}]})";
  return glb(json, data);
}

/// A PLY pyramid over a square: properties of many types, lists among the vertices, an unknown element.
inline std::string ply_pyramid(const std::string& format) {
  const bool is_text = format == "ascii", big = format == "binary_big_endian";
  std::string file = "ply\nformat " + format +
                     " 1.0\ncomment a pyramid\nelement vertex 5\nproperty uchar red\nproperty float z\n"
                     "property list uchar short extra\nproperty double x\nproperty int y\nelement other 1\n"
                     "property ushort a\nproperty list uint float b\nelement face 5\nproperty char flag\n"
                     "property list uchar uint vertex_indices\nend_header\n";
  const double at[5][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 1.5}};
  const std::vector<std::vector<unsigned>> faces = {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  for (unsigned v = 0; v < 5; ++v) {
    const auto number = [](double x) { return std::string(x == 1.5 ? "1.5" : x == 2 ? "2" : x == 1 ? "1" : "0"); };
    if (is_text) {
      file += "255 " + number(at[v][2]) + " 2 -7 9 " + number(at[v][0]) + " " + number(at[v][1]) + "\n";
    } else {
      file += binary(255, 1) + binary_float(static_cast<float>(at[v][2]), big) + binary(2, 1) + binary(0xFFF9, 2, big) +
              binary(9, 2, big) + binary_double(at[v][0], big) + binary(static_cast<std::uint64_t>(at[v][1]), 4, big);
    }
  }
  file += is_text ? "3 1 0.5\n" : binary(3, 2, big) + binary(1, 4, big) + binary_float(0.5F, big);
  for (const std::vector<unsigned>& face : faces) {
    file += is_text ? "-1 " + std::to_string(face.size()) : binary(255, 1) + binary(face.size(), 1);
    for (const unsigned v : face) file += is_text ? " " + std::to_string(v) : binary(v, 4, big);
    if (is_text) file += "\n";
  }
  return file;
}

struct SmallFile {
  const char* name;
  isolod::FileFormat format;
  std::string content;
};

/// Valid files that between them go through most of every reader.
inline std::vector<SmallFile> small_files() {
  using isolod::FileFormat;
  const std::string pentagon = "v 0 0 0\nv 2 0 0\nv 1 0.5 0\nv 2 2 0\nv 0 2 0\n";
  const std::string strips =
      "ply\r\nformat ascii 1.0\r\nelement vertex 5\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n"
      "element tristrips 1\r\nproperty list int int vertex_index\r\nend_header\r\n"
      "0 0 0\r\n1 0 0\r\n0 1 0\r\n1 1 0\r\n2 2 0\r\n8 0 1 2 3 -1 1 4 3\r\n";
  return {
      {"obj", FileFormat::obj,
       "# a comment\n" + pentagon +
           "vt 0 0\nusemtl red\nf 1/1 2/1 3/1 4/1 5/1\nusemtl blue\nf -5//1 -4//2 \\\n -3//3\n"},
      {"off", FileFormat::off,
       "OFF # words\n5 2 0\n0 0 0\n2 0 0\n1 0.5 0\n2 2 0\n0 2 0\n5 0 1 2 3 4 255 0 0\n\n3 0 1 2\n"},
      {"coff", FileFormat::off, "CNOFF 3 1\n0 0 0 0 0 1 9 9 9 9\n1 0 0 0 0 1 9 9 9 9\n0 1e0 0 0 0 1 9 9 9 9\n3 0 1 2"},
      {"ply ascii", FileFormat::ply, ply_pyramid("ascii")},
      {"ply little", FileFormat::ply, ply_pyramid("binary_little_endian")},
      {"ply big", FileFormat::ply, ply_pyramid("binary_big_endian")},
      {"ply strips", FileFormat::ply, strips},
      {"stl binary", FileFormat::stl, stl_square("solid but binary")},
      {"stl text", FileFormat::stl,
       "solid a b\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 1 0\n   vertex 0 1 "
       "0\n"
       "  endloop\n endfacet\n facet normal 0 0 -1\n  outer loop\n   vertex -0 0 0\n   vertex 1 1 0\n   vertex 1 0 0\n"
       "  endloop\n endfacet\nendsolid a b\n"},
      {"glb", FileFormat::glb, glb_triangle()},
      {"glb matrix", FileFormat::glb,
       glb_triangle(R"("matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1],"children":[])", R"(,"material":3,"mode":5)")},
  };
}

inline std::string model_directory() { return std::string(ISOLOD_TEST_DIRECTORY) + "/../../shared/models/"; }

/// A whole file; empty if there is none.
inline std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace support
