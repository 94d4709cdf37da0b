#include "relax/mass_loop.h"

#include "base/array_bytes.h"
#include "base/elementary.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double loop_gain = 1.0;
constexpr double most_correction = 1.0;
constexpr std::uint32_t rings = 6;
constexpr double whole_turn = 6.283185307179586;

}  // namespace

std::size_t MassLoop::bytes(std::size_t sample_count) { return 2 * array_bytes<double>(sample_count); }

Status MassLoop::begin(const Triangulation& mesh, const Samples& samples, Arena& arena) {
  mesh_ = &mesh;
  samples_ = samples;
  phase_ = Phase::done;
  sweep_ = {};
  ISOLOD_TRY(arena.scratch(samples.count(), error_));
  return arena.scratch(samples.count(), averaged_);
}

/// The mean mass is the unit of all: the logarithm of a bare mass would depend on the scale in its last bits.
void MassLoop::add_mass(SampleId s, const StarCell& cell) {
  if (!is_counted(s, cell)) return;
  mass_ += cell.mass;
  count_ += 1;
}

/// Up to the mean, which is taken off at the end.
double MassLoop::error_of(SampleId s, const StarCell& cell) {
  if (!is_counted(s, cell)) return 0;
  const double error = logarithm(cell.mass / (mass_ / count_) * whole_turn / averaged_[s]);
  sum_ += error;
  return error;
}

/// Half its own error, half the mean over its ring: on the surface over those that are free, on a line along it.
double MassLoop::average_around(SampleId s) const {
  double sum = error_[s], count = 1;
  const auto add = [&](VertexId v) {
    const SampleId other{v.value};
    sum += error_[other];
    count += 1;
  };
  if (samples_.held[s]) {
    visit_line_neighbours(*mesh_, vertex(s), add);
  } else {
    visit_outgoing(mesh_->mesh, vertex(s), [&](HalfedgeId h) {
      const VertexId v = mesh_->mesh.target(h);
      if (!samples_.held[SampleId{v.value}]) add(v);
    });
  }
  return 0.5 * (error_[s] + sum / count);
}

void MassLoop::step(Span<const StarCell> cell, const Parallel& parallel) {
  const std::size_t count = samples_.count();
  switch (phase_) {
    case Phase::masses:
      if (sweep_.over<SampleId>(count, [&](SampleId s) { add_mass(s, cell[s]); })) phase_ = Phase::errors;
      return;
    case Phase::errors:
      if (!sweep_.over<SampleId>(count, [&](SampleId s) { error_[s] = error_of(s, cell[s]); })) return;
      phase_ = Phase::fill;
      return;
    case Phase::fill: {
      const auto fill = [&](SampleId s) {
        if (!is_counted(s, cell[s])) error_[s] = mean();
      };
      if (sweep_.over<SampleId>(parallel, count, fill)) phase_ = Phase::average;
      return;
    }
    case Phase::average: {
      if (!sweep_.over<SampleId>(parallel, count, [&](SampleId s) { averaged_[s] = average_around(s); })) return;
      const Span<double> swap = error_;
      error_ = averaged_;
      averaged_ = swap;
      if (++round_ == rings) phase_ = Phase::correct;
      return;
    }
    case Phase::correct: {
      const auto correct = [&](SampleId s) {
        const double c = samples_.correction[s] + loop_gain * (error_[s] - mean());
        samples_.correction[s] = greater(-most_correction, smaller(most_correction, c));
      };
      if (!sweep_.over<SampleId>(parallel, count, correct)) return;
      phase_ = Phase::done;
      return;
    }
    case Phase::done:
      return;
  }
}

}  // namespace v1
}  // namespace isolod
