// defocused_tables.cpp -- samples patterns at twice the density that their band limit needs, and interpolates the rest.

#include "receiver/array/defocused_tables.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/interruption.h"
#include "base/vector_math.h"

namespace insonify {
namespace {

using std::numbers::pi;

constexpr int kFine = 20;  // Points of a table per sample of the pattern.
constexpr int kTaps = 12;  // Samples that a point is interpolated from.

// [point between two samples][sample] Weights of interpolation for a signal of at most a quarter cycle per sample: a
// sinc under a Kaiser window whose stop band is at -90 dB (Oppenheim and Schafer, Discrete-Time Signal Processing, 3rd
// ed. (2010), section 7.5.3).
std::array<std::array<double, kTaps>, kFine> interpolation() {
  constexpr double kBeta = 9;
  std::array<std::array<double, kTaps>, kFine> weights;
  for (int point = 0; point < kFine; ++point) {
    double sum = 0;
    for (int tap = 0; tap < kTaps; ++tap) {
      const double distance = tap - (kTaps / 2 - 1) - static_cast<double>(point) / kFine;
      const double share = 2 * distance / kTaps, angle = pi * distance;
      const double window = std::cyl_bessel_i(0, kBeta * std::sqrt(std::max(0.0, 1 - share * share)));
      weights[point][tap] = window * (angle == 0 ? 1 : std::sin(angle) / angle);
      sum += weights[point][tap];
    }
    for (double& weight : weights[point]) {
      weight /= sum;
    }
  }
  return weights;
}

// Number of the nearest tabulated phase, and the phase of a number: even steps up to 1 rad, then even ratios.
constexpr double kStepsToOne = 1 / DefocusedTables::kPhaseStep;

long step_of(double phase) {
  const double size = std::abs(phase), steps = kStepsToOne * (size < 1 ? size : 1 + std::log(size));
  return std::lround(std::copysign(steps, phase));
}

double phase_of(long step) {
  const double size = std::abs(static_cast<double>(step)) / kStepsToOne;
  return std::copysign(size < 1 ? size : std::exp(size - 1), static_cast<double>(step));
}

// What look_up_row() needs of a table.
struct Part {
  std::int32_t reach;               // Bits of the largest |x| of the table's own points.
  std::int32_t near, far;           // Point x = 0 of the table's own and of those in focus.
  std::int32_t turned, turned_off;  // Bits of the real and the imaginary part of the factor of those in focus.
  std::int32_t alternating;         // 1 where the sign changes from period to period; else 0.
  float density, period, per_period, steered;
};

// Interpolates between the point towards x = 0 and the next. Comparisons are of integers, which compilers vectorise.
INSONIFY_VECTOR_CLONES
void look_up_row(int count, const Part part, const float* __restrict__ points, const float* __restrict__ places,
                 const float* __restrict__ factors, float* __restrict__ in_phase, float* __restrict__ quadrature) {
  constexpr float kRounder = 12582912.0F;  // 1.5 x 2^23: adding and subtracting it rounds.
  constexpr auto kOne = std::bit_cast<std::int32_t>(1.0F);
  for (int i = 0; i < count; ++i) {
    const float x = places[i] - part.steered;
    const float periods = (x * part.per_period + kRounder) - kRounder;
    const float sign = 1.0F - 2.0F * static_cast<float>(static_cast<std::int32_t>(periods) & part.alternating);
    const float within = x - part.period * periods;
    const bool is_near = std::bit_cast<std::int32_t>(std::abs(within)) <= part.reach;
    const float place = within * part.density;
    const auto whole = static_cast<std::int32_t>(place);
    const std::int32_t outwards = 1 | (std::bit_cast<std::int32_t>(place) >> 31);
    const float share = std::abs(place - static_cast<float>(whole));
    const std::int32_t point = 2 * (whole + (is_near ? part.near : part.far)), next = point + 2 * outwards;
    const float real = points[point] + share * (points[next] - points[point]);
    const float imaginary = points[point + 1] + share * (points[next + 1] - points[point + 1]);
    const float turned = std::bit_cast<float>(is_near ? kOne : part.turned);
    const float turned_off = std::bit_cast<float>(is_near ? 0 : part.turned_off);
    in_phase[i] = sign * factors[i] * (real * turned - imaginary * turned_off);
    quadrature[i] = sign * factors[i] * (real * turned_off + imaginary * turned);
  }
}

}  // namespace

DefocusedTables::DefocusedTables(const ArrayPattern& pattern, int elements, double reach, double floor)
    : pattern_(pattern),
      period_(static_cast<float>(elements)),
      reach_(reach),
      floor_(floor),
      within_(elements > 0 ? std::min(reach, 0.5 * elements) : reach),
      density_(pattern.is_two_way() ? 4 * kFine : 2 * kFine),
      alternating_(elements % 2 == 0 && !pattern.is_two_way()),
      in_focus_(add_points(pattern, within_)) {}

// Adds the amplitudes from -reach to reach; returns the number of the point in the middle. One way, patterns are
// band-limited to half a cycle per unit of x, the length of the array; two samples per unit are twice as many as
// needed.
int DefocusedTables::add_points(const ArrayPattern& pattern, double reach) {
  static const auto kWeights = interpolation();
  const int half = static_cast<int>(std::ceil(reach * density_ / kFine)) + 1, count = 2 * half;
  const auto middle = static_cast<int>(points_.size()) + half * kFine;
  std::vector<std::complex<double>> samples;
  for (int i = -half - kTaps / 2 + 1; i <= half + kTaps / 2; ++i) {
    samples.push_back(pattern.amplitude(i * kFine / density_));
  }
  for (int i = 0; i < count; ++i) {
    for (const auto& weights : kWeights) {
      std::complex<double> sum = 0;
      for (int tap = 0; tap < kTaps; ++tap) {
        sum += weights[tap] * samples[i + tap];
      }
      points_.emplace_back(sum);
    }
  }
  return middle;
}

int DefocusedTables::table_for(double edge_phase) {
  const auto [entry, is_new] = numbers_.try_emplace(step_of(edge_phase), static_cast<int>(tables_.size()));
  if (is_new) {
    check_interruption();  // Arrays of a thousand wavelengths take tenths of a second.
    const double phase = phase_of(entry->first);
    const double near = std::min(within_, ArrayPattern::kExactReach + 4 * std::abs(phase));
    tables_.push_back({.reach = static_cast<float>(near),
                       .middle = add_points(pattern_.defocused(phase), near),
                       .far = std::complex<float>(std::polar(1.0, pattern_.is_two_way() ? 2 * phase : phase))});
    tables_.back().extent = measured(entry->second);
  }
  return entry->second;
}

void DefocusedTables::look_up(int table, double steered, std::span<const float> places, std::span<const float> factors,
                              float* in_phase, float* quadrature) const {
  const Table& of = tables_[table];
  look_up_row(static_cast<int>(places.size()),
              {.reach = std::bit_cast<std::int32_t>(of.reach),
               .near = of.middle,
               .far = in_focus_,
               .turned = std::bit_cast<std::int32_t>(of.far.real()),
               .turned_off = std::bit_cast<std::int32_t>(of.far.imag()),
               .alternating = alternating_ ? 1 : 0,
               .density = static_cast<float>(density_),
               .period = period_,
               .per_period = period_ > 0 ? 1 / period_ : 0,
               .steered = static_cast<float>(steered)},
              reinterpret_cast<const float*>(points_.data()), places.data(), factors.data(), in_phase, quadrature);
}

std::complex<float> DefocusedTables::amplitude(int table, double x) const {
  const auto place = static_cast<float>(x);
  constexpr float kOne = 1;
  float in_phase = 0, quadrature = 0;
  look_up(table, 0, {&place, 1}, {&kOne, 1}, &in_phase, &quadrature);
  return {in_phase, quadrature};
}

// From the outside inwards, in steps of an eighth of a side lobe.
DefocusedTables::Extent DefocusedTables::measured(int table) const {
  constexpr double kStep = 0.125;
  constexpr int kTogether = 64;
  std::array<float, kTogether> places, factors, in_phase, quadrature;
  factors.fill(1);
  const auto end_towards = [&](double side) {
    double x = reach_;
    for (int i = kTogether; x > -reach_; ++i, x -= kStep) {
      if (i == kTogether) {
        double next = x;
        for (float& place : places) {
          place = static_cast<float>(side * std::max(next, -reach_));
          next -= kStep;
        }
        look_up(table, 0, places, factors, in_phase.data(), quadrature.data());
        i = 0;
      }
      if (!(std::norm(std::complex<double>(in_phase[i], quadrature[i])) < floor_)) {
        break;
      }
    }
    return x + kStep;
  };
  return {-end_towards(-1), end_towards(1)};
}

}  // namespace insonify
