#include "isolod/files.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <sstream>
#include <utility>

#include "isolod/failure.h"
#include "isolod/json.h"

namespace tool {

namespace {

using isolod::Element;
using isolod::Status;

std::vector<unsigned char> read_bytes(const std::string& path) {
  const auto refuse = [&path]() {
    throw Failure{exit_code(Status::cannot_open),
                  path + ": cannot be read: " + std::strerror(errno) + " [cannot_open]"};
  };
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) refuse();
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> closer(file, std::fclose);
  std::vector<unsigned char> bytes;
  std::size_t used = 0;
  do {
    bytes.resize(std::max<std::size_t>(65536, 2 * used));
    used += std::fread(bytes.data() + used, 1, bytes.size() - used, file);
  } while (used == bytes.size());
  if (std::ferror(file) != 0) refuse();
  bytes.resize(used);
  return bytes;
}

/// Numbers separated by blanks or line ends.
std::vector<double> read_numbers(const std::string& path) {
  std::vector<unsigned char> bytes = read_bytes(path);
  bytes.push_back('\0');
  const char* at = reinterpret_cast<const char*>(bytes.data());
  std::uint64_t line = 1;
  std::vector<double> numbers;
  for (;;) {
    for (; *at == ' ' || *at == '\t' || *at == '\r' || *at == '\n'; ++at) line += *at == '\n' ? 1 : 0;
    if (*at == '\0') return numbers;
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    if (end == at) fail_status(path, Status(Status::syntax_error, Element::line, line));
    at = end;
  }
}

[[noreturn]] void refuse_count(const std::string& path, std::size_t count, const std::string& wanted) {
  throw Failure{exit_code(Status::syntax_error),
                path + ": holds " + std::to_string(count) + " numbers for " + wanted + " [syntax_error]"};
}

bool write_to_file(void* context, const void* bytes, std::size_t count) {
  return static_cast<OutputFile*>(context)->write(bytes, count);
}

}  // namespace

isolod::MeshView InputMesh::view() const {
  isolod::MeshView view = loaded.view();
  if (!vertex_density.empty()) view.vertex_density = vertex_density.data();
  if (!corner_density.empty()) view.corner_density = corner_density.data();
  if (!feature_edges.empty()) view.tagged_edges = feature_edges.data();
  if (!feature_edges.empty()) view.tagged_edge_count = feature_edges.size() / 2;
  if (!feature_density.empty()) view.tagged_edge_density = feature_density.data();
  return view;
}

InputMesh read_mesh_file(const std::string& path) {
  const std::vector<unsigned char> bytes = read_bytes(path);
  const isolod::Span<const unsigned char> file(bytes.data(), bytes.size());
  const isolod::FileFormat format = isolod::format_of_name(path.c_str());
  InputMesh mesh;
  // What a reader needs is a few times the file; how many times depends on the format, so the block grows.
  for (std::size_t room = 65536 + 8 * bytes.size();; room *= 2) {
    mesh.block.reset(new unsigned char[room]);
    isolod::Arena arena(mesh.block.get(), room);
    const Status status = isolod::read_mesh(file, format, mesh.loaded, arena);
    if (status.is_ok()) return mesh;
    const bool can_grow = status == Status::out_of_memory && room / 256 <= 65536 + bytes.size();
    if (!can_grow) fail_status(path, status);
  }
}

std::vector<double> read_density_file(const std::string& path, std::size_t vertex_count) {
  std::vector<double> density = read_numbers(path);
  if (density.size() == vertex_count) return density;
  refuse_count(path, density.size(), std::to_string(vertex_count) + " vertices");
}

void read_density_file(const std::string& path, InputMesh& mesh) {
  std::vector<double> density = read_numbers(path);
  const std::size_t vertices = mesh.loaded.vertex_count(), triangles = mesh.loaded.triangle_count();
  if (density.size() == vertices) {
    mesh.vertex_density = std::move(density);
  } else if (density.size() == 3 * triangles) {
    mesh.corner_density = std::move(density);
  } else {
    refuse_count(path, density.size(),
                 std::to_string(vertices) + " vertices and " + std::to_string(triangles) + " triangles");
  }
}

void read_feature_file(const std::string& path, InputMesh& mesh) {
  const std::vector<unsigned char> bytes = read_bytes(path);
  std::istringstream text(std::string(bytes.begin(), bytes.end()));
  std::string line;
  bool any_density = false;
  for (std::uint64_t number = 1; std::getline(text, line); ++number) {
    const auto refuse = [&](Status::Code code) { fail_status(path, Status(code, Element::line, number)); };
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word[4];
    std::size_t count = 0;
    while (count < 4 && words >> word[count]) ++count;
    if (count == 0) continue;
    if (count != 2 && count != 3) refuse(Status::syntax_error);
    for (std::size_t k = 0; k < 2; ++k) {
      if (word[k].find_first_not_of("0123456789") != std::string::npos) refuse(Status::syntax_error);
      const unsigned long long vertex = std::strtoull(word[k].c_str(), nullptr, 10);
      if (vertex >= mesh.loaded.vertex_count()) refuse(Status::index_out_of_range);
      mesh.feature_edges.push_back(static_cast<std::uint32_t>(vertex));
    }
    char* end = nullptr;
    const double density = count == 3 ? std::strtod(word[2].c_str(), &end) : 0;
    if (count == 3 && *end != '\0') refuse(Status::syntax_error);
    if (count == 3 && !(density > 0 && density < 1e300)) refuse(Status::density_not_positive);
    mesh.feature_density.push_back(density);
    any_density = any_density || count == 3;
  }
  if (!any_density) mesh.feature_density.clear();
}

isolod::WriteOptions write_options(const std::string& path, bool ascii) {
  isolod::WriteOptions options;
  options.format = isolod::format_of_name(path.c_str());
  if (ascii) options.encoding = isolod::Encoding::ascii;
  if (options.format == isolod::FileFormat::unknown) fail_status(path, Status(Status::unknown_format));
  if (options.format == isolod::FileFormat::glb) fail_status(path, Status(Status::unsupported_feature));
  return options;
}

OptionRule hash_rule() {
  return {"--hash", nullptr, "print the hash of the mesh's bits: the same on every machine, whatever the file type"};
}

void print_hash(const TriangleMesh& mesh, const std::string& path) {
  const std::uint64_t hash =
      isolod::hash_of({{mesh.positions.data(), mesh.positions.size()}, {mesh.triangles.data(), mesh.triangles.size()}});
  std::printf("%s  %s\n", hex_digits(hash).c_str(), path.c_str());
}

void write_mesh_file(OutputFile& file, const isolod::WriteOptions& options, const TriangleMesh& mesh) {
  isolod::ByteSink sink;
  sink.context = &file;
  sink.write = write_to_file;
  const Status status = isolod::write_mesh(options, {mesh.positions.data(), mesh.positions.size()},
                                           {mesh.triangles.data(), mesh.triangles.size()}, sink);
  if (!status.is_ok() && status != Status::sink_failed) fail_status(file.path(), status);
  file.commit();
}

}  // namespace tool
