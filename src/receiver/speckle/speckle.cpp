// speckle.cpp -- draws the scatterers of each bin's window.

#include "receiver/speckle/speckle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vector_math.h"
#include "echo/laws/laws.h"

namespace insonify {
namespace {

// What all bins of one run share.
struct RunPhases {
  ScattererKey key;
  SpeckleShape shape;
  ScattererPhases phases;
};

// Input and output of a run, [bin]; fields [bin][real, imaginary].
struct RunRows {
  const std::uint32_t *patch, *index;
  const float *begin, *length, *energy;
  float *field, *before, *after;
};

// Pulses longer than this many bins share scatterers between bins.
constexpr double kLongPulse = 1.5;

constexpr int kBlock = 64;  // Bins drawn together.

// Sums over a bin's scatterers: for the bin itself, and for the bins before and after.
struct BinField {
  float real = 0, imaginary = 0, real_before = 0, imaginary_before = 0, real_after = 0, imaginary_after = 0;
  float count = 0;
};

template <bool kSpread, bool kShared>
[[gnu::always_inline]] inline void add_scatterer(std::uint32_t i, const ScattererBin& bin, const RunPhases& run,
                                                 BinField& sum) {
  const ScattererEcho echo = scatterer_at(i, bin, run.key, run.phases, kSpread);
  if constexpr (kShared) {
    const ScattererShares shares = scatterer_shares(echo.place, run.shape.bins_per_window);
    sum.real += shares.own * echo.real;
    sum.imaginary += shares.own * echo.imaginary;
    sum.real_before += shares.before * echo.real;
    sum.imaginary_before += shares.before * echo.imaginary;
    sum.real_after += shares.after * echo.real;
    sum.imaginary_after += shares.after * echo.imaginary;
  } else {
    sum.real += echo.real;
    sum.imaginary += echo.imaginary;
    sum.count += echo.inside;
  }
}

// A window of at most 2.4 steps contains the middles of at most three, of at most 2 steps those of two.
template <int kMost, bool kSpread, bool kShared>
[[gnu::always_inline]] inline void draw_bins(BinRange bins, const RunPhases& of_run,
                                             const std::uint32_t* __restrict__ patch,
                                             const std::uint32_t* __restrict__ index, const float* __restrict__ begin,
                                             const float* __restrict__ length, const float* __restrict__ energy,
                                             float* __restrict__ field, float* __restrict__ before,
                                             float* __restrict__ after) {
  const RunPhases run = of_run;
  for (int bin = bins.first; bin < bins.last; ++bin) {
    const std::uint32_t fixed = run.shape.first_turns + static_cast<std::uint32_t>(bin) * run.shape.turns_per_bin;
    const float per_step = 1 / length[bin];
    const ScattererBin window{
        .index = index[bin],
        .name = patch_hash(patch[bin], run.key),
        .begin = begin[bin],
        .per_step = per_step,
        .near_end = per_step < 0 ? 1.0F : 0.0F,
        .near_turns = static_cast<float>(static_cast<std::int32_t>(fixed >> 8)) * (1.0F / 16777216)};
    BinField sum;
    add_scatterer<kSpread, kShared>(0, window, run, sum);
    add_scatterer<kSpread, kShared>(1, window, run, sum);
    if constexpr (kMost > 2) {
      add_scatterer<kSpread, kShared>(2, window, run, sum);
    }
    const float intensity = kShared ? run.shape.shared * std::abs(per_step) : share_of_count(sum.count);
    const float scale = std::sqrt(energy[bin] * intensity);
    const std::ptrdiff_t at = std::ptrdiff_t{2} * bin;
    field[at] = scale * sum.real;
    field[at + 1] = scale * sum.imaginary;
    if constexpr (kShared) {
      before[at] = scale * sum.real_before;
      before[at + 1] = scale * sum.imaginary_before;
      after[at] = scale * sum.real_after;
      after[at + 1] = scale * sum.imaginary_after;
    }
  }
}

template <int kMost, bool kSpread, bool kShared>
[[gnu::always_inline]] inline void draw_rows(BinRange bins, const RunPhases& run, const RunRows& rows) {
  draw_bins<kMost, kSpread, kShared>(bins, run, rows.patch, rows.index, rows.begin, rows.length, rows.energy,
                                     rows.field, rows.before, rows.after);
}

INSONIFY_VECTOR_CLONES
void draw_apart(BinRange bins, const RunPhases& run, const RunRows& rows) {
  draw_rows<3, false, false>(bins, run, rows);
}

INSONIFY_VECTOR_CLONES
void draw_spread(BinRange bins, const RunPhases& run, const RunRows& rows) {
  draw_rows<3, true, false>(bins, run, rows);
}

INSONIFY_VECTOR_CLONES
void draw_shared(BinRange bins, const RunPhases& run, const RunRows& rows) {
  draw_rows<3, false, true>(bins, run, rows);
}

INSONIFY_VECTOR_CLONES
void draw_two_apart(BinRange bins, const RunPhases& run, const RunRows& rows) {
  draw_rows<2, false, false>(bins, run, rows);
}

INSONIFY_VECTOR_CLONES
void draw_two_spread(BinRange bins, const RunPhases& run, const RunRows& rows) {
  draw_rows<2, true, false>(bins, run, rows);
}

INSONIFY_VECTOR_CLONES
void draw_two_shared(BinRange bins, const RunPhases& run, const RunRows& rows) {
  draw_rows<2, false, true>(bins, run, rows);
}

// Whether no window of the bins is longer than two steps.
INSONIFY_VECTOR_CLONES
bool has_two(BinRange bins, const float* __restrict__ length) {
  std::uint32_t longer = 0;
  for (int bin = bins.first; bin < bins.last; ++bin) {
    longer |= std::abs(length[bin]) > 2 ? 1U : 0U;
  }
  return longer == 0;
}

INSONIFY_VECTOR_CLONES
void add_floats(int count, const float* __restrict__ from, float* __restrict__ to) {
  for (int i = 0; i < count; ++i) {
    to[i] += from[i];
  }
}

// Factor on the intensity of shared scatterers that preserves the mean after the pulse: the sum of p^2 over bins,
// divided by the integral of the square of p interpolated linearly between bins.
double shared_intensity(const RangeResponse& range) {
  double sum = 0, integral = 0;
  const int reach = range.taps() / 2 + 1;
  for (int tap = -reach; tap < reach; ++tap) {
    const double here = double{range.amplitude(tap)}, next = double{range.amplitude(tap + 1)};
    sum += here * here;
    integral += (here * here + here * next + next * next) / 3;
  }
  return sum / integral;
}

// The fraction of `turns` in 2^-32 turns.
std::uint32_t fixed_point(double turns) {
  return static_cast<std::uint32_t>(static_cast<std::int64_t>((turns - std::floor(turns)) * 4294967296.0));
}

}  // namespace

Speckle::Speckle(const ScattererLattice& lattice, const RangeResponse* range, CarrierSpread spread)
    : shape_{.first_turns = fixed_point(lattice.turns_per_metre() * (lattice.first_range() - 0.5 * lattice.window())),
             .turns_per_bin = fixed_point(lattice.turns_per_metre() * lattice.bin_length()),
             .turns_per_window = static_cast<float>(lattice.turns_per_metre() * lattice.window()),
             .bins_per_window = static_cast<float>(lattice.window() / lattice.bin_length()),
             .shared = range != nullptr && range->equivalent_cells() >= kLongPulse
                           ? static_cast<float>(shared_intensity(*range))
                           : 0.0F,
             .spread_share = static_cast<float>(spread.share),
             .spread_turns = static_cast<float>(lattice.turns_per_metre() * spread.length)} {}

float Speckle::turns_before(int bin) const {
  const std::uint32_t turns = shape_.first_turns + static_cast<std::uint32_t>(bin) * shape_.turns_per_bin;
  return static_cast<float>(turns >> 8) * (1.0F / 16777216.0F);
}

void Speckle::draw(ScattererRow& row, std::span<const float> energy, std::span<std::complex<float>> field) const {
  const auto floats = [](auto& fields) { return reinterpret_cast<float*>(fields.data()); };
  const RunRows rows{.patch = row.patch.data(),
                     .index = row.index.data(),
                     .begin = row.begin.data(),
                     .length = row.length.data(),
                     .energy = energy.data(),
                     .field = floats(field),
                     .before = floats(row.before),
                     .after = floats(row.after)};
  const auto draw = shape_.shared > 0 ? draw_shared : shape_.spread_share > 0 ? draw_spread : draw_apart;
  const auto draw_two = shape_.shared > 0         ? draw_two_shared
                        : shape_.spread_share > 0 ? draw_two_spread
                                                  : draw_two_apart;
  for (const ScattererRow::Run& run : row.runs) {
    const RunPhases phases{
        .key = run.key,
        .shape = shape_,
        .phases = {.per_window = shape_.turns_per_window,
                   .across = run.across_turns,
                   .spread_share = shape_.spread_share,
                   .per_chance = shape_.spread_share > 0 ? shape_.spread_turns / shape_.spread_share : 0.0F,
                   .spread_half = 0.5F * shape_.spread_turns}};
    for (BinRange block{run.bins.first, 0}; block.first < run.bins.last; block.first = block.last) {
      block.last = std::min(block.first + kBlock, run.bins.last);
      (has_two(block, rows.length) ? draw_two : draw)(block, phases, rows);
    }
  }
}

void Speckle::add(std::complex<float> echo, float place, int bin, ScattererRow& row,
                  std::span<std::complex<float>> field) const {
  if (shape_.shared == 0) {
    field[bin] += echo;
    return;
  }
  const ScattererShares shares = scatterer_shares(place, shape_.bins_per_window);
  const std::complex<float> shared = std::sqrt(shape_.shared) * echo;
  field[bin] += shares.own * shared;
  row.before[bin] += shares.before * shared;
  row.after[bin] += shares.after * shared;
}

// At the ends of the row, the shares outside it are added to the bin itself.
void Speckle::share(const ScattererRow& row, std::span<std::complex<float>> field) const {
  if (shape_.shared == 0 || row.bins.empty()) {
    return;
  }
  const int first = row.bins.first, last = row.bins.last - 1;
  field[first] += row.before[first];
  field[last] += row.after[last];
  const int count = 2 * (last - first);
  auto* const fields = reinterpret_cast<float*>(field.data());
  add_floats(count, reinterpret_cast<const float*>(&row.after[first]), fields + std::ptrdiff_t{2} * (first + 1));
  add_floats(count, reinterpret_cast<const float*>(row.before.data()) + std::ptrdiff_t{2} * (first + 1),
             fields + std::ptrdiff_t{2} * first);
}

}  // namespace insonify
