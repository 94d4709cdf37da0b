// OBJ and OFF, the formats' recognition, and the writers' bytes.
#include <doctest/doctest.h>

#include "support/files.h"

using namespace isolod;
using support::load;
using support::Loaded;

namespace {

using Triangles = std::vector<std::uint32_t>;

void check_fails(const std::string& file, FileFormat format, Status::Code code, std::uint64_t line) {
  CAPTURE(file);
  const Loaded loaded = load(file, format);
  CHECK(loaded.status.code == code);
  CHECK(loaded.status.value == line);
  CHECK(loaded.positions.empty());
  CHECK(loaded.triangles.empty());
}

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("obj: corner forms, relative indices, joined lines, and vertices after their faces") {
  for (const char* face : {"f 1 2 3", "f 1/1 2/2 3/3", "f 1//1 2//2 3//3", "f 1/1/1 2/2/2 3/3/3", "f 1// 2// 3//",
                           "f -3 -2 -1", "f 1 \\\n2 \\\r\n 3", "f\t1 2  3  # end", "  f +1 2 3\r", "f\\\n1 2 3"}) {
    CAPTURE(face);
    const Loaded loaded = load(three + face, FileFormat::obj);
    CHECK(loaded.status.is_ok());
    CHECK(loaded.triangles == Triangles{0, 1, 2});
    CHECK(loaded.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
    CHECK(loaded.materials.empty());
    CHECK(!loaded.welded);
  }
  CHECK(load("v 0 0 0 \\\nv 9 9 9\n" + three + "f 2 3 4 # \\\nf 4 3 2\n", FileFormat::obj).triangles ==
        Triangles{1, 2, 3, 3, 2, 1});
  CHECK(load("f 1 2 3\n" + three, FileFormat::obj).triangles == Triangles{0, 1, 2});
  CHECK(load("\xEF\xBB\xBF" + three + "f 1 2 3", FileFormat::obj).status.is_ok());
  CHECK(load("v 1 2 3 0.5\rv 4 5 6 1 0 0\rv 7 \\\r\n8 9\rf 3 2 1\r", FileFormat::obj).positions ==
        std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9});
}

TEST_CASE("obj: materials are numbered in the order in which they come, 0 before the first") {
  const Loaded loaded = load(
      three + "f 1 2 3\nusemtl b  \ng x\nf 1 2 3\nusemtl a a\nf 1 2 3\n usemtl b\nf 3 2 1\nusemtl", FileFormat::obj);
  CHECK(loaded.status.is_ok());
  CHECK(loaded.materials == Triangles{0, 1, 2, 1});
  CHECK(load(three + "v 1 1 0\nusemtl q\nf 1 2 4 3\n", FileFormat::obj).materials == Triangles{1, 1});
}

TEST_CASE("obj: failures name their line") {
  check_fails(three + "f 1 2\n", FileFormat::obj, Status::syntax_error, 4);
  check_fails(three + "f 1 2 4\n", FileFormat::obj, Status::index_out_of_range, 4);
  check_fails(three + "f 1 2 0\n", FileFormat::obj, Status::index_out_of_range, 4);
  check_fails(three + "f 1 2 -4\n", FileFormat::obj, Status::index_out_of_range, 4);
  check_fails("f -1 -2 -3\n" + three, FileFormat::obj, Status::index_out_of_range, 1);
  check_fails(three + "f 1 2 3x\n", FileFormat::obj, Status::syntax_error, 4);
  check_fails(three + "f 1 2 3/x\n", FileFormat::obj, Status::syntax_error, 4);
  check_fails(three + "\nf 1 2 \\3 \\\n", FileFormat::obj, Status::syntax_error, 5);
  check_fails(three + "f 1 2 3 \\\nv 9 9 9\n", FileFormat::obj, Status::syntax_error, 5);  // no line of its own
  check_fails("v 0 0\nf 1 1 1\n", FileFormat::obj, Status::syntax_error, 1);
  check_fails("v 0 0 3.1+e2\nf 1 1 1\n", FileFormat::obj, Status::syntax_error, 1);
  check_fails("v 0 0 0x10\nf 1 1 1\n", FileFormat::obj, Status::syntax_error, 1);
  check_fails("v 0 0 1,5\nf 1 1 1\n", FileFormat::obj, Status::syntax_error, 1);
  check_fails(three, FileFormat::obj, Status::empty_mesh, 0);
  check_fails("", FileFormat::obj, Status::empty_mesh, 0);
  check_fails(std::string("\xFE\xFF\0v", 4), FileFormat::obj, Status::unsupported_feature, 1);
  check_fails(std::string("v\0 \0", 4), FileFormat::obj, Status::unsupported_feature, 1);
}

TEST_CASE("obj: NaN and infinity are numbers, for the door to refuse") {
  const Loaded loaded = load("v nan -inf 1.#IND\nv 1 2 3\nv 1e400 -1e-400 0\nf 1 2 3\n", FileFormat::obj);
  CHECK(loaded.status.is_ok());
  CHECK(loaded.positions[0] != loaded.positions[0]);
  CHECK(loaded.positions[1] < -1e308);
  CHECK(loaded.positions[6] > 1e308);
}

TEST_CASE("off: headers and what follows on a line") {
  const std::string rest = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* header :
       {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF\n3 1\n", "3 1 0\n", "OFF # c\n# c\n\n3 1 3 # c\n\n", "OFF\r\n3 1 0\r\n",
        "COFF\n3 1 0\n", "NOFF\n3 1 0\n", "CNOFF\n3 1 0\n", "STOFF\n3 1 0\n", "STCNOFF\n3 1 0\n", "OFF\r3 1 0\r"}) {
    CAPTURE(header);
    const Loaded loaded = load(header + rest, FileFormat::off);
    CHECK(loaded.status.is_ok());
    CHECK(loaded.triangles == Triangles{0, 1, 2});
    CHECK(loaded.positions.size() == 9);
  }
  const Loaded coloured =
      load("CNOFF\n3 1 0\n0 0 0 1 0 0 255 0 0 1\n\n1 0 0 #c\n\t0 1 0 9\n\n3 0 1 2 0.5 0.5 0.5\n", FileFormat::off);
  CHECK(coloured.positions == std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0});
}

