// speckle.cpp -- draws the scatterers of each bin's window.

#include "receiver/speckle/speckle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vector_math.h"
#include "receiver/speckle/scatterer_hash.h"

namespace insonify {
namespace {

// Constants of all bins of one run.
struct RunPhases {
  std::array<std::uint32_t, 4> key;
  std::uint32_t first_turns, turns_per_bin;  // See Speckle.
  float turns_per_window, across_turns;
  float spread_share, turns_per_chance, spread_half;  // Spread over -half to half.
  float bins_per_window, shared;
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

// Constants of all scatterers of a bin.
struct BinWindow {
  std::uint32_t index, name;
  float begin, per_step,
      near_end;  // Lower end of the window [steps]; windows per step; 1 if ranges fall with the index.
  float near_turns;
};

template <bool kSpread, bool kShared>
[[gnu::always_inline]] inline void add_scatterer(std::uint32_t i, const BinWindow& bin, const RunPhases& run,
                                                 BinField& sum) {
  const ScattererWords words = scatterer_words(bin.index + i, bin.name, run.key);
  // Position from the window's near edge, 0 to 1 inside the window.
  const float middle = bin.near_end + (static_cast<float>(i) + 0.5F - bin.begin) * bin.per_step;
  const float place = middle + place_in_step(words) * bin.per_step;
  const float inside = (middle < 0 ? 0.0F : 1.0F) * (middle < 1 ? 1.0F : 0.0F);
  float turns = uniform_open(words.phase) + bin.near_turns + place * run.turns_per_window +
                place_across(words) * run.across_turns;
  if constexpr (kSpread) {
    const float chance = spread_number(words);
    turns += chance < run.spread_share ? chance * run.turns_per_chance - run.spread_half : 0.0F;
  }
  const float rest = turns - static_cast<float>(static_cast<std::int32_t>(turns));
  const SineCosine phase = fast_sine_cosine(rest < 0 ? rest + 1 : rest);
  const float amplitude = inside * std::sqrt(-fast_log(uniform_open(words.amplitude)));
  const float real = amplitude * phase.cosine, imaginary = amplitude * phase.sine;
  if constexpr (kShared) {
    const float off = (place - 0.5F) * run.bins_per_window;
    const float after = off > 0 ? off : 0.0F, before = after - off, own = 1 - after - before;
    sum.real += own * real;
    sum.imaginary += own * imaginary;
    sum.real_before += before * real;
    sum.imaginary_before += before * imaginary;
    sum.real_after += after * real;
    sum.imaginary_after += after * imaginary;
  } else {
    sum.real += real;
    sum.imaginary += imaginary;
    sum.count += inside;
  }
}

// 1 / count for 1 to 3; a division of sixteen numbers takes as long as sixteen multiplications.
[[gnu::always_inline]] inline float share_of_count(float count) {
  return count < 1.5F ? 1.0F : count < 2.5F ? 0.5F : 1.0F / 3;
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
    const std::uint32_t fixed = run.first_turns + static_cast<std::uint32_t>(bin) * run.turns_per_bin;
    const float per_step = 1 / length[bin];
    const BinWindow window{.index = index[bin],
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
    const float intensity = kShared ? run.shared * std::abs(per_step) : share_of_count(sum.count);
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
    : first_turns_(fixed_point(lattice.turns_per_metre() * (lattice.first_range() - 0.5 * lattice.window()))),
      turns_per_bin_(fixed_point(lattice.turns_per_metre() * lattice.bin_length())),
      turns_per_window_(static_cast<float>(lattice.turns_per_metre() * lattice.window())),
      bins_per_window_(static_cast<float>(lattice.window() / lattice.bin_length())),
      shared_(range != nullptr && range->equivalent_cells() >= kLongPulse ? static_cast<float>(shared_intensity(*range))
                                                                          : 0.0F),
      spread_share_(static_cast<float>(spread.share)),
      spread_turns_(static_cast<float>(lattice.turns_per_metre() * spread.length)) {}

float Speckle::turns_before(int bin) const {
  const std::uint32_t turns = first_turns_ + static_cast<std::uint32_t>(bin) * turns_per_bin_;
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
  const auto draw = shared_ > 0 ? draw_shared : spread_share_ > 0 ? draw_spread : draw_apart;
  const auto draw_two = shared_ > 0 ? draw_two_shared : spread_share_ > 0 ? draw_two_spread : draw_two_apart;
  for (const ScattererRow::Run& run : row.runs) {
    const RunPhases phases{.key = run.key,
                           .first_turns = first_turns_,
                           .turns_per_bin = turns_per_bin_,
                           .turns_per_window = turns_per_window_,
                           .across_turns = run.across_turns,
                           .spread_share = spread_share_,
                           .turns_per_chance = spread_share_ > 0 ? spread_turns_ / spread_share_ : 0.0F,
                           .spread_half = 0.5F * spread_turns_,
                           .bins_per_window = bins_per_window_,
                           .shared = shared_};
    for (BinRange block{run.bins.first, 0}; block.first < run.bins.last; block.first = block.last) {
      block.last = std::min(block.first + kBlock, run.bins.last);
      (has_two(block, rows.length) ? draw_two : draw)(block, phases, rows);
    }
  }
}

void Speckle::add(std::complex<float> echo, float place, int bin, ScattererRow& row,
                  std::span<std::complex<float>> field) const {
  if (shared_ == 0) {
    field[bin] += echo;
    return;
  }
  const float off = (place - 0.5F) * bins_per_window_, later = std::max(off, 0.0F), earlier = std::max(-off, 0.0F);
  const std::complex<float> shared = std::sqrt(shared_) * echo;
  field[bin] += (1 - later - earlier) * shared;
  row.before[bin] += earlier * shared;
  row.after[bin] += later * shared;
}

// At the ends of the row, the shares outside it are added to the bin itself.
void Speckle::share(const ScattererRow& row, std::span<std::complex<float>> field) const {
  if (shared_ == 0 || row.bins.empty()) {
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
