// Marks what a shared library shows, and what takes less room than a call to it. Plain C too.
//
// Nothing has to be defined where the library is static or its sources are compiled along. ISOLOD_SHARED says that it
// is a shared library, ISOLOD_BUILDING besides that this is the build of it; the CMake and pkg-config files define
// them.
#pragma once

#if !defined(ISOLOD_SHARED)
#define ISOLOD_API
#elif defined(_WIN32) && defined(ISOLOD_BUILDING)
#define ISOLOD_API __declspec(dllexport)
#elif defined(_WIN32)
#define ISOLOD_API __declspec(dllimport)
#else
#define ISOLOD_API __attribute__((visibility("default")))
#endif

#if defined(__GNUC__)
#define ISOLOD_INLINE __attribute__((always_inline))
#elif defined(_MSC_VER)
#define ISOLOD_INLINE __forceinline
#else
#define ISOLOD_INLINE
#endif
