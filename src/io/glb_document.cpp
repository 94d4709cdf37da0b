#include "io/glb_document.h"

#include "io/bytes.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t glb_magic = 0x46546C67, glb_json_chunk = 0x4E4F534A, glb_binary_chunk = 0x004E4942;

/// The shape of a component type's numbers; false for an unknown type.
bool describe_component(std::uint64_t type, GlbNumbers& numbers) {
  numbers.is_float = type == 5126;
  numbers.is_signed = type == 5120 || type == 5122;
  numbers.component_bytes = type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
  return (type >= 5120 && type <= 5123) || type == 5125 || type == 5126;
}

}  // namespace

double GlbNumbers::component(std::size_t element, std::size_t k) const {
  const std::uint64_t bits = load_bits(data + stride * element + component_bytes * k, component_bytes, false);
  if (is_float) return to_float32(bits);
  const double value = is_signed ? static_cast<double>(to_signed(bits, component_bytes)) : static_cast<double>(bits);
  if (!normalized) return value;
  const unsigned value_bits = static_cast<unsigned>(8 * component_bytes) - (is_signed ? 1 : 0);
  const double share = value / static_cast<double>((std::uint64_t{1} << value_bits) - 1);
  return share < -1 ? -1 : share;
}

std::uint32_t GlbNumbers::index(std::size_t element) const {
  return static_cast<std::uint32_t>(load_bits(data + stride * element, component_bytes, false));
}

Status GlbDocument::open(Span<const unsigned char> file, Arena& arena) {
  file_ = file;
  ISOLOD_TRY(read_chunks(arena));
  ISOLOD_TRY(check_extensions());
  ISOLOD_TRY(read_views(arena));
  return json_.items(json_.find(Json::root, "accessors"), accessors_, arena);
}

Status GlbDocument::read_chunks(Arena& arena) {
  if (file_.count >= 4 && load_uint32(file_.data) != glb_magic) return fail(Status::syntax_error, Element::byte, 0);
  if (file_.count < 20) return fail(Status::truncated_file, Element::byte, file_.count);
  if (load_uint32(file_.data + 4) != 2) return fail(Status::unsupported_feature, Element::byte, 4);
  const std::uint64_t length = load_uint32(file_.data + 8);
  if (length > file_.count) return fail(Status::truncated_file, Element::byte, file_.count);
  if (length < 20) return fail(Status::syntax_error, Element::byte, 8);
  const std::uint64_t json_length = load_uint32(file_.data + 12);
  if (load_uint32(file_.data + 16) != glb_json_chunk) return fail(Status::syntax_error, Element::byte, 16);
  if (json_length > length - 20) return fail(Status::truncated_file, Element::byte, file_.count);
  Span<const unsigned char> text = file_.slice(20, static_cast<std::size_t>(json_length));
  while (!text.empty() && text[text.count - 1] == 0) --text.count;  // padded with zeros instead of blanks
  ISOLOD_TRY(json_.parse(text, 20, arena));
  const std::uint64_t rest = length - 20 - json_length;
  if (rest < 8) return {};
  const unsigned char* chunk = file_.data + 20 + json_length;
  const std::uint64_t binary_length = load_uint32(chunk);
  if (load_uint32(chunk + 4) != glb_binary_chunk) return {};
  if (binary_length > rest - 8) return fail(Status::truncated_file, Element::byte, file_.count);
  binary_ = {chunk + 8, static_cast<std::size_t>(binary_length)};
  return {};
}

Status GlbDocument::check_extensions() const {
  const std::uint32_t required = json_.find(Json::root, "extensionsRequired");
  for (std::uint32_t t = json_.first(required); t != Json::missing; t = json_.after(t, required)) {
    if (json_.is_string(t, "KHR_draco_mesh_compression") || json_.is_string(t, "EXT_meshopt_compression")) {
      return json_.fail_at(Status::unsupported_feature, t);
    }
  }
  return {};
}

