// What a board does: a bumpy torus of 2,000 vertices becomes levels of detail of 500 and 125 vertices, in 2 MB of
// static memory in all: the shape, the library's block and what came out. Prints hashes, the peak, and the instructions
// where the machine counts them.
#include "isolod/isolod.h"
#include "platform.h"

namespace {

constexpr std::uint32_t columns = 50, rows = 40;
constexpr std::uint32_t shape_vertices = columns * rows, shape_triangles = 2 * shape_vertices;
constexpr std::uint32_t level_vertices[2] = {500, 125};

/// A level of detail, kept as a program would that draws it.
struct Level {
  float positions[3 * level_vertices[0]];
  std::uint16_t triangles[6 * level_vertices[0]];  // a torus has two a vertex
  std::size_t vertex_count, triangle_count;
};

struct Memory {
  float positions[3 * shape_vertices];
  std::uint16_t triangles[3 * shape_triangles];
  Level levels[2];
  alignas(16) unsigned char block[(2 << 20) - (150 << 10)];
};
static_assert(sizeof(Memory) <= 2 << 20, "all there is");

ISOLOD_STATIC_BLOCK Memory memory;

/// A point of the unit circle, by two parabolas: not even, but round enough, and no sine.
void point_of_circle(std::uint32_t i, std::uint32_t count, float& x, float& y) {
  const float t = 4.0F * static_cast<float>(i) / static_cast<float>(count), u = t < 2 ? t - 1 : t - 3;
  const float s = 2 * u / (1 + u * u), c = (1 - u * u) / (1 + u * u);
  x = t < 2 ? -s : s;
  y = t < 2 ? c : -c;
}

void make_shape() {
  for (std::uint32_t i = 0; i < columns; ++i) {
    for (std::uint32_t j = 0; j < rows; ++j) {
      float cu, su, cv, sv;
      point_of_circle(i, columns, cu, su);
      point_of_circle(j, rows, cv, sv);
      const float thick = 0.4F + 0.1F * cu * su, radius = 1 + thick * cv;
      float* xyz = &memory.positions[3 * (i * rows + j)];
      xyz[0] = radius * cu, xyz[1] = radius * su, xyz[2] = thick * sv;
      const auto at = [](std::uint32_t k, std::uint32_t l) {
        return static_cast<std::uint16_t>(k % columns * rows + l % rows);
      };
      std::uint16_t* corners = &memory.triangles[6 * (i * rows + j)];
      corners[0] = corners[3] = at(i, j), corners[1] = at(i + 1, j);
      corners[2] = corners[4] = at(i + 1, j + 1), corners[5] = at(i, j + 1);
    }
  }
}

isolod::MeshSink sink_of(Level& level) {
  isolod::MeshSink sink;
  sink.context = &level;
  sink.vertices = [](void* to, const double* xyz, std::size_t count) {
    Level& kept = *static_cast<Level*>(to);
    kept.vertex_count = count;
    for (std::size_t i = 0; i < 3 * count; ++i) kept.positions[i] = static_cast<float>(xyz[i]);
    return true;
  };
  sink.triangles = [](void* to, const std::uint32_t* corners, std::size_t count) {
    Level& kept = *static_cast<Level*>(to);
    kept.triangle_count = count;
    for (std::size_t i = 0; i < 3 * count; ++i) kept.triangles[i] = static_cast<std::uint16_t>(corners[i]);
    return true;
  };
  return sink;
}

void say_number(const char* name, std::uint64_t value, std::uint32_t base = 10) {
  char text[24];
  char* at = text + sizeof text - 1;
  *at = '\0';
  do {
    *--at = "0123456789abcdef"[value % base];
    value /= base;
  } while (value != 0);
  platform::say(name);
  platform::say(": ");
  platform::say(at);
  platform::say("\n");
}

/// FNV-1a over the numbers of a level, byte for byte from the lowest.
std::uint64_t hash_of(const Level& level) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](std::uint32_t value) {
    for (int i = 0; i < 4; ++i, value >>= 8) hash = (hash ^ (value & 255)) * 0x100000001b3;
  };
  for (std::size_t i = 0; i < 3 * level.vertex_count; ++i) {
    std::uint32_t bits;
    static_assert(sizeof bits == sizeof(float), "IEEE 754");
    __builtin_memcpy(&bits, &level.positions[i], sizeof bits);
    add(bits);
  }
  for (std::size_t i = 0; i < 3 * level.triangle_count; ++i) add(level.triangles[i]);
  return hash;
}

}  // namespace

int main() {
  make_shape();
  isolod::MeshView view;
  view.positions = memory.positions;
  view.position_type = isolod::ScalarType::float32;
  view.vertex_count = shape_vertices;
  view.indices = memory.triangles;
  view.index_type = isolod::IndexType::uint16;
  view.triangle_count = shape_triangles;

  isolod::LodRequest requests[2] = {{level_vertices[0], sink_of(memory.levels[0])},
                                    {level_vertices[1], sink_of(memory.levels[1])}};
  isolod::Arena arena(memory.block, sizeof memory.block);
  isolod::Report report;
  const std::uint64_t before = platform::instructions();
  const isolod::Status status = isolod::build_lods(view, {}, {requests, 2}, &report, arena);
  const std::uint64_t instructions = platform::instructions() - before;

  platform::say(isolod::name(status.code));
  platform::say("\n");
  if (!status.is_ok()) say_number(isolod::name(status.element), status.value);
  for (const Level& level : memory.levels) {
    say_number("vertices", level.vertex_count);
    say_number("hash", hash_of(level), 16);
  }
  say_number("peak of the block, bytes", report.arena_bytes);
  if (instructions != 0) say_number("instructions", instructions);
  if (platform::stack_bytes() != 0) say_number("stack, bytes", platform::stack_bytes());
  return status.is_ok() ? 0 : 1;
}
