// From measures to one line of text.
#include "support/checker.h"

#include <cstring>

namespace checker {

namespace {

void want(std::string& text, const char* what, long found, long wanted) {
  if (wanted == -1 || found == wanted) return;
  text += std::string(text.empty() ? "" : ", ") + what + " " + std::to_string(found);
  if (wanted != 0) text += " instead of " + std::to_string(wanted);
}

void want_none(std::string& text, const char* what, std::size_t found) { want(text, what, long(found), 0); }

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

}  // namespace

Promise promise_of(const measure::Surface& original) {
  const measure::Topology t = measure::topology(original);
  Promise promise;
  promise.genus = t.genus;
  promise.loops = long(t.loops);
  promise.components = long(t.components);
  if (t.bad_indices == 0 && t.loops == 0) promise.volume_sign = sign_of(measure::quality(original).volume);
  return promise;
}

std::string faults(const measure::Surface& surface, const Promise& promise) {
  const measure::Topology t = measure::topology(surface);
  std::string text;
  want_none(text, "bad indices", t.bad_indices);
  want_none(text, "bad positions", t.bad_positions);
  if (!text.empty()) return text;
  if (t.triangles == 0) text = "no triangles";
  want_none(text, "triangles with a repeated corner", t.repeated_corners);
  want_none(text, "duplicate triangles", t.duplicate_triangles);
  want_none(text, "unused vertices", t.unused_vertices);
  want_none(text, "non-manifold edges", t.nonmanifold_edges);
  want_none(text, "non-manifold vertices", t.nonmanifold_vertices);
  want_none(text, "misoriented edges", t.misoriented_edges);
  const measure::Quality q = measure::quality(surface);
  want_none(text, "degenerate triangles", q.degenerate_triangles);
  want(text, "vertices", long(t.vertices), promise.vertices);
  want(text, "genus", t.genus, promise.genus);
  want(text, "loops", long(t.loops), promise.loops);
  want(text, "components", long(t.components), promise.components);
  if (promise.volume_sign != 0) want(text, "sign of the volume", sign_of(q.volume), promise.volume_sign);
  return text;
}

std::uint64_t hash_of(const shapes::Shape& shape) {
  std::uint64_t hash = 14695981039346656037u;
  const auto feed = [&hash](std::uint64_t bits, int bytes) {
    for (int i = 0; i < bytes; ++i) {
      hash = (hash ^ ((bits >> (8 * i)) & 255)) * 1099511628211u;
    }
  };
  for (double x : shape.positions) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    feed(bits, 8);
  }
  for (std::uint32_t v : shape.triangles) feed(v, 4);
  return hash;
}

}  // namespace checker
