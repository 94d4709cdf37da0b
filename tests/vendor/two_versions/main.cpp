// PROGRAM FILE.off HASH: two copies of the library in one program, the second with another namespace, output version
// and hash: each must answer for itself.
#include "copy.h"

static small_mesh mesh;

int main(int count, char** words) {
  if (count != 3 || !read_small_mesh(words[1], &mesh)) return 2;
  const Answer a = first(mesh), b = second(mesh), again = first(mesh);
  const bool apart = b.output_version == 1000 && b.c_output_version == 1000 && a.output_version != 1000 &&
                     a.c_output_version == a.output_version && b.hash != 0 && b.hash != a.hash;
  if (!apart || again.hash != a.hash) return 3;
  return judge(a.hash, words[2]);
}
