// The golden cases: made shapes remeshed, and the bits of every stage's result as a line of text. Shared by the test
// and by the program that every target runs (tools/port), which has neither doctest nor files.
#pragma once

#include <string>

#include "isolod/remesh.h"
#include "isolod/shapes.h"

namespace golden {

struct Case {
  const char* name;
  std::size_t triangles;
  std::uint32_t vertices;
  const char* note;  ///< what `change` does
  void (*change)(isolod::Options&);
};

extern const Case cases[];
extern const std::size_t case_count;

isolod::Options options_of(const Case& c);

/// "name-triangles V=vertices note", by which a case is known.
std::string title_of(const Case& c);

/// The title, then stage=hash for each stage, and the end of the line.
std::string line_of(const Case& c, const isolod::Report& report);

/// The first word of `found` that `wanted` has not at the same place, with its line; "" where they are equal.
std::string first_difference(const std::string& wanted, const std::string& found);

}  // namespace golden
