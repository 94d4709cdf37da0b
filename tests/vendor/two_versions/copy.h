// Two copies of the library behind one type.
#pragma once

#include "../small_mesh.h"

struct Answer {
  uint64_t hash;
  uint32_t output_version, c_output_version;
};

Answer first(const small_mesh& mesh);
Answer second(const small_mesh& mesh);