TEST_CASE("off: failures name their line, and no count is believed") {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  check_fails("OFF\n353535235358 6 0\n" + points, FileFormat::off, Status::truncated_file, 2);
  check_fails("OFF\n3 99999999999999999999 0\n" + points, FileFormat::off, Status::truncated_file, 2);
  check_fails("OFF\n-3 1 0\n" + points, FileFormat::off, Status::syntax_error, 2);
  check_fails("OFF\n3 1 0\n" + points, FileFormat::off, Status::truncated_file, 6);
  check_fails("OFF\n3 1 0\n" + points + "3 0 1 3\n", FileFormat::off, Status::index_out_of_range, 6);
  check_fails("OFF\n3 1 0\n" + points + "3 0 1 -1\n", FileFormat::off, Status::index_out_of_range, 6);
  check_fails("OFF\n3 1 0\n" + points + "2 0 1\n", FileFormat::off, Status::syntax_error, 6);
  check_fails("OFF\n3 1 0\n" + points + "9999999 0 1\n", FileFormat::off, Status::truncated_file, 6);
  check_fails("OFF\n3 2 0\n" + points + "9 0 1\n3 0 1 2 0 0 0 0 0 0\n", FileFormat::off, Status::syntax_error, 6);
  check_fails("OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n", FileFormat::off, Status::syntax_error, 3);
  check_fails("4OFF\n3 1 0\n", FileFormat::off, Status::unsupported_feature, 1);
  check_fails("nOFF 5\n3 1 0\n", FileFormat::off, Status::unsupported_feature, 1);
  check_fails("OFF BINARY\n3 1 0\n", FileFormat::off, Status::unsupported_feature, 1);
  check_fails("FOO\n3 1 0\n", FileFormat::off, Status::syntax_error, 1);
  check_fails("", FileFormat::off, Status::truncated_file, 1);
}

TEST_CASE("formats are known by name and by content") {
  CHECK(format_of_name("a/b.OBJ") == FileFormat::obj);
  CHECK(format_of_name("x.stl.off") == FileFormat::off);
  CHECK(format_of_name(".ply") == FileFormat::ply);
  CHECK(format_of_name("a.Stl") == FileFormat::stl);
  CHECK(format_of_name("a.glb") == FileFormat::glb);
  CHECK(format_of_name("a.gltf") == FileFormat::unknown);
  CHECK(format_of_name("") == FileFormat::unknown);
  CHECK(format_of_name(nullptr) == FileFormat::unknown);
  for (const support::SmallFile& file : support::small_files()) {
    CAPTURE(file.name);
    CHECK(format_of_content(support::bytes(file.content)) == file.format);
    CHECK(load(file.content, FileFormat::unknown).status.is_ok());
  }
  for (const char* text : {"", "hello world", "{}", "plywood", "OFFICE", "# only a comment"}) {
    CAPTURE(text);
    CHECK(format_of_content(support::bytes(text)) == FileFormat::unknown);
    CHECK(load(text, FileFormat::unknown).status == Status::unknown_format);
  }
  CHECK(std::string(name(FileFormat::ply)) == "ply");
}

TEST_CASE("view: what was read goes to the main call as it is") {
  support::Block block(4096);
  LoadedMesh mesh;
  const std::string file = three + "usemtl m\nf 1 2 3\n";
  REQUIRE(read_mesh(support::bytes(file), FileFormat::obj, mesh, block.arena).is_ok());
  const MeshView view = mesh.view();
  CHECK(view.vertex_count == 3);
  CHECK(view.triangle_count == 1);
  CHECK(view.positions == mesh.positions.data);
  CHECK(view.indices == mesh.triangles.data);
  CHECK(view.triangle_materials == mesh.triangle_materials.data);
  CHECK(view.position_type == ScalarType::float64);
  CHECK(view.index_type == IndexType::uint32);
}

