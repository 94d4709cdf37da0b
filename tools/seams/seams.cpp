// isolod_seams: whether a result still shows the seams of the atlas that its first mesh was made of. Prints JSON.
// tools/check_models.sh holds it against bars.
//
// What lies within two rings of a former seam is compared with the rest of the result, and with what lies within two
// rings of seams that this result never had. Those are the atlases of the same surface whose vertices and triangles
// were put in another order: the partition begins with the first triangle and goes on with the farthest, so its seeds,
// and with them all seams, lie elsewhere, while their number, lengths, wiggles and liking for lines stay what the same
// algorithm makes of the same shape. A seam that was only moved or turned would not lie on the surface.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "isolod/arguments.h"
#include "isolod/failure.h"
#include "isolod/files.h"
#include "isolod/json.h"
#include "seams/first_seams.h"

namespace {

using tool::Arguments;
using tool::CommandRule;
using tool::JsonWriter;

const CommandRule& seams_rule() {
  static const CommandRule rule = {
      "seams",
      "IN",
      1,
      "Remeshes IN by default options and measures whether the seams of the first mesh still show, as JSON.",
      {{"--vertices", "N", "vertices of the result; 10000"},
       {"--features", "DEG", "edges sharper than this angle are kept"},
       {"--weld", nullptr, "vertices at equal positions are one"},
       {"--shifted", "K", "how many other atlases to compare with; 8"},
       {"--keep-seams", nullptr, "no second relaxation across seams: what the measure says where they do show"}}};
  return rule;
}

void add_group(JsonWriter& json, const char* key, const measure::SeamGroup& group) {
  json.open_object(key);
  json.add("triangles", static_cast<std::uint64_t>(group.triangles));
  json.add("vertices", static_cast<std::uint64_t>(group.vertices));
  json.add("q_mean", group.q_mean);
  json.add("valence_6", group.valence_6);
  json.add("cell_variation", group.cell_variation);
  json.close_object();
}

void add_fit(JsonWriter& json, const seams::FirstSeams& first, const measure::SeamFit& fit) {
  json.add("charts", first.charts);
  json.add("first_count", first.first_count);
  json.add("seam_length", fit.length);
  add_group(json, "near", fit.near);
  add_group(json, "rest", fit.rest);
  json.add("following_edges", static_cast<std::uint64_t>(fit.following));
  json.add("longest_chain", static_cast<std::uint64_t>(fit.longest_chain));
}

/// How much of `others` lies within `reach` of `own`, from 0 to 1.
double overlap(const std::vector<measure::Segment>& others, const std::vector<measure::Segment>& own, double reach) {
  const auto minus = [](const auto& a, const auto& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); };
  double all = 0, near = 0;
  for (const measure::Segment& other : others) {
    const double length = minus(other[0], other[1]);
    const bool is_near = std::any_of(own.begin(), own.end(),
                                     [&](const measure::Segment& seam) { return minus(seam[0], other[0]) <= reach; });
    all += length;
    near += is_near ? length : 0;
  }
  return all > 0 ? near / all : 0;
}

int run(int count, char** words) {
  const Arguments arguments(seams_rule(), count - 1, words + 1);
  if (arguments.wants_help()) {
    std::fputs(tool::help_text(seams_rule(), "isolod_seams").c_str(), stdout);
    return tool::exit_ok;
  }
  const tool::InputMesh input = tool::read_mesh_file(arguments.operand(0));
  isolod::Options options;
  options.vertex_count = static_cast<std::uint32_t>(arguments.count("--vertices", 10000, 0xffffffffu));
  options.feature_angle = arguments.number("--features", 0, 0, 180);
  options.weld = arguments.has("--weld");
  options.remove_seams = !arguments.has("--keep-seams");
  measure::SeamOptions measuring;
  measuring.lines.sharp_degrees = options.feature_angle > 0 ? options.feature_angle : 180;

  tool::TriangleMesh mesh;
  const seams::FirstSeams own = seams::remesh(input.view(), options, mesh);
  const measure::Surface result(mesh.positions, mesh.triangles);
  const measure::SeamFit fit = measure::seam_fit(result, own.segments, measuring);
  JsonWriter json;
  json.add("file", arguments.operand(0));
  json.add("vertices", static_cast<std::uint64_t>(result.vertex_count));
  add_fit(json, own, fit);
  json.open_array("shifted");
  for (std::uint64_t seed = 1; seed <= arguments.count("--shifted", 8, 1000); ++seed) {
    const tool::TriangleMesh other = seams::reordered(input.view(), seed);
    const seams::FirstSeams shifted = seams::seams_at(other.view(), options, own.first_count);
    json.open_object(nullptr);
    add_fit(json, shifted, measure::seam_fit(result, shifted.segments, measuring));
    json.add("overlap", overlap(shifted.segments, own.segments, measure::quality(result).edge_mean));
    json.close_object();
  }
  json.close_array();
  std::fputs(json.finish().c_str(), stdout);
  return tool::exit_ok;
}

}  // namespace

int main(int count, char** words) { return tool::run_program("isolod_seams", run, count, words); }
