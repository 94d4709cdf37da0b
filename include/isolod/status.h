// What a call came to: success, or one named reason with the element that caused it.
#pragma once

#include <cstdint>

#include "isolod/api.h"

namespace isolod {
inline namespace v1 {

/// The kind of thing that `Status::value` counts or names.
enum class Element : std::uint8_t {
  none,
  vertex,      ///< index in the caller's positions
  triangle,    ///< index in the caller's triangles
  edge,        ///< index in the caller's tagged edges
  line,        ///< line of a text file, from 1
  byte,        ///< offset in a binary file, or a count of bytes
  option,      ///< ordinal of the offending member of `Options`
  count,       ///< a number of vertices that would do
  arithmetic,  ///< an `ArithmeticFault`
};

/// A result code with the element it concerns. Sixteen bytes, passed by value.
struct [[nodiscard]] Status {
  enum Code : std::uint8_t {
    ok,
    cancelled,             ///< the caller's progress callback returned false
    invalid_option,        ///< an option is out of its range
    empty_mesh,            ///< no triangle with area is left
    too_large,             ///< more elements than 32-bit indices can name
    index_out_of_range,    ///< `value` is the first triangle (or tagged edge) that names no vertex
    position_not_finite,   ///< `value` is the first vertex with NaN or infinity
    density_not_positive,  ///< `value` is the first vertex, triangle or tagged edge with a density that is not positive
                           ///< and finite
    budget_too_small,      ///< the topology and the corners need more; `value` vertices work
    out_of_memory,         ///< the block is too small; `value` bytes do
    no_convergence,        ///< a bounded loop reached its bound with no usable result
    sink_failed,           ///< the caller's sink returned false
    cannot_open,           ///< a file cannot be opened, read or written
    unknown_format,        ///< no reader or writer for this kind of file
    syntax_error,          ///< the file breaks its format at line or byte `value`
    truncated_file,        ///< the file ends before its contents do
    unsupported_feature,   ///< the file is valid but uses what is not read here
    invalid_result,        ///< validation found a broken invariant: a defect of this library
    not_admitted,          ///< what an option forces is not for a surface of this topology
    wrong_arithmetic,      ///< this build or machine does not compute the bits that others do: see self_test.h
  };

  Code code = ok;
  Element element = Element::none;
  std::uint64_t value = 0;

  constexpr Status() = default;
  constexpr Status(Code c, Element e = Element::none, std::uint64_t v = 0) : code(c), element(e), value(v) {}

  constexpr bool is_ok() const { return code == ok; }
};

constexpr bool operator==(const Status& status, Status::Code code) { return status.code == code; }
constexpr bool operator!=(const Status& status, Status::Code code) { return status.code != code; }

/// The code's name as it is spelled above, such as "budget_too_small".
ISOLOD_API const char* name(Status::Code code);

/// What the code means, for a person: part of a sentence, without a stop, such as "the memory block is too small".
ISOLOD_API const char* message(Status::Code code);

/// The element's name, such as "triangle"; "" for none.
ISOLOD_API const char* name(Element element);

}  // namespace v1
}  // namespace isolod
