// The numbers of this version. Plain C too.
#pragma once

#define ISOLOD_VERSION_MAJOR 0
#define ISOLOD_VERSION_MINOR 1
#define ISOLOD_VERSION_PATCH 0

/// Greater by one whenever any result has other bits than before; two versions of the library that share it give the
/// same meshes. The change list in README.md says for each number why.
#define ISOLOD_OUTPUT_VERSION 4
