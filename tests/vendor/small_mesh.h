// What the small programs have in common, C99 and C++: one OFF file, read into arrays of fixed size.
#pragma once

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { most_vertices = 200, most_triangles = 400, wished_vertices = 60 };

typedef struct small_mesh {
  double positions[3 * most_vertices];
  uint32_t triangles[3 * most_triangles];
  size_t vertex_count, triangle_count;
} small_mesh;

static int read_small_mesh(const char* path, small_mesh* mesh) {
  FILE* file = fopen(path, "r");
  unsigned vertices = 0, triangles = 0, k;
  int good = file != NULL && fscanf(file, "OFF %u %u %*u", &vertices, &triangles) == 2 && vertices <= most_vertices &&
             triangles <= most_triangles;
  for (k = 0; good && k < 3 * vertices; ++k) good = fscanf(file, "%lf", &mesh->positions[k]) == 1;
  for (k = 0; good && k < triangles; ++k) {
    unsigned corners[3];
    good = fscanf(file, " 3 %u %u %u", &corners[0], &corners[1], &corners[2]) == 3;
    mesh->triangles[3 * k] = corners[0];
    mesh->triangles[3 * k + 1] = corners[1];
    mesh->triangles[3 * k + 2] = corners[2];
  }
  if (file != NULL) fclose(file);
  mesh->vertex_count = vertices;
  mesh->triangle_count = triangles;
  return good;
}

/// The program's last word: whether the hash is the wished one, 16 hexadecimal digits.
static int judge(uint64_t hash, const char* wished) {
  const int good = hash == strtoull(wished, NULL, 16);
  printf("%s: %08lx%08lx\n", good ? "ok" : "another hash", (unsigned long)(hash >> 32),
         (unsigned long)(hash & 0xffffffffu));
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
