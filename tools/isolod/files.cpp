#include "isolod/files.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "isolod/failure.h"

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

bool write_to_file(void* context, const void* bytes, std::size_t count) {
  return static_cast<OutputFile*>(context)->write(bytes, count);
}

}  // namespace

isolod::MeshView InputMesh::view() const {
  isolod::MeshView view = loaded.view();
  if (!vertex_density.empty()) view.vertex_density = vertex_density.data();
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
  std::vector<unsigned char> bytes = read_bytes(path);
  bytes.push_back('\0');
  const char* at = reinterpret_cast<const char*>(bytes.data());
  std::uint64_t line = 1;
  std::vector<double> density;
  for (;;) {
    for (; *at == ' ' || *at == '\t' || *at == '\r' || *at == '\n'; ++at) line += *at == '\n' ? 1 : 0;
    if (*at == '\0') break;
    char* end = nullptr;
    density.push_back(std::strtod(at, &end));
    if (end == at) fail_status(path, Status(Status::syntax_error, Element::line, line));
    at = end;
  }
  if (density.size() == vertex_count) return density;
  throw Failure{exit_code(Status::syntax_error), path + ": holds " + std::to_string(density.size()) + " numbers for " +
                                                     std::to_string(vertex_count) + " vertices [syntax_error]"};
}

isolod::WriteOptions write_options(const std::string& path, bool ascii) {
  isolod::WriteOptions options;
  options.format = isolod::format_of_name(path.c_str());
  if (ascii) options.encoding = isolod::Encoding::ascii;
  if (options.format == isolod::FileFormat::unknown) fail_status(path, Status(Status::unknown_format));
  if (options.format == isolod::FileFormat::glb) fail_status(path, Status(Status::unsupported_feature));
  return options;
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
