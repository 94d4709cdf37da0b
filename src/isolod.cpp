// The whole library as one translation unit: what a vendor compiles, with include/ and src/ on the include path.
#include "base/arena.cpp"
#include "base/status.cpp"

#include "mesh/halfedge.cpp"
