// PLY, STL and GLB.
#include <doctest/doctest.h>

#include "support/files.h"

using namespace isolod;
using support::binary;
using support::binary_float;
using support::load;
using support::Loaded;

namespace {

using Triangles = std::vector<std::uint32_t>;
using Numbers = std::vector<double>;

const std::string ply_start = "ply\nformat ascii 1.0\n";
const std::string ply_points = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string ply_faces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string ply_rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

void check_ply(const std::string& file, Status::Code code, std::uint64_t value) {
  CAPTURE(file);
  const Loaded loaded = load(file, FileFormat::ply);
  CHECK(loaded.status.code == code);
  CHECK(loaded.status.value == value);
}

/// A GLB with the given members besides three positions (accessor 0) and six 8-bit indices (accessor 1).
Loaded load_glb(const std::string& members, const std::string& indices = std::string("\0\1\2\2\1\0", 6)) {
  std::string data;
  for (const float x : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.5F}) data += binary_float(x);
  data += indices;
  const std::string json = "{" + members +
                           R"(,"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                           R"({"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"},)"
                           R"({"bufferView":1,"byteOffset":3,"componentType":5121,"count":3,"type":"SCALAR"},)"
                           R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1}},)"
                           R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}],)"
                           R"("bufferViews":[{"byteLength":36},{"byteOffset":36,"byteLength":6}]})";
  return load(support::glb(json, data), FileFormat::glb);
}

const std::string one_mesh = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";

}  // namespace

