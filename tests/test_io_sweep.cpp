// Every reader over damaged files and too small arenas, and over the models where these are there.
#include <doctest/doctest.h>

#include <cstdlib>

#include "support/files.h"

using namespace isolod;
using support::Block;
using support::bytes;
using support::load;
using support::Loaded;
using support::SmallFile;

namespace {

/// Any status will do, but what is loaded must be whole and what fails must leave nothing.
void check_sane(const std::string& content, FileFormat format, Block& block) {
  // On the heap and of exactly this size, so that a sanitizer sees a byte read too far.
  const std::vector<char> exact(content.begin(), content.end());
  LoadedMesh mesh;
  const ArenaMark before = block.arena.mark();
  const Status status =
      read_mesh({reinterpret_cast<const unsigned char*>(exact.data()), exact.size()}, format, mesh, block.arena);
  bool sane = true;
  if (status.is_ok()) {
    for (const std::uint32_t v : mesh.triangles) sane = sane && v < mesh.vertex_count();
    sane = sane && (mesh.triangle_materials.empty() || mesh.triangle_materials.count == mesh.triangle_count());
    sane = sane && block.arena.mark().back == before.back;
  } else {
    sane = mesh.triangles.empty() && mesh.positions.empty() && block.arena.used() == before.front + before.back;
  }
  if (!sane) FAIL_CHECK("a damaged file left something behind");
  block.arena.rewind_results(before);
}

}  // namespace

TEST_CASE("sweep: every beginning of every small file") {
  Block block(std::size_t{1} << 20);
  for (const SmallFile& file : support::small_files()) {
    CAPTURE(file.name);
    for (std::size_t length = 0; length <= file.content.size(); ++length) {
      check_sane(file.content.substr(0, length), file.format, block);
      check_sane(file.content.substr(0, length), FileFormat::unknown, block);
    }
  }
}

TEST_CASE("sweep: every byte of every small file changed") {
  Block block(std::size_t{1} << 20);
  for (const SmallFile& file : support::small_files()) {
    CAPTURE(file.name);
    for (std::size_t at = 0; at < file.content.size(); ++at) {
      std::string changed = file.content;
      for (int bit = 0; bit < 8; ++bit) {
        changed[at] = static_cast<char>(file.content[at] ^ (1 << bit));
        check_sane(changed, file.format, block);
      }
      for (const char c : {'\0', '\xFF', '9', '-', '\n', ' ', '}', '"'}) {
        changed[at] = c;
        check_sane(changed, file.format, block);
      }
    }
  }
}

TEST_CASE("sweep: every file read as every other format") {
  Block block(std::size_t{1} << 20);
  for (const SmallFile& file : support::small_files()) {
    for (const FileFormat format :
         {FileFormat::obj, FileFormat::off, FileFormat::ply, FileFormat::stl, FileFormat::glb}) {
      check_sane(file.content, format, block);
    }
  }
}

TEST_CASE("sweep: every arena from nothing to enough") {
  for (const SmallFile& file : support::small_files()) {
    CAPTURE(file.name);
    bool was_read = false;
    for (std::size_t size = 0; size < 65536 && !was_read; size += 16) {
      Block block(size + 48);
      Span<char> held;
      REQUIRE(block.arena.scratch(16, held).is_ok());
      const std::size_t used = block.arena.used();
      LoadedMesh mesh;
      const Status status = read_mesh(bytes(file.content), file.format, mesh, block.arena);
      was_read = status.is_ok();
      if (was_read) continue;
      CHECK(status == Status::out_of_memory);
      CHECK(status.value > size);
      CHECK(block.arena.used() == used);
    }
    CHECK(was_read);
  }
}

namespace {

std::string models() {
  const char* path = std::getenv("ISOLOD_MODELS");
  return path != nullptr ? std::string(path) + "/" : support::model_directory();
}

/// Positions in the order of the triangles' corners: what stays the same however vertices are numbered.
std::vector<double> corner_positions(const Loaded& mesh) {
  std::vector<double> all;
  for (const std::uint32_t v : mesh.triangles)
    all.insert(all.end(), mesh.positions.begin() + 3 * v, mesh.positions.begin() + 3 * v + 3);
  return all;
}

}  // namespace

