// How failures travel inside the library.
#pragma once

#include "base/config.h"
#include "isolod/status.h"

namespace isolod {
inline namespace v1 {

/// Every failure is made here and nowhere else: the place for a breakpoint.
Status fail(Status::Code code, Element element = Element::none, std::uint64_t value = 0);

}  // namespace v1
}  // namespace isolod

/// Carries a failure up to the caller.
#define ISOLOD_TRY(expression)                                                                             \
  do {                                                                                                     \
    if (const ::isolod::Status isolod_status = (expression); !isolod_status.is_ok()) return isolod_status; \
  } while (false)
