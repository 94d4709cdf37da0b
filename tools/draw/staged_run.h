// A run of the pipeline that stops after a stage, to be looked at.
#pragma once

#include <cstddef>
#include <memory>

#include "pipeline/state.h"

namespace draw {

/// A block for an arena. Memory that is not written costs nothing, so it may be large; where it cannot be had, half of
/// it may do.
struct Block {
  explicit Block(std::size_t wished);
  isolod::Arena arena() const { return isolod::Arena(bytes.get(), count); }

  std::unique_ptr<unsigned char[]> bytes;
  std::size_t count;
};

class StagedRun {
 public:
  /// `block_bytes` of working memory; 0: plenty, as far as it can be had. `view`'s data must stay.
  StagedRun(const isolod::MeshView& view, const isolod::Options& options, std::size_t block_bytes = 0);
  StagedRun(const StagedRun&) = delete;
  StagedRun& operator=(const StagedRun&) = delete;

  /// Does one piece of work.
  isolod::Status advance();
  /// Goes on until the stage of that name has ended.
  isolod::Status finish(const char* stage);
  /// Goes on to the end.
  isolod::Status finish();

  bool done() const { return remesher_.done(); }
  /// Null where the run did not even begin.
  const isolod::Remesher::State* state() const { return remesher_.state(); }
  std::size_t block_bytes() const { return block_.count; }
  /// What the run leaves free, for looking; to be given back before it goes on.
  isolod::Arena& arena() { return arena_; }

 private:
  Block block_;
  isolod::Arena arena_;
  isolod::Remesher remesher_;
  isolod::Status status_;
};

}  // namespace draw