TEST_CASE("writers: the bytes of a small mesh") {
  const std::vector<double> positions = {0, 0, 0, 1, -0.5, 1e-7, 0.1, 1e20, 3};
  const Triangles triangles = {0, 1, 2, 2, 1, 0};
  std::string out;
  REQUIRE(support::write(out, {FileFormat::obj, Encoding::ascii}, positions, triangles).is_ok());
  CHECK(out == "v 0 0 0\nv 1 -0.5 1e-7\nv 0.1 1e20 3\nf 1 2 3\nf 3 2 1\n");
  out.clear();
  REQUIRE(support::write(out, {FileFormat::off, Encoding::little_endian}, positions, triangles).is_ok());
  CHECK(out == "OFF\n3 2 0\n0 0 0\n1 -0.5 1e-7\n0.1 1e20 3\n3 0 1 2\n3 2 1 0\n");
  out.clear();
  REQUIRE(support::write(out, {FileFormat::ply, Encoding::ascii}, positions, triangles).is_ok());
  CHECK(out ==
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 -0.5 1e-7\n0.1 1e20 3\n3 0 1 2\n3 2 1 0\n");
  out.clear();
  REQUIRE(
      support::write(out, {FileFormat::stl, Encoding::ascii}, {0, 0, 0, 2, 0, 0, 0, 2, 0}, {0, 1, 2, 0, 0, 1}).is_ok());
  CHECK(
      out ==
      "solid isolod\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 2 0\nendloop\nendfacet\n"
      "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 2 0 0\nendloop\nendfacet\nendsolid isolod\n");
}

TEST_CASE("writers: everything is checked before the first byte") {
  std::string out;
  const std::vector<double> good = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<double> nan = {0, 0, 0, 1, 0, 0.0 / (good[0] + 0.0), 0, 1, 0};
  const Status not_finite = support::write(out, {FileFormat::obj, Encoding::ascii}, nan, {0, 1, 2});
  CHECK(not_finite == Status::position_not_finite);
  CHECK(not_finite.value == 1);
  const Status far_index = support::write(out, {FileFormat::off, Encoding::ascii}, good, {0, 1, 2, 0, 3, 1});
  CHECK(far_index == Status::index_out_of_range);
  CHECK(far_index.value == 1);
  CHECK(support::write(out, {FileFormat::stl, Encoding::little_endian}, {0, 0, 0, 1e39, 0, 0, 0, 1, 0}, {0, 1, 2}) ==
        Status::position_not_finite);
  CHECK(support::write(out, {FileFormat::glb, Encoding::little_endian}, good, {0, 1, 2}) == Status::unknown_format);
  CHECK(support::write(out, {FileFormat::stl, Encoding::big_endian}, good, {0, 1, 2}) == Status::invalid_option);
  CHECK(out.empty());
  const auto refuse = [](void*, const void*, std::size_t) { return false; };
  const std::uint32_t triangle[] = {0, 1, 2};
  CHECK(write_mesh({FileFormat::obj, Encoding::ascii}, {good.data(), 9}, {triangle, 3}, {nullptr, refuse}) ==
        Status::sink_failed);
  CHECK(write_mesh({FileFormat::obj, Encoding::ascii}, {good.data(), 9}, {triangle, 3}, {}) == Status::sink_failed);
}

TEST_CASE("writers: what is written is read back, bit for bit") {
  std::vector<double> positions;
  Triangles triangles;
  std::uint64_t state = 3;
  for (int i = 0; i < 300; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    positions.push_back(static_cast<double>(state >> 11) / 9007199254740992.0 * (i % 7 == 0 ? 1e-9 : 1e3));
  }
  for (std::uint32_t i = 0; i + 2 < 100; ++i) triangles.insert(triangles.end(), {i, i + 1, i + 2});
  for (const FileFormat format : {FileFormat::obj, FileFormat::off, FileFormat::ply, FileFormat::stl}) {
    for (const Encoding encoding : {Encoding::ascii, Encoding::little_endian, Encoding::big_endian}) {
      if (format == FileFormat::stl && encoding == Encoding::big_endian) continue;
      std::string out;
      REQUIRE(support::write(out, {format, encoding}, positions, triangles).is_ok());
      CHECK(format_of_content(support::bytes(out)) == format);
      const Loaded loaded = load(out, format);
      CAPTURE(name(format));
      CHECK(loaded.status.is_ok());
      CHECK(loaded.triangles == triangles);
      CHECK(loaded.welded == (format == FileFormat::stl));
      if (format == FileFormat::stl && encoding != Encoding::ascii) {
        REQUIRE(loaded.positions.size() == positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
          CHECK(loaded.positions[i] == static_cast<double>(static_cast<float>(positions[i])));
        }
      } else {
        CHECK(loaded.positions == positions);
      }
    }
  }
}
