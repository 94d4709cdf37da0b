// Where every failure is made. Apart from what names them: a shared library of the file readers has it too.
#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status fail(Status::Code code, Element element, std::uint64_t value) { return Status(code, element, value); }

}  // namespace v1
}  // namespace isolod