TEST_CASE("ply: every encoding, types and properties in any order") {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    CAPTURE(format);
    const Loaded loaded = load(support::ply_pyramid(format), FileFormat::ply);
    CHECK(loaded.status.is_ok());
    CHECK(loaded.positions == Numbers{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 1.5});
    CHECK(loaded.triangles == Triangles{2, 1, 0, 2, 0, 3, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
  }
}

TEST_CASE("ply: faces before vertices, other line ends, strips") {
  const Loaded turned = load(ply_start + ply_faces + ply_points + "end_header\n3 0 1 2\n" + ply_rows, FileFormat::ply);
  CHECK(turned.status.is_ok());
  CHECK(turned.triangles == Triangles{0, 1, 2});
  CHECK(turned.positions.size() == 12);
  const Loaded strips = load(support::small_files()[6].content, FileFormat::ply);
  CHECK(strips.triangles == Triangles{0, 1, 2, 2, 1, 3, 1, 4, 3});
  const std::string jump = ply_start + ply_points +
                           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + ply_rows +
                           "7 0 1 2 2 3 3 0\n";
  CHECK(load(jump, FileFormat::ply).triangles == Triangles{0, 1, 2});
}

TEST_CASE("ply: exactly one line end before binary data") {
  // 10.0 as an int begins with the byte of a newline, and 13 with that of a return.
  for (const char* end : {"\n", "\r\n", "\r"}) {
    for (const unsigned first : {10U, 13U}) {
      std::string header =
          "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty int x\nproperty uchar y\n"
          "property uchar z\nelement face 1\nproperty list uchar uchar vertex_index\nend_header\n";
      for (std::size_t at = 0; (at = header.find('\n', at)) != std::string::npos; at += std::strlen(end))
        header.replace(at, 1, end);
      const std::string file = header + binary(first, 4) + binary(0, 2) + binary(1, 4) + binary(0, 2) + binary(0, 4) +
                               binary(1, 2) + std::string("\3\0\1\2", 4);
      const Loaded loaded = load(file, FileFormat::ply);
      CHECK(loaded.status.is_ok());
      CHECK(loaded.positions == Numbers{static_cast<double>(first), 0, 0, 1, 0, 0, 0, 1, 0});
    }
  }
}

TEST_CASE("ply: failures name their line or byte, and no count is believed") {
  const std::string header = ply_start + ply_points + ply_faces + "end_header\n" + ply_rows;
  check_ply(header + "2 0 1\n", Status::syntax_error, 14);
  check_ply(header + "3 0 1 4\n", Status::index_out_of_range, 14);
  check_ply(header + "3 0 1 -1\n", Status::index_out_of_range, 14);
  check_ply(header + "3 0 1 1.5\n", Status::syntax_error, 14);
  check_ply(header + "3 0 1\n", Status::syntax_error, 14);
  check_ply(header + "3 0 1", Status::truncated_file, 14);
  check_ply(header + "999999999 0 1\n", Status::truncated_file, 14);
  check_ply(header, Status::truncated_file, 14);
  check_ply(ply_start + "element vertex 99999999999999\nproperty float x\nend_header\n0 0 0\n", Status::syntax_error,
            3);
  check_ply(ply_start + "element other 99999999999999\nend_header\n", Status::empty_mesh, 0);
  check_ply(ply_start + "element other 99999999999999\nproperty int a\nend_header\n1\n", Status::truncated_file, 6);
  check_ply("ply\nformat ascii 1.0\nend_header\n", Status::empty_mesh, 0);
  check_ply("ply\nend_header\n", Status::syntax_error, 2);
  check_ply("ply\nformat odd 1.0\nend_header\n", Status::syntax_error, 2);
  check_ply("ply\nproperty int x\n", Status::syntax_error, 2);
  check_ply("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar string vertex_indices\n", Status::syntax_error,
            4);
  check_ply("ply\nformat ascii 1.0\n", Status::truncated_file, 3);
  check_ply("plywood\n", Status::syntax_error, 1);
  check_ply("", Status::truncated_file, 1);
  const std::string many =
      "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999999\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n";
  check_ply(many + std::string(24, '\0'), Status::truncated_file, many.size() + 24);
}

TEST_CASE("stl: binary by size even where it begins with solid, welded in the order of first places") {
  for (const char* header : {"binary", "solid of some kind"}) {
    const Loaded loaded = load(support::stl_square(header), FileFormat::stl);
    CHECK(loaded.status.is_ok());
    CHECK(loaded.welded);
    CHECK(loaded.positions == Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    CHECK(loaded.triangles == Triangles{0, 1, 2, 0, 2, 3});
  }
  CHECK(load(support::stl_square("binary") + "more", FileFormat::stl).triangles.size() == 6);
  const std::string cut = support::stl_square("solid").substr(0, 150);
  CHECK(load(cut, FileFormat::stl).status == Status::truncated_file);
  CHECK(load("", FileFormat::stl).status == Status::truncated_file);
  CHECK(load(std::string(84, '\0'), FileFormat::stl).status == Status::empty_mesh);
  CHECK(load(std::string(80, 'x') + "\xFF\xFF\xFF\xFF" + std::string(50, 'x'), FileFormat::stl).status ==
        Status::truncated_file);
}

TEST_CASE("stl: text, capitals, facets of four vertices, several solids") {
  const std::string square = support::small_files()[8].content;
  const Loaded loaded = load(square, FileFormat::stl);
  CHECK(loaded.positions == Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  CHECK(loaded.triangles == Triangles{0, 1, 2, 0, 2, 3, 0, 2, 1});
  std::string capitals = square;
  for (char& c : capitals) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  CHECK(load(capitals, FileFormat::stl).triangles == loaded.triangles);
  CHECK(load(square + square, FileFormat::stl).triangles.size() == 18);
  const auto check = [](const std::string& file, Status::Code code, std::uint64_t line) {
    const Status status = load(file, FileFormat::stl).status;
    CAPTURE(file);
    CHECK(status.code == code);
    CHECK(status.value == line);
  };
  check("solid\nvertex 0 0 0\n", Status::syntax_error, 2);
  check("solid\nfacet\nvertex 0 0 0\nvertex 0 0 0\nendfacet\n", Status::syntax_error, 5);
  check("solid\nfacet\nfacet\n", Status::syntax_error, 3);
  check("solid\nfacet\nvertex 0 0\nvertex 0 0 0\nvertex 0 0 0\nendfacet\n", Status::syntax_error, 3);
  check("solid\nnonsense\n", Status::syntax_error, 2);
  check("solid\nfacet\nvertex 0 0 0\n", Status::truncated_file, 4);
  check("solid\nendsolid\n", Status::empty_mesh, 0);
}

TEST_CASE("glb: node transforms are applied, and mirrored triangles turned over") {
  const Loaded moved = load(support::glb_triangle(), FileFormat::glb);
  CHECK(moved.status.is_ok());
  CHECK(moved.positions == Numbers{10, 0, 0, 11, 0, 0, 10, 2, 0});
  CHECK(moved.triangles == Triangles{0, 1, 2});
  CHECK(moved.materials.empty());
  const Loaded mirrored = load(support::small_files()[10].content, FileFormat::glb);
  CHECK(mirrored.positions == Numbers{5, 0, 0, 4, 0, 0, 5, 2, 0});
  CHECK(mirrored.triangles == Triangles{0, 2, 1});
  CHECK(mirrored.materials == Triangles{4});
  // A quarter turn about z, then twice as large along x before it.
  const Loaded turned =
      load(support::glb_triangle(R"("rotation":[0,0,0.70710678118654757,0.70710678118654757],"scale":[2,1,1])"),
           FileFormat::glb);
  REQUIRE(turned.status.is_ok());
  CHECK(turned.positions[3] == doctest::Approx(0));
  CHECK(turned.positions[4] == doctest::Approx(2));
  CHECK(turned.positions[6] == doctest::Approx(-2));
}

TEST_CASE("glb: hierarchies, several uses of a mesh, and scenes") {
  const std::string tree =
      R"("nodes":[{"children":[2,1],"translation":[0,0,1]},{"mesh":0,"scale":[2,2,2]},{"mesh":0},{"mesh":0}],)" +
      one_mesh;
  const Loaded first = load_glb(R"("scenes":[{"nodes":[0]},{"nodes":[3]}],)" + tree);
  REQUIRE(first.status.is_ok());
  CHECK(first.positions == Numbers{0, 0, 1, 1, 0, 1, 0, 1, 1.5, 0, 0, 1, 2, 0, 1, 0, 2, 2});
  CHECK(first.triangles == Triangles{0, 1, 2, 2, 1, 0, 3, 4, 5, 5, 4, 3});
  CHECK(load_glb(R"("scene":1,"scenes":[{"nodes":[0]},{"nodes":[3]}],)" + tree).triangles.size() == 6);
  CHECK(load_glb(tree).triangles.size() == 18);
  CHECK(load_glb(one_mesh).triangles.size() == 6);
  CHECK(load_glb(R"("scenes":[{}],)" + tree).status == Status::empty_mesh);
  CHECK(load_glb(R"("scene":2,"scenes":[{"nodes":[0]}],)" + tree).status == Status::syntax_error);
}

TEST_CASE("glb: primitives share the vertices of a shared accessor and keep their materials") {
  const Loaded shared = load_glb(
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0},{"attributes":{"POSITION":0},"indices":2}]}])");
  REQUIRE(shared.status.is_ok());
  CHECK(shared.positions.size() == 9);
  CHECK(shared.triangles == Triangles{0, 1, 2, 2, 1, 0, 2, 1, 0});
  CHECK(shared.materials == Triangles{1, 1, 0});
  CHECK(load_glb(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])").triangles == Triangles{0, 1, 2});
  CHECK(load_glb(R"("meshes":[{"primitives":[{"mode":5,"attributes":{"POSITION":0},"indices":1}]}])",
                 std::string("\0\1\2\2\1\0", 6))
            .triangles == Triangles{0, 1, 2, 1, 2, 0});
  CHECK(load_glb(R"("meshes":[{"primitives":[{"mode":6,"attributes":{"POSITION":0},"indices":1}]}])").triangles ==
        Triangles{0, 1, 2, 0, 2, 1});
  CHECK(load_glb(R"("meshes":[{"primitives":[{"mode":1,"attributes":{"POSITION":0},"indices":1}]}])").status ==
        Status::empty_mesh);
}

