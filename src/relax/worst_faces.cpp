#include "relax/worst_faces.h"

#include "base/array_bytes.h"
#include "base/status.h"
#include "relax/drop_dead.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double thirty_degrees = 0.5773502691896258;  // the score of a face with that least angle
constexpr std::uint32_t polish_rounds = 12;
constexpr std::uint32_t visits_a_piece = 2;
/// Passes of resettling, the worst faces first: shares of the wanted score; what is better is left where it is.
constexpr double resettle_shares[] = {0.5, 0.8, 0.94, 0.94};
constexpr std::uint32_t resettle_passes = sizeof resettle_shares / sizeof resettle_shares[0];

}  // namespace

std::size_t WorstFaces::bytes(std::size_t sample_count, std::size_t face_count) {
  return StarMoves::bytes(sample_count) + Resettle::bytes() + array_bytes<std::uint8_t>(sample_count) +
         drop_dead_bytes(sample_count, face_count);
}

Status WorstFaces::begin(const Surface& surface, const Backbones* features, const WorstFacesOptions& options,
                         Triangulation& mesh, Samples& samples, Arena& arena) {
  options_ = options;
  mesh_ = &mesh;
  samples_ = &samples;
  phase_ = Phase::look;
  sweep_ = {};
  next_ = 0;
  round_ = pass_ = changed_ = 0;
  const std::uint32_t count = static_cast<std::uint32_t>(samples.count());
  visits_left_ = 2000 + 2 * count;
  tries_left_ = 100 + count / 100;
  ISOLOD_TRY(moves_.begin(surface, features, mesh, samples, arena));
  moves_.asks_at_centroids = options.asks_at_centroids;
  moves_.slides_below = options.keeps_lines ? thirty_degrees : 1;
  const Backbones* given_up = options.keeps_lines ? nullptr : features;
  ISOLOD_TRY(resettle_.begin(surface, given_up, options.wanted_score, mesh, samples, moves_, arena));
  return arena.scratch(samples.count(), is_touched_);
}

void WorstFaces::touch_around(VertexId v) {
  is_touched_[v] = 1;
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) {
    is_touched_[mesh_->mesh.target(h)] = 1;
    is_touched_[mesh_->mesh.apex(h)] = 1;
  });
}

/// Tells whether that was any work.
bool WorstFaces::visit(VertexId v) {
  if (!is_touched_[v]) return false;
  is_touched_[v] = 0;
  if (moves_.star_score(v) > options_.wanted_score || visits_left_ == 0) return false;
  --visits_left_;
  const bool flipped = moves_.flip(v);
  const bool moved = moves_.move(v);
  if (!flipped && !moved) return true;
  ++changed_;
  touch_around(v);
  return true;
}

bool WorstFaces::resettle(FaceId f) {
  const double least = resettle_shares[pass_] * options_.wanted_score;
  if (tries_left_ == 0 || mesh_->is_dead(f) || moves_.score(f) > least) return false;
  if (resettle_.improve(f, tries_left_)) {
    for (VertexId v : resettle_.region()) is_touched_[v] = 1;
  }
  return true;
}

/// As `Sweep::over`, but a piece also ends behind so much work.
template <class Id, class Visit>
bool WorstFaces::over(std::size_t count, std::uint32_t most_work, Visit visit) {
  std::uint32_t work = 0;
  for (std::size_t seen = 0; next_ < count && seen < elements_a_piece && work < most_work; ++seen) {
    work += visit(Id{static_cast<std::uint32_t>(next_++)});
  }
  if (next_ < count) return false;
  next_ = 0;
  return true;
}

void WorstFaces::end_round() {
  const bool goes_on = changed_ > 0 && ++round_ < polish_rounds;
  changed_ = 0;
  if (goes_on) return;
  round_ = 0;
  phase_ = options_.resettles && pass_ < resettle_passes ? Phase::resettle : Phase::done;
}

void WorstFaces::step() {
  switch (phase_) {
    case Phase::look:
      if (!sweep_.over<SampleId>(samples_->count(), [&](SampleId s) {
            moves_.look(s);
            is_touched_[s] = 1;
          })) {
        return;
      }
      phase_ = Phase::rounds;
      return;
    case Phase::rounds:
      if (over<VertexId>(samples_->count(), visits_a_piece, [&](VertexId v) { return visit(v); })) end_round();
      return;
    case Phase::resettle:
      if (!over<FaceId>(mesh_->mesh.face_count(), 1, [&](FaceId f) { return resettle(f); })) return;
      ++pass_;
      phase_ = Phase::rounds;
      return;
    case Phase::done:
      return;
  }
}

Status WorstFaces::finish(Arena& arena) { return drop_dead_samples(*mesh_, *samples_, arena); }

Status improve_worst_faces(const Surface& surface, const Backbones* features, const WorstFacesOptions& options,
                           Triangulation& mesh, Samples& samples, Arena& arena) {
  const ScratchScope scope(arena);
  WorstFaces stage;
  ISOLOD_TRY(stage.begin(surface, features, options, mesh, samples, arena));
  while (!stage.done()) stage.step();
  return stage.finish(arena);
}

}  // namespace v1
}  // namespace isolod
