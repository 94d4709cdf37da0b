// isolod for C, and for every language that can call C: flat arrays in, flat arrays out, in a block of yours.
//
//   isolod_mesh mesh;
//   isolod_options options;
//   isolod_work work;
//   isolod_output output = {0};
//   isolod_mesh_init(&mesh, sizeof mesh);             // every struct with a struct_size begins so
//   isolod_options_init(&options, sizeof options);    // all members: their defaults
//   isolod_work_init(&work, sizeof work);
//   mesh.positions = xyz, mesh.vertex_count = 8;      // double[3 * 8]
//   mesh.indices = corners, mesh.triangle_count = 12; // uint32_t[3 * 12]
//   options.vertex_count = 500;                       // exactly so many come out
//   work.block = block, work.block_bytes = isolod_required_memory(8, 12, &options);
//   output.positions = out_xyz, output.vertex_capacity = 500;            // double[3 * 500]
//   output.triangles = out_corners, output.triangle_capacity = 1000;     // uint32_t[3 * 1000]
//   if (isolod_remesh(&mesh, &options, &work, &output, NULL) == ISOLOD_OK) use(output.vertex_count, ...);
//
// Every function can be called from several threads at once, on blocks of their own: there is no state.
//
// Older and newer callers: a struct that `..._init` filled knows the size that its caller was compiled with. The
// library reads and writes no more than that; members that it lacks have their defaults. New members come at the end.
// A struct that is larger than the library knows is refused, unless `..._init` of this library made it: that says how
// much of it counts.
//
// Two copies in one program: compile each with an ISOLOD_C_PREFIX of its own, such as -DISOLOD_C_PREFIX=ours_, the
// library and whoever includes this header; the linker then sees ours_isolod_remesh. Or hide one of them.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "isolod/api.h"
#include "isolod/version.h"

// NOLINTBEGIN(readability-identifier-naming): the names that C programs use.

#if defined(ISOLOD_C_PREFIX)
#define ISOLOD_C_JOINED(prefix, name) prefix##name
#define ISOLOD_C_NAME(prefix, name) ISOLOD_C_JOINED(prefix, name)
#define isolod_version ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_version)
#define isolod_version_text ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_version_text)
#define isolod_output_version ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_output_version)
#define isolod_status_name ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_status_name)
#define isolod_status_message ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_status_message)
#define isolod_element_name ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_element_name)
#define isolod_mesh_init ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_mesh_init)
#define isolod_options_init ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_options_init)
#define isolod_options_init_paper ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_options_init_paper)
#define isolod_work_init ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_work_init)
#define isolod_report_init ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_report_init)
#define isolod_required_memory ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_required_memory)
#define isolod_required_memory_lods ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_required_memory_lods)
#define isolod_plan ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_plan)
#define isolod_self_test ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_self_test)
#define isolod_remesh ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_remesh)
#define isolod_build_lods ISOLOD_C_NAME(ISOLOD_C_PREFIX, isolod_build_lods)
#endif

