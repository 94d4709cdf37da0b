#include "base/status.h"

namespace isolod {
inline namespace v1 {

const char* name(Status::Code code) {
  switch (code) {
    case Status::ok:
      return "ok";
    case Status::cancelled:
      return "cancelled";
    case Status::invalid_option:
      return "invalid_option";
    case Status::empty_mesh:
      return "empty_mesh";
    case Status::too_large:
      return "too_large";
    case Status::index_out_of_range:
      return "index_out_of_range";
    case Status::position_not_finite:
      return "position_not_finite";
    case Status::density_not_positive:
      return "density_not_positive";
    case Status::budget_too_small:
      return "budget_too_small";
    case Status::out_of_memory:
      return "out_of_memory";
    case Status::no_convergence:
      return "no_convergence";
    case Status::sink_failed:
      return "sink_failed";
    case Status::cannot_open:
      return "cannot_open";
    case Status::unknown_format:
      return "unknown_format";
    case Status::syntax_error:
      return "syntax_error";
    case Status::truncated_file:
      return "truncated_file";
    case Status::unsupported_feature:
      return "unsupported_feature";
    case Status::invalid_result:
      return "invalid_result";
    case Status::not_admitted:
      return "not_admitted";
    case Status::wrong_arithmetic:
      return "wrong_arithmetic";
  }
  return "unknown";
}

const char* message(Status::Code code) {
  switch (code) {
    case Status::ok:
      return "all went well";
    case Status::cancelled:
      return "cancelled";
    case Status::invalid_option:
      return "an option is out of its range";
    case Status::empty_mesh:
      return "no triangle with area is left";
    case Status::too_large:
      return "more elements than 32-bit indices can name";
    case Status::index_out_of_range:
      return "names a vertex that does not exist";
    case Status::position_not_finite:
      return "a coordinate is NaN or infinite";
    case Status::density_not_positive:
      return "the density is not a positive finite number";
    case Status::budget_too_small:
      return "too few vertices for the corners and the topology of this shape";
    case Status::out_of_memory:
      return "the memory block is too small";
    case Status::no_convergence:
      return "a bounded search ended without a usable result";
    case Status::sink_failed:
      return "the result could not be handed over";
    case Status::cannot_open:
      return "cannot be opened, read or written";
    case Status::unknown_format:
      return "unknown file type";
    case Status::syntax_error:
      return "breaks the rules of its format";
    case Status::truncated_file:
      return "the file ends before its contents do";
    case Status::unsupported_feature:
      return "valid, but of a kind that is not read or written here";
    case Status::invalid_result:
      return "the result breaks one of the library's own promises; please report it";
    case Status::not_admitted:
      return "what an option forces is not for a surface of this topology";
    case Status::wrong_arithmetic:
      return "this program was compiled so that it does not compute the bits that others do";
  }
  return "failed";
}

const char* name(Element element) {
  switch (element) {
    case Element::none:
      return "";
    case Element::vertex:
      return "vertex";
    case Element::triangle:
      return "triangle";
    case Element::edge:
      return "edge";
    case Element::line:
      return "line";
    case Element::byte:
      return "byte";
    case Element::option:
      return "option";
    case Element::count:
      return "vertices";
    case Element::arithmetic:
      return "arithmetic";
  }
  return "";
}

#if defined(ISOLOD_CHECKED)
void broken_assertion(const char*, const char*, int) { __builtin_trap(); }
#endif

}  // namespace v1
}  // namespace isolod
