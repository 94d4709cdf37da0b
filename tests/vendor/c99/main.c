/* PROGRAM FILE.off HASH: the C interface from C99, without anything of C++. */
#include <string.h>

#include "../small_mesh.h"
#include "isolod/isolod_c.h"

static unsigned char block[16 << 20];
static small_mesh in, out;

static int32_t count_calls(void* context, const char* stage, double share) {
  *(int*)context += stage[0] != '\0' && share >= 0 && share <= 1;
  return 1;
}

int main(int count, char** words) {
  isolod_mesh mesh;
  isolod_options options;
  isolod_work work;
  isolod_report report;
  isolod_output output = {0};
  int calls = 0;
  int32_t status;
  if (count != 3 || !read_small_mesh(words[1], &in)) return 2;
  isolod_mesh_init(&mesh, sizeof mesh);
  isolod_options_init(&options, sizeof options);
  isolod_work_init(&work, sizeof work);
  isolod_report_init(&report, sizeof report);
  mesh.positions = in.positions;
  mesh.vertex_count = in.vertex_count;
  mesh.indices = in.triangles;
  mesh.triangle_count = in.triangle_count;
  options.vertex_count = wished_vertices;
  work.block = block;
  work.block_bytes = isolod_required_memory(mesh.vertex_count, mesh.triangle_count, &options);
  work.progress = count_calls;
  work.progress_context = &calls;
  if (work.block_bytes > sizeof block) return 2;
  output.positions = out.positions;
  output.vertex_capacity = most_vertices;
  output.triangles = out.triangles;
  output.triangle_capacity = 1;
  status = isolod_remesh(&mesh, &options, &work, &output, &report);
  if (status != ISOLOD_CAPACITY_TOO_SMALL || report.element != ISOLOD_TRIANGLE || out.triangles[0] != 0) return 3;
  output.triangle_capacity = (size_t)report.value;
  status = isolod_remesh(&mesh, &options, &work, &output, &report);
  if (status != ISOLOD_OK || output.vertex_count != wished_vertices || output.hash != report.result_hash ||
      calls == 0 || isolod_output_version() != ISOLOD_OUTPUT_VERSION || strcmp(isolod_status_name(status), "ok") != 0) {
    printf("%s\n", isolod_status_message(status));
    return 3;
  }
  return judge(output.hash, words[2]);
}