TEST_CASE("models: good ones have the counts that their manifest says") {
  struct Model {
    const char* name;
    std::size_t vertices, triangles;
  };
  for (const Model& model : {Model{"cgal-bunny00.off", 37706, 75408}, Model{"cgal-3torus.off", 19, 46},
                             Model{"gpjs-kitten.obj", 9447, 18894}, Model{"bff-punctured-torus.obj", 4599, 9184},
                             Model{"stlm-gearwheel.bin.stl", 1222, 2444}, Model{"mani-moon.glb", 2551, 5000},
                             Model{"tri-Duck.glb", 2399, 4212}, Model{"tri-testplate.glb", 398, 264}}) {
    const std::string file = support::read_file(models() + "good/" + model.name);
    if (file.empty()) continue;
    CAPTURE(model.name);
    const Loaded loaded = load(file, format_of_name(model.name), std::size_t{16} << 20);
    CHECK(loaded.status.is_ok());
    CHECK(loaded.positions.size() == 3 * model.vertices);
    CHECK(loaded.triangles.size() == 3 * model.triangles);
    CHECK(format_of_content(bytes(file)) == format_of_name(model.name));
  }
}

TEST_CASE("models: binary files hold the same triangles as their twins in text") {
  for (const char* name : {"stlm-gearwheel.bin.stl", "mani-moon.glb", "tri-testplate.glb", "tri-Duck.glb"}) {
    const std::string file = support::read_file(models() + "good/" + name);
    const std::string text = support::read_file(models() + "twins/" + name + ".off");
    if (file.empty() || text.empty()) continue;
    CAPTURE(name);
    const std::vector<double> a = corner_positions(load(file, format_of_name(name), std::size_t{16} << 20));
    const std::vector<double> b = corner_positions(load(text, FileFormat::off, std::size_t{16} << 20));
    REQUIRE(a.size() == b.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] - b[i] > 1e-5 || b[i] - a[i] > 1e-5) ++different;
    }
    CHECK(different == 0);
  }
}

TEST_CASE("models: bad ones give the status that they deserve") {
  struct Bad {
    const char* name;
    Status::Code code;
    std::uint64_t value;  // of the status, or the number of triangles
  };
  const Bad all[] = {
      {"assi-BoxWithInfinites.glb", Status::ok, 12},
      {"assi-OutOfMemory.off", Status::truncated_file, 2},
      {"assi-box_UTF16BE.obj", Status::unsupported_feature, 1},
      {"assi-cube_binary_starts_with_nl.ply", Status::ok, 12},
      {"assi-invalid.off", Status::syntax_error, 6},
      {"assi-malformed.obj", Status::index_out_of_range, 23},
      {"assi-number_formats.obj", Status::syntax_error, 11},
      {"gltfv-invalid_magic.glb", Status::syntax_error, 0},
      {"gltfv-length_mismatch.glb", Status::truncated_file, 48},
      {"gltfv-truncated_chunk_data.glb", Status::truncated_file, 47},
      {"stlm-fourVertices.ascii.stl", Status::ok, 5},
      {"tiny-invalid-relative-vertex-index.obj", Status::index_out_of_range, 1},
      {"tiny-test-nan.obj", Status::ok, 36},
      {"tri-notenoughindices.obj", Status::syntax_error, 9},
      {"tri-obj_points.obj", Status::empty_mesh, 0},
      {"tri-ply_empty_header.ply", Status::empty_mesh, 0},
      {"tri-soup.stl", Status::ok, 100},
      {"gc-moebius.obj", Status::ok, 448},
  };
  for (const Bad& bad : all) {
    const std::string file = support::read_file(models() + "bad/" + bad.name);
    if (file.empty()) continue;
    CAPTURE(bad.name);
    const Loaded loaded = load(file, format_of_name(bad.name), std::size_t{16} << 20);
    CHECK(loaded.status.code == bad.code);
    CHECK((loaded.status.is_ok() ? loaded.triangles.size() / 3 : loaded.status.value) == bad.value);
  }
}
