// PROGRAM FILE.off HASH: remeshes the file with the library as it was got, and compares the result's hash.
#include "isolod/isolod.h"
#include "small_mesh.h"

#if defined(__NO_MATH_ERRNO__)
#error "the library's own flags reached a program that uses it"
#endif

#if defined(VENDOR_WITH_IO)
#include "isolod/io.h"

// The file once more, by the library's reader, which has to give the same.
static bool reads_the_same(const char* path, const small_mesh& mesh, isolod::Arena& arena) {
  static unsigned char bytes[1 << 16];
  FILE* file = fopen(path, "rb");
  const std::size_t count = file != nullptr ? fread(bytes, 1, sizeof bytes, file) : 0;
  if (file != nullptr) fclose(file);
  isolod::LoadedMesh loaded;
  if (!isolod::read_mesh({bytes, count}, isolod::FileFormat::off, loaded, arena).is_ok()) return false;
  return isolod::hash_of({loaded.positions, loaded.triangles}) ==
         isolod::hash_of({{mesh.positions, 3 * mesh.vertex_count}, {mesh.triangles, 3 * mesh.triangle_count}});
}
#else
static bool reads_the_same(const char*, const small_mesh&, isolod::Arena&) { return true; }
#endif

static unsigned char block[16 << 20];
static small_mesh in, out;

static bool take_vertices(void*, const double* xyz, std::size_t count) {
  out.vertex_count = count;
  for (std::size_t i = 0; i < 3 * count; ++i) out.positions[i] = xyz[i];
  return true;
}

static bool take_triangles(void*, const std::uint32_t* corners, std::size_t count) {
  out.triangle_count = count;
  for (std::size_t i = 0; i < 3 * count; ++i) out.triangles[i] = corners[i];
  return true;
}

int main(int count, char** words) {
  isolod::Arena arena(block, sizeof block);
  if (count != 3 || !read_small_mesh(words[1], &in) || !reads_the_same(words[1], in, arena)) return 2;
  isolod::MeshView view;
  view.positions = in.positions;
  view.vertex_count = in.vertex_count;
  view.indices = in.triangles;
  view.triangle_count = in.triangle_count;
  isolod::Options options;
  options.vertex_count = wished_vertices;
  isolod::MeshSink sink;
  sink.vertices = take_vertices;
  sink.triangles = take_triangles;
  isolod::Report report;
  const isolod::Status status = isolod::remesh(view, options, sink, &report, arena);
  const std::uint64_t hash =
      isolod::hash_of({{out.positions, 3 * out.vertex_count}, {out.triangles, 3 * out.triangle_count}});
  if (!status.is_ok() || hash != report.result_hash || out.vertex_count != wished_vertices ||
      isolod::output_version() != ISOLOD_OUTPUT_VERSION) {
    printf("%s\n", isolod::message(status.code));
    return 3;
  }
  return judge(hash, words[2]);
}
