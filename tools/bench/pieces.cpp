#include "pieces.h"

#include <algorithm>
#include <memory>

#include "isolod/progress.h"

namespace bench {

namespace {

struct Piece {
  std::string stage;
  double seconds = 0;
};

bool take_stage(void* context, const char* stage, double) {
  *static_cast<std::string*>(context) = stage;
  return true;
}

isolod::Status run_pieces(const isolod::MeshView& view, const isolod::Options& options, std::vector<Piece>& pieces) {
  const std::size_t bytes = isolod::required_memory(view.vertex_count, view.triangle_count, options);
  const std::unique_ptr<unsigned char[]> block(new unsigned char[bytes]);
  isolod::Arena arena(block.get(), bytes);
  std::string stage = "repair";
  isolod::Hooks hooks;
  hooks.context = &stage;
  hooks.progress = take_stage;
  isolod::Remesher remesher;
  isolod::Status status = remesher.begin(view, options, hooks, arena);
  while (status.is_ok() && !remesher.done()) {
    Piece piece{stage, tool::now_seconds()};
    status = remesher.advance(0);
    piece.seconds = tool::now_seconds() - piece.seconds;
    pieces.push_back(piece);
  }
  return status;
}

}  // namespace

isolod::Status time_pieces(const isolod::MeshView& view, const isolod::Options& options, std::uint64_t repeats,
                           std::vector<StagePieces>& stages) {
  std::vector<Piece> least;
  for (std::uint64_t i = 0; i < repeats; ++i) {
    std::vector<Piece> pieces;
    const isolod::Status status = run_pieces(view, options, pieces);
    if (!status.is_ok()) return status;
    if (i == 0) least = pieces;
    for (std::size_t p = 0; p < pieces.size(); ++p) least[p].seconds = std::min(least[p].seconds, pieces[p].seconds);
  }
  for (const Piece& piece : least) {
    auto found =
        std::find_if(stages.begin(), stages.end(), [&](const StagePieces& s) { return s.stage == piece.stage; });
    if (found == stages.end()) found = stages.insert(found, {piece.stage, 0, 0, 0});
    ++found->count;
    found->seconds += piece.seconds;
    found->longest_seconds = std::max(found->longest_seconds, piece.seconds);
  }
  return {};
}

}  // namespace bench