TEST_CASE("glb: integer positions") {
  std::string data;
  for (const unsigned x : {0U, 0x7FFFU, 0x8000U, 0x7FFFU, 0x8001U, 0U, 0U, 0U, 0x7FFFU}) data += binary(x, 2);
  const std::string json =
      R"({"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"bufferViews":[{"byteLength":18}],)"
      R"("accessors":[{"bufferView":0,"componentType":5122,"count":3,"type":"VEC3","normalized":)";
  CHECK(load(support::glb(json + "true}]}", data), FileFormat::glb).positions == Numbers{0, 1, -1, 1, -1, 0, 0, 0, 1});
  CHECK(load(support::glb(json + "false}]}", data), FileFormat::glb).positions ==
        Numbers{0, 32767, -32768, 32767, -32767, 0, 0, 0, 32767});
}

TEST_CASE("glb: what is wrong or not read is named") {
  const auto position = [](int accessor) {
    return R"("meshes":[{"primitives":[{"attributes":{"POSITION":)" + std::to_string(accessor) + R"(},"indices":1}]}])";
  };
  CHECK(load_glb(position(3)).status == Status::unsupported_feature);
  CHECK(load_glb(position(4)).status == Status::truncated_file);
  CHECK(load_glb(position(1)).status == Status::syntax_error);
  CHECK(load_glb(position(9)).status == Status::syntax_error);
  CHECK(load_glb(one_mesh, std::string("\0\1\2\2\1\3", 6)).status == Status::index_out_of_range);
  CHECK(load_glb(R"("extensionsRequired":["KHR_draco_mesh_compression"],)" + one_mesh).status ==
        Status::unsupported_feature);
  CHECK(load_glb(R"("buffers":[{"uri":"x.bin"}],)" + one_mesh).status == Status::unsupported_feature);
  CHECK(load_glb(R"("nodes":[{"children":[0],"mesh":0}],)" + one_mesh).status == Status::empty_mesh);
  CHECK(load_glb(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[0],"mesh":0}],)" + one_mesh).status ==
        Status::syntax_error);
  CHECK(load_glb(R"("scenes":[{"nodes":[0,0]}],"nodes":[{"mesh":0}],)" + one_mesh).status == Status::syntax_error);
  CHECK(load_glb(R"("nodes":[{"children":[2]},{"children":[2]},{"mesh":0}],)" + one_mesh).status ==
        Status::syntax_error);
  CHECK(load_glb(R"("nodes":[{"mesh":1}],)" + one_mesh).status == Status::syntax_error);
  CHECK(load_glb(R"("nodes":[{"mesh":0,"matrix":[1,2,3]}],)" + one_mesh).status == Status::syntax_error);
  for (const char* json :
       {"{", "{]", "[1,]", "{\"a\"}", "{\"a\":}", "{\"a\":1,}", "nul", "1 2", "\"a", "[+1]", "[-]", "[nan]", ""}) {
    CAPTURE(json);
    const Status status = load(support::glb(json, ""), FileFormat::glb).status;
    const bool refused = status == Status::syntax_error || status == Status::truncated_file;
    CHECK(refused);
  }
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  CHECK(load(support::glb(deep, ""), FileFormat::glb, std::size_t{8} << 20).status == Status::empty_mesh);
}
