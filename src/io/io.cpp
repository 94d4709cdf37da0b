// The door of io.h: which format it is, and which reader reads it.
#include "isolod/io.h"

#include "base/environment.h"
#include "io/readers.h"
#include "io/text.h"

namespace isolod {
inline namespace v1 {

namespace {

/// True if the text begins with a line that OBJ, but no other format here, begins with.
bool looks_like_obj(Span<const unsigned char> file) {
  TextCursor cursor;
  if (!begin_text(file, cursor).is_ok() || !skip_to_content(cursor)) return false;
  const Span<const unsigned char> word = take_word(cursor);
  constexpr const char* keywords[] = {"v", "vt", "vn", "vp", "f", "g", "o", "s", "l", "p", "mtllib", "usemtl"};
  for (const char* keyword : keywords) {
    if (equal(word, keyword)) return true;
  }
  return false;
}

bool looks_like_off(Span<const unsigned char> file) {
  TextCursor cursor;
  if (!begin_text(file, cursor).is_ok() || !skip_to_content(cursor)) return false;
  const Span<const unsigned char> word = take_word(cursor);
  return word.count >= 3 && word.count <= 9 && equal(word.slice(word.count - 3, 3), "OFF");
}

bool begins_with_word(Span<const unsigned char> file, const char* word) {
  TextCursor cursor = {file.begin(), file.end(), 1};
  skip_to_content(cursor);
  return equal(take_word(cursor), word);
}

bool ends_with(const char* path, const char* ending) {
  std::size_t length = 0, wanted = 0;
  while (path[length] != '\0') ++length;
  while (ending[wanted] != '\0') ++wanted;
  if (length < wanted) return false;
  for (std::size_t i = 0; i < wanted; ++i) {
    const char c = path[length - wanted + i];
    const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    if (lower != ending[i]) return false;
  }
  return true;
}

Status read_as(FileFormat format, Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena) {
  switch (format) {
    case FileFormat::obj:
      return read_obj(file, mesh, arena);
    case FileFormat::off:
      return read_off(file, mesh, arena);
    case FileFormat::ply:
      return read_ply(file, mesh, arena);
    case FileFormat::stl:
      return read_stl(file, mesh, arena);
    case FileFormat::glb:
      return read_glb(file, mesh, arena);
    case FileFormat::unknown:
      break;
  }
  return fail(Status::unknown_format);
}

}  // namespace

FileFormat format_of_name(const char* path) {
  if (path == nullptr) return FileFormat::unknown;
  constexpr FileFormat formats[] = {FileFormat::obj, FileFormat::off, FileFormat::ply, FileFormat::stl,
                                    FileFormat::glb};
  constexpr const char* endings[] = {".obj", ".off", ".ply", ".stl", ".glb"};
  for (std::size_t i = 0; i < 5; ++i) {
    if (ends_with(path, endings[i])) return formats[i];
  }
  return FileFormat::unknown;
}

FileFormat format_of_content(Span<const unsigned char> file) {
  if (is_binary_stl(file)) return FileFormat::stl;
  if (file.count >= 4 && equal(file.first(4), "glTF")) return FileFormat::glb;
  if (file.count >= 4 && equal(file.first(3), "ply") && is_line_end(file[3])) return FileFormat::ply;
  if (begins_with_word(file, "solid")) return FileFormat::stl;
  if (looks_like_off(file)) return FileFormat::off;
  return looks_like_obj(file) ? FileFormat::obj : FileFormat::unknown;
}

const char* name(FileFormat format) {
  switch (format) {
    case FileFormat::unknown:
      return "unknown";
    case FileFormat::obj:
      return "obj";
    case FileFormat::off:
      return "off";
    case FileFormat::ply:
      return "ply";
    case FileFormat::stl:
      return "stl";
    case FileFormat::glb:
      return "glb";
  }
  return "unknown";
}

MeshView LoadedMesh::view() const {
  MeshView view;
  view.positions = positions.data;
  view.vertex_count = vertex_count();
  view.indices = triangles.data;
  view.triangle_count = triangle_count();
  view.triangle_materials = triangle_materials.data;
  return view;
}

Status read_mesh(Span<const unsigned char> file, FileFormat format, LoadedMesh& mesh, Arena& arena) {
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  const ArenaMark mark = arena.mark();
  mesh = {};
  if (format == FileFormat::unknown) format = format_of_content(file);
  Status status = read_as(format, file, mesh, arena);
  if (status.is_ok() && mesh.triangles.empty()) status = fail(Status::empty_mesh);
  arena.rewind_scratch(mark);
  if (status.is_ok()) return status;
  arena.rewind_results(mark);
  mesh = {};
  return status;
}

}  // namespace v1
}  // namespace isolod
