#include "draw/staged_run.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace draw {

using isolod::Status;

namespace {

std::size_t plenty(const isolod::MeshView& view, const isolod::Options& options) {
  constexpr std::size_t most_bytes = std::size_t{1} << 32;
  return std::min(4 * isolod::required_memory(view.vertex_count, view.triangle_count, options), most_bytes);
}

}  // namespace

Block::Block(std::size_t wished) : count(wished) {
  bytes.reset(new (std::nothrow) unsigned char[count]);
  while (bytes == nullptr && count > 0) bytes.reset(new (std::nothrow) unsigned char[count /= 2]);
}

StagedRun::StagedRun(const isolod::MeshView& view, const isolod::Options& options, std::size_t block_bytes)
    : block_(block_bytes != 0 ? block_bytes : plenty(view, options)), arena_(block_.arena()) {
  status_ = remesher_.begin(view, options, {}, arena_);
}

Status StagedRun::advance() {
  if (status_.is_ok() && !done()) status_ = remesher_.advance(0);
  return status_;
}

Status StagedRun::finish(const char* stage) {
  std::uint32_t end = 0;
  while (end < isolod::stage_entry_count && std::strcmp(isolod::stage_entries[end].name, stage) != 0) ++end;
  while (status_.is_ok() && !done() && state()->stage <= end) (void)advance();
  return status_;
}

Status StagedRun::finish() {
  while (status_.is_ok() && !done()) (void)advance();
  return status_;
}

}  // namespace draw