#if defined(__cplusplus)
extern "C" {
#endif

/// What a call came to. The numbers stay.
enum isolod_status {
  ISOLOD_OK = 0,
  ISOLOD_CANCELLED = 1,             ///< the progress callback returned 0
  ISOLOD_INVALID_OPTION = 2,        ///< `value`: the member's place in isolod_options, vertex_count being 0
  ISOLOD_EMPTY_MESH = 3,            ///< no triangle with area is left
  ISOLOD_TOO_LARGE = 4,             ///< more elements than 32-bit indices can name
  ISOLOD_INDEX_OUT_OF_RANGE = 5,    ///< `value`: the first triangle (or tagged edge) that names no vertex
  ISOLOD_POSITION_NOT_FINITE = 6,   ///< `value`: the first vertex with NaN or infinity
  ISOLOD_DENSITY_NOT_POSITIVE = 7,  ///< `value`: the first vertex, triangle or tagged edge with such a density
  ISOLOD_BUDGET_TOO_SMALL = 8,      ///< `value`: a number of vertices that works
  ISOLOD_OUT_OF_MEMORY = 9,         ///< `value`: a number of bytes that is enough
  ISOLOD_NO_CONVERGENCE = 10,       ///< a bounded loop reached its bound with no usable result
  ISOLOD_SINK_FAILED = 11,          ///< not from this interface; the next five are of the file readers
  ISOLOD_CANNOT_OPEN = 12,
  ISOLOD_UNKNOWN_FORMAT = 13,
  ISOLOD_SYNTAX_ERROR = 14,
  ISOLOD_TRUNCATED_FILE = 15,
  ISOLOD_UNSUPPORTED_FEATURE = 16,
  ISOLOD_INVALID_RESULT = 17,    ///< validation found a broken invariant: a defect of this library
  ISOLOD_NOT_ADMITTED = 18,      ///< what an option forces is not for a surface of this topology
  ISOLOD_WRONG_ARITHMETIC = 19,  ///< the library was compiled so that it does not compute the bits that others do

  ISOLOD_INVALID_ARGUMENT = 100,  ///< a pointer is null, or a struct was not filled by its `..._init`
  ISOLOD_CAPACITY_TOO_SMALL =
      101  ///< `element` and `value`: the first number, of vertices or triangles, to have room for
};

/// The kind of thing that `isolod_report.value` counts or names.
enum isolod_element {
  ISOLOD_NO_ELEMENT = 0,
  ISOLOD_VERTEX = 1,
  ISOLOD_TRIANGLE = 2,
  ISOLOD_EDGE = 3,
  ISOLOD_LINE = 4,
  ISOLOD_BYTE = 5,
  ISOLOD_OPTION = 6,
  ISOLOD_COUNT = 7,
  ISOLOD_ARITHMETIC = 8  ///< an `isolod::ArithmeticFault`: self_test.h
};

enum isolod_scalar_type { ISOLOD_FLOAT32 = 0, ISOLOD_FLOAT64 = 1 };
enum isolod_index_type { ISOLOD_UINT16 = 0, ISOLOD_UINT32 = 1 };

/// The choices of isolod_options; isolod/options.h says what each does.
enum isolod_density { ISOLOD_DENSITY_UNIFORM = 0, ISOLOD_DENSITY_GIVEN = 1, ISOLOD_DENSITY_CURVATURE = 2 };
enum isolod_atlas { ISOLOD_ATLAS_CHARTS = 0, ISOLOD_ATLAS_SINGLE = 1 };
enum isolod_cut { ISOLOD_CUT_SPINE = 0, ISOLOD_CUT_LOOPS = 1, ISOLOD_CUT_SHORT_LOOPS = 2, ISOLOD_CUT_GREEDY = 3 };
enum isolod_calibration { ISOLOD_CALIBRATION_CORRECTED = 0, ISOLOD_CALIBRATION_PAPER = 1 };
enum isolod_fluency {
  ISOLOD_FLUENCY_AUTOMATIC = 0,
  ISOLOD_FLUENCY_TREE = 1,
  ISOLOD_FLUENCY_REGION = 2,
  ISOLOD_FLUENCY_STRIP = 3
};
enum isolod_weight { ISOLOD_WEIGHT_EQUAL = 0, ISOLOD_WEIGHT_PAPER = 1 };
enum isolod_centroids { ISOLOD_CENTROIDS_FAST = 0, ISOLOD_CENTROIDS_EXACT = 1 };

/// The input, read where it lies and never changed. Pointers may be null where it says so.
typedef struct isolod_mesh {
  uint32_t struct_size;
  int32_t position_type;  ///< isolod_scalar_type; ISOLOD_FLOAT64
  const void* positions;  ///< x y z of each vertex
  size_t vertex_count;
  size_t position_stride;  ///< bytes from one vertex to the next; 0: three scalars
  const void* indices;     ///< three vertices a triangle, from 0
  size_t triangle_count;
  int32_t index_type;            ///< isolod_index_type; ISOLOD_UINT32
  uint32_t reserved;             ///< 0
  const double* vertex_density;  ///< wished samples per area, a number a vertex, up to scale; or null
  const double* corner_density;  ///< the same, three numbers a triangle; or null
  const uint32_t* tagged_edges;  ///< feature edges, two vertices each; or null
  size_t tagged_edge_count;
  const double* tagged_edge_density;   ///< wished samples per length, a number a tagged edge; or null
  const uint32_t* triangle_materials;  ///< an edge between two materials is a feature; or null
} isolod_mesh;

/// What is wished; each member is that of isolod::Options. Switches are 0 or 1.
typedef struct isolod_options {
  uint32_t struct_size;
  uint32_t vertex_count;      ///< the result has exactly as many vertices; isolod_build_lods does not look at it
  double feature_angle;       ///< degrees, 0 to 180; an edge is sharp above it; 0: none is
  double corner_angle;        ///< degrees, up to 180
  int32_t density;            ///< isolod_density
  int32_t reserved;           ///< 0
  double gamma;               ///< exponent of the curvature, 0 to 8
  uint32_t smoothing_passes;  ///< of the density
  int32_t smooth_undersampled;
  int32_t atlas;  ///< isolod_atlas
  int32_t cut;    ///< isolod_cut
  int32_t fall_back_to_charts;
  int32_t calibration;  ///< isolod_calibration
  int32_t fluency;      ///< isolod_fluency
  int32_t weight;       ///< isolod_weight
  int32_t centroids;    ///< isolod_centroids
  uint32_t lloyd_iterations;
  int32_t remove_seams;
  int32_t close_boundaries;
  int32_t fit;
  int32_t weld;
  int32_t validate;
  uint32_t reserved_too;  ///< 0
} isolod_options;

/// Called between pieces of work with the stage's name and the share done, 0 to 1, which never falls. 0 cancels.
typedef int32_t (*isolod_progress)(void* context, const char* stage, double share);

/// Calls piece(data, 0) to piece(data, count - 1), in any order and on any threads, and returns when all have returned.
typedef void (*isolod_parallel_for)(void* context, uint32_t count, void (*piece)(void* data, uint32_t index),
                                    void* data);

/// The block to work in, who is told how far the work is, and who lends threads.
typedef struct isolod_work {
  uint32_t struct_size;
  uint32_t reserved;  ///< 0
  void* block;        ///< any alignment; what it held is lost
  size_t block_bytes;
  isolod_progress progress;  ///< or null
  void* progress_context;
  isolod_parallel_for parallel_for;  ///< or null; the result is the same with it and without
  void* parallel_context;
} isolod_work;

/// Room for a mesh, and the mesh. Set the first four and the rest to 0. This struct never changes.
typedef struct isolod_output {
  double* positions;         ///< double[3 * vertex_capacity]
  size_t vertex_capacity;    ///< at least the number asked for
  uint32_t* triangles;       ///< uint32_t[3 * triangle_capacity]
  size_t triangle_capacity;  ///< 2 V - B - 2 X triangles come out, of V vertices, B on boundaries, X the Euler number:
                             ///< 2 V are enough without handles, or with one; a component's every other handle needs 2
                             ///< more
  size_t vertex_count;       ///< what was written; after ISOLOD_CAPACITY_TOO_SMALL what needs room, 0 where unknown
  size_t triangle_count;
  uint64_t hash;  ///< of the raw bits, the same on every machine
} isolod_output;

/// So many levels of detail at most in one call.
#define ISOLOD_MOST_LODS 16

/// A level of detail that is wished, and room for it. This struct never changes.
typedef struct isolod_lod {
  uint32_t vertex_count;  ///< exactly so many
  uint32_t reserved;      ///< 0
  isolod_output output;
} isolod_lod;

/// What a run did. Filled also where it fails, as far as it came.
typedef struct isolod_report {
  uint32_t struct_size;
  int32_t status;   ///< isolod_status
  int32_t element;  ///< isolod_element
  uint32_t output_version;
  uint64_t value;
  uint64_t result_hash;  ///< of the result, or of the finest level
  uint64_t arena_bytes;  ///< the most of the block that was in use
  uint32_t components;
  uint32_t boundary_loops;  ///< of the result
  uint32_t closed_loops;    ///< of the input, closed because `close_boundaries` allowed it
  uint32_t corners;
  uint32_t backbones;  ///< kept lines between corners, or closed
  uint32_t charts;
  uint32_t fallen_back;  ///< components that were to be one chart and had to be several
  uint32_t feature_samples;
  uint32_t seam_samples;
  uint32_t surface_samples;
  uint32_t welded_vertices;  ///< from here on: what repair changed
  uint32_t unused_vertices;
  uint32_t degenerate_triangles;
  uint32_t duplicate_triangles;
  uint32_t nonmanifold_edges_cut;
  uint32_t nonmanifold_vertices_cut;
  uint32_t flipped_triangles;
  uint32_t one_sided_cuts;
} isolod_report;

/// 1000000 major + 1000 minor + patch of the library that runs.
ISOLOD_API uint32_t isolod_version(void);

/// The same, such as "1.2.3".
ISOLOD_API const char* isolod_version_text(void);

/// ISOLOD_OUTPUT_VERSION of the library that runs.
ISOLOD_API uint32_t isolod_output_version(void);

/// The code's name in lower case, such as "budget_too_small"; "unknown" for no code. These texts last for ever.
ISOLOD_API const char* isolod_status_name(int32_t status);

/// What it means, for a person: part of a sentence, without a stop.
ISOLOD_API const char* isolod_status_message(int32_t status);

/// The element's name, such as "triangle"; "" for none.
ISOLOD_API const char* isolod_element_name(int32_t element);

/// Fill a struct of so many bytes, sizeof of the caller's, with defaults. ISOLOD_INVALID_ARGUMENT where it is null, or
/// too small to be one; then it stays as it is.
ISOLOD_API int32_t isolod_mesh_init(isolod_mesh* mesh, size_t struct_size);
ISOLOD_API int32_t isolod_options_init(isolod_options* options, size_t struct_size);
ISOLOD_API int32_t isolod_work_init(isolod_work* work, size_t struct_size);
ISOLOD_API int32_t isolod_report_init(isolod_report* report, size_t struct_size);

/// The paper as printed: one chart, its calibration, its weights, all samples diffused at once, seams where it was cut.
ISOLOD_API int32_t isolod_options_init_paper(isolod_options* options, size_t struct_size, uint32_t vertex_count);

/// Bytes of block that are enough for any mesh of these counts; 0 where an option is invalid.
ISOLOD_API size_t isolod_required_memory(size_t vertex_count, size_t triangle_count, const isolod_options* options);

/// The same for these levels of detail at once.
ISOLOD_API size_t isolod_required_memory_lods(size_t vertex_count, size_t triangle_count, const isolod_options* options,
                                              const isolod_lod* lods, size_t lod_count);

/// How many bytes of block this mesh needs, for one result or, with `lod_count` above 0, for these levels of detail at
/// once; as isolod::plan. Works in the block of `work`, which must hold about what the analysis of the mesh takes:
/// where it does not, the status is ISOLOD_OUT_OF_MEMORY and `report`, which may be null, has a number that is enough
/// as value. `bytes` is 0 where it fails.
ISOLOD_API int32_t isolod_plan(const isolod_mesh* mesh, const isolod_options* options, const isolod_work* work,
                               const isolod_lod* lods, size_t lod_count, size_t* bytes, isolod_report* report);

/// "none", or what about this build or machine computes otherwise than every other, as isolod::ArithmeticFault spells
/// it: in the calling thread's floating-point mode or, where `in_calls` is not 0, in that which every call sets.
ISOLOD_API const char* isolod_self_test(int32_t in_calls);

/// Remeshes to exactly `options->vertex_count` vertices. Returns an isolod_status; `report` says more, and may be null.
///
/// Where that is not ISOLOD_OK, the arrays of `output` are as they were, and so are its other members, but for
/// the counts after ISOLOD_CAPACITY_TOO_SMALL. Room for the vertices is checked before the work, room for the triangles
/// after it.
ISOLOD_API int32_t isolod_remesh(const isolod_mesh* mesh, const isolod_options* options, const isolod_work* work,
                                 isolod_output* output, isolod_report* report);

/// Makes several levels of detail from one analysis. The finest is that of isolod_remesh, bit for bit. The arrays are
/// as they were unless all levels are good and fit; after ISOLOD_CAPACITY_TOO_SMALL the counts of every level are told.
/// The requests may come in any order; `report` is that of the finest.
ISOLOD_API int32_t isolod_build_lods(const isolod_mesh* mesh, const isolod_options* options, const isolod_work* work,
                                     isolod_lod* lods, size_t lod_count, isolod_report* report);

#if defined(__cplusplus)
}  // extern "C"
#endif

// NOLINTEND(readability-identifier-naming)