Status GlbDocument::read_views(Arena& arena) {
  const std::uint32_t buffers = json_.find(Json::root, "buffers");
  const bool is_inside = json_.find(json_.first(buffers), "uri") == Json::missing;
  Span<std::uint32_t> tokens;
  ISOLOD_TRY(json_.items(json_.find(Json::root, "bufferViews"), tokens, arena));
  ISOLOD_TRY(arena.scratch(tokens.count, views_));
  for (std::size_t i = 0; i < tokens.count; ++i) {
    const std::uint32_t t = tokens[i];
    View view = {};
    std::uint64_t buffer = 0;
    ISOLOD_TRY(json_.count(json_.find(t, "buffer"), 0, buffer));
    ISOLOD_TRY(json_.count(json_.find(t, "byteOffset"), 0, view.offset));
    ISOLOD_TRY(json_.count(json_.find(t, "byteLength"), 0, view.length));
    ISOLOD_TRY(json_.count(json_.find(t, "byteStride"), 0, view.stride));
    const std::uint32_t extensions = json_.find(t, "extensions");
    const bool is_packed = json_.find(extensions, "EXT_meshopt_compression") != Json::missing;
    view.readable = buffer == 0 && is_inside && !is_packed;
    view.token = t;
    views_[i] = view;
  }
  return {};
}

Status GlbDocument::find_view(std::uint32_t accessor, View& view) const {
  const std::uint32_t named = json_.find(accessor, "bufferView");
  const bool is_sparse = json_.find(accessor, "sparse") != Json::missing;
  if (is_sparse || named == Json::missing) return json_.fail_at(Status::unsupported_feature, accessor);
  std::uint64_t index = 0;
  ISOLOD_TRY(json_.count(named, 0, index));
  if (index >= views_.count) return json_.fail_at(Status::syntax_error, named);
  view = views_[index];
  if (!view.readable) return json_.fail_at(Status::unsupported_feature, view.token);
  const bool fits = view.length <= binary_.count && view.offset <= binary_.count - view.length;
  return fits ? Status() : json_.fail_at(Status::truncated_file, view.token);
}

Status GlbDocument::locate(std::uint64_t index, std::uint32_t token, const char* type, GlbNumbers& numbers) const {
  if (index >= accessors_.count) return json_.fail_at(Status::syntax_error, token);
  const std::uint32_t accessor = accessors_[index];
  View view = {};
  ISOLOD_TRY(find_view(accessor, view));
  std::uint64_t component_type = 0, count = 0, offset = 0;
  ISOLOD_TRY(json_.count(json_.find(accessor, "componentType"), 0, component_type));
  ISOLOD_TRY(json_.count(json_.find(accessor, "count"), 0, count));
  ISOLOD_TRY(json_.count(json_.find(accessor, "byteOffset"), 0, offset));
  const bool is_type = json_.is_string(json_.find(accessor, "type"), type);
  if (!is_type || !describe_component(component_type, numbers)) return json_.fail_at(Status::syntax_error, accessor);
  numbers.normalized = json_.is_true(json_.find(accessor, "normalized"));
  const std::uint64_t element_bytes = numbers.component_bytes * (type[0] == 'V' ? 3 : 1);
  const std::uint64_t stride = view.stride == 0 ? element_bytes : view.stride;
  if (stride < element_bytes) return json_.fail_at(Status::syntax_error, view.token);
  if (count == 0) return {};
  const bool fits = element_bytes <= view.length && offset <= view.length - element_bytes &&
                    count - 1 <= (view.length - element_bytes - offset) / stride;
  if (!fits) return json_.fail_at(Status::truncated_file, accessor);
  numbers.data = binary_.data + view.offset + offset;
  numbers.stride = static_cast<std::size_t>(stride);
  numbers.count = static_cast<std::size_t>(count);
  return {};
}

}  // namespace v1
}  // namespace isolod
