// The container of a GLB file (glTF 2.0, section 4), its JSON, and the accessors: where the numbers lie.
//
// Only the buffer inside the file is read. Sparse accessors, those without a buffer view, other buffers, and the
// Draco and meshopt compressions are `unsupported_feature`, but only when something that is read uses them.
#pragma once

#include "io/json.h"

namespace isolod {
inline namespace v1 {

/// Numbers in the file: `count` elements of `width` components, all within the file's bytes.
struct GlbNumbers {
  const unsigned char* data = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
  std::size_t component_bytes = 0;
  bool is_float = false;
  bool is_signed = false;
  bool normalized = false;

  double component(std::size_t element, std::size_t k) const;
  std::uint32_t index(std::size_t element) const;
};

class GlbDocument {
 public:
  Status open(Span<const unsigned char> file, Arena& arena);

  const Json& json() const { return json_; }
  std::size_t accessor_count() const { return accessors_.count; }

  /// Accessor `index`, which `token` names, checked whole: its type ("SCALAR" or "VEC3") and that its bytes are there.
  Status locate(std::uint64_t index, std::uint32_t token, const char* type, GlbNumbers& numbers) const;

  /// Byte offset in the file.
  std::uint64_t offset_of(const unsigned char* at) const { return static_cast<std::uint64_t>(at - file_.data); }

 private:
  struct View {
    std::uint64_t offset, length, stride;
    std::uint32_t token;
    bool readable;
  };

  Status read_chunks(Arena& arena);
  Status check_extensions() const;
  Status read_views(Arena& arena);
  Status find_view(std::uint32_t accessor, View& view) const;

  Span<const unsigned char> file_;
  Span<const unsigned char> binary_;
  Json json_;
  Span<View> views_;
  Span<std::uint32_t> accessors_;
};

}  // namespace v1
}  // namespace isolod
