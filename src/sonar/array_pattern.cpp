// array_pattern.cpp -- beam patterns of line arrays: sums over elements or, for continuous lines, closed forms.

#include "insonify/array_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/philox.h"
#include "insonify/error.h"
#include "sonar/lobes.h"
#include "sonar/window.h"

namespace insonify {
namespace {

using std::numbers::pi;

// Sum over n of w_n e^(-i 2 pi x ((N - 1)/2 - n) / N) by Horner's rule. Element 0 is at the port end, where u is
// positive: nearer to a source there, whose phase grows with range.
template <typename Weight>
std::complex<double> sum_elements(int count, double x, const Weight& weight) {
  const double turn = 2 * pi * x / count;
  const std::complex<double> z = std::polar(1.0, turn);
  std::complex<double> sum = 0;
  for (int n = count - 1; n >= 0; --n) {
    sum = {sum.real() * z.real() - sum.imag() * z.imag(), sum.real() * z.imag() + sum.imag() * z.real()};
    sum += weight(n);
  }
  return sum * std::polar(1.0, -turn * (count - 1) / 2);
}

// The same in four sums of every fourth element, which a processor computes side by side.
std::complex<double> sum_in_four(const std::vector<std::complex<double>>& weights, double x) {
  const auto count = static_cast<int>(weights.size());
  const double turn = 2 * pi * x / count;
  const std::complex<double> z = std::polar(1.0, 4 * turn);
  std::complex<double> sums[4] = {};
  for (int first = (count - 1) / 4 * 4; first >= 0; first -= 4) {
    for (int k = 0; k < 4; ++k) {
      std::complex<double>& sum = sums[k];
      sum = {sum.real() * z.real() - sum.imag() * z.imag(), sum.real() * z.imag() + sum.imag() * z.real()};
      if (first + k < count) {
        sum += weights[first + k];
      }
    }
  }
  std::complex<double> sum = 0;
  for (int k = 0; k < 4; ++k) {
    sum += sums[k] * std::polar(1.0, k * turn);
  }
  return sum * std::polar(1.0, -turn * (count - 1) / 2);
}

PhiloxCounter words_of_element(int element, std::uint64_t seed) {
  return philox({static_cast<std::uint32_t>(element), 0, 0, static_cast<std::uint32_t>(RandomPurpose::kArrayElements)},
                philox_key(seed));
}

int drawn_dead(const ArraySettings& settings) {
  return static_cast<int>(std::lround(settings.dead_share * settings.elements));
}

// Which elements are dead: the listed ones, and among the others the drawn_dead() with the smallest random words.
std::vector<bool> find_dead(const ArraySettings& settings, std::uint64_t seed) {
  std::vector<bool> dead(settings.elements, false);
  for (const int element : settings.dead_elements) {
    dead[element] = true;
  }
  std::vector<std::pair<std::uint32_t, int>> living;
  for (int n = 0; n < settings.elements; ++n) {
    if (!dead[n]) {
      living.emplace_back(words_of_element(n, seed)[2], n);
    }
  }
  std::sort(living.begin(), living.end());
  for (int i = 0; i < drawn_dead(settings); ++i) {
    dead[living[i].second] = true;
  }
  return dead;
}

// Complex gain of an element with faults: level [dB] and phase have independent normal errors (Box and Muller).
std::complex<double> drawn_gain(const ArraySettings& settings, const PhiloxCounter& words) {
  const double radius = std::sqrt(-2 * std::log(double{uniform_open(words[0])}));
  const double angle = 2 * pi * double{uniform_open(words[1])};
  const double level_db = settings.element_error_db * radius * std::cos(angle);
  return std::polar(std::pow(10, level_db / 20), settings.element_error * radius * std::sin(angle));
}

bool has_faults(const ArraySettings& settings) {
  return settings.element_error_db > 0 || settings.element_error > 0 || !settings.dead_elements.empty() ||
         drawn_dead(settings) > 0;
}

void check_line(std::string_view object, const ArraySettings& settings) {
  if (settings.window == ArrayWindow::kDolphChebyshev) {
    throw Error(object, "window", fmt::format(" = dolph_chebyshev needs {}.elements of at least 2", object));
  }
  if (settings.element_error_db > 0 || settings.element_error > 0 || !settings.dead_elements.empty() ||
      settings.dead_share > 0) {
    throw Error(object, "", fmt::format(" has faults of elements, which needs {}.elements of at least 2", object),
                {member_name(object, "elements")});
  }
}

void check_dead(std::string_view object, const ArraySettings& settings) {
  std::set<int> listed;
  for (std::size_t i = 0; i < settings.dead_elements.size(); ++i) {
    const int element = settings.dead_elements[i];
    if (element >= settings.elements) {
      throw Error(object, fmt::format("dead_elements[{}]", i),
                  fmt::format(" = {} must be less than {}.elements = {}", element, object, settings.elements));
    }
    listed.insert(element);
  }
  if (static_cast<int>(listed.size()) + drawn_dead(settings) >= settings.elements) {
    throw Error(object, "dead_elements",
                fmt::format(" and {}.dead_share leave none of {} elements", object, settings.elements));
  }
}

}  // namespace

void ArraySettings::validate(std::string_view object) const {
  check_fields(object, *this);
  if (nbar == 1) {
    throw Error(object, "nbar", " = 1 must be 0 (as side_lobe_db needs) or at least 2");
  }
  if (elements == 1) {
    throw Error(object, "elements", " = 1 must be 0 (a continuous line) or at least 2");
  }
  if (elements == 0) {
    check_line(object, *this);
  } else {
    check_dead(object, *this);
  }
}

double bearing_sine(BeamShape shape, double azimuth, double elevation) {
  return std::sin(azimuth) * (shape == BeamShape::kCone ? std::cos(elevation) : 1);
}

ArrayPattern::ArrayPattern(const ArraySettings& settings, std::uint64_t seed) : two_way_(settings.two_way) {
  settings.validate();
  if (settings.elements == 0) {
    line_ = line_weight(settings);
    const double peak = line_pattern(line_, 0);
    for (WindowCosine& part : line_) {
      part.share /= peak;
    }
    return;
  }
  weights_ = element_weights(settings);
  const double sum = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  for (double& weight : weights_) {
    weight /= sum;
  }
  if (has_faults(settings)) {
    draw_faults(settings, seed);
  }
}

void ArrayPattern::draw_faults(const ArraySettings& settings, std::uint64_t seed) {
  const std::vector<bool> dead = find_dead(settings, seed);
  for (int n = 0; n < settings.elements; ++n) {
    const std::complex<double> gain = dead[n] ? 0 : drawn_gain(settings, words_of_element(n, seed));
    real_.push_back(weights_[n] * gain.real());
    imaginary_.push_back(weights_[n] * gain.imag());
  }
}

double ArrayPattern::perfect_one_way(double x) const {
  if (weights_.empty()) {
    return line_pattern(line_, x);
  }
  return sum_elements(static_cast<int>(weights_.size()), x, [this](int n) { return weights_[n]; }).real();
}

double ArrayPattern::perfect_intensity(double x) const {
  const double one_way = perfect_one_way(x);
  return two_way_ ? one_way * one_way * one_way * one_way : one_way * one_way;
}

std::complex<double> ArrayPattern::focused_one_way(double x) const {
  if (imaginary_.empty()) {
    return perfect_one_way(x);
  }
  return sum_elements(static_cast<int>(real_.size()), x,
                      [this](int n) { return std::complex<double>(real_[n], imaginary_[n]); });
}

// Far side lobes are the waves from both ends of the array, which have the phase of the edge.
std::complex<double> ArrayPattern::defocused_one_way(double x) const {
  const auto count = static_cast<int>(defocused_.size());
  const bool is_line = weights_.empty();
  const double within = is_line ? x : x - count * std::round(x / count);  // The pattern of elements repeats.
  if (std::abs(within) > kExactReach + 4 * std::abs(edge_phase_)) {
    return focused_one_way(x) * std::polar(1.0, edge_phase_);
  }
  return is_line ? defocused_line_pattern(line_, x, edge_phase_) : sum_in_four(defocused_, x);
}

std::complex<double> ArrayPattern::amplitude(double x) const {
  const std::complex<double> one_way = defocused_.empty() ? focused_one_way(x) : defocused_one_way(x);
  return two_way_ ? one_way * one_way : one_way;
}

// Of a line, 2 x the integral of w(s) sin(2 pi x s) over s from 0 to 1/2.
double ArrayPattern::difference(double x) const {
  if (weights_.empty()) {
    double sum = 0;
    for (const WindowCosine& part : line_) {
      for (const double y : {x + part.turns, x - part.turns}) {
        sum += y == 0 ? 0 : part.share * (1 - std::cos(pi * y)) / (2 * pi * y);
      }
    }
    return sum;
  }
  const auto count = static_cast<int>(weights_.size());
  return sum_elements(count, x,
                      [&](int n) {
                        const int from_middle = count - 1 - 2 * n;  // Positive to port.
                        return from_middle == 0 ? 0 : std::copysign(weights_[n], -from_middle);
                      })
      .imag();
}

ArrayPattern ArrayPattern::defocused(double edge_phase) const {
  ArrayPattern pattern = *this;
  pattern.defocused_.clear();
  pattern.edge_phase_ = edge_phase;
  if (edge_phase == 0) {
    return pattern;
  }
  if (weights_.empty()) {
    pattern.defocused_.emplace_back(1.0);  // The line as one part: defocused_line_pattern() is in closed form.
  }
  const auto count = static_cast<int>(weights_.size());
  for (int n = 0; n < count; ++n) {
    const double place = (0.5 * (count - 1) - n) / count;  // s.
    const std::complex<double> weight =
        imaginary_.empty() ? weights_[n] : std::complex<double>(real_[n], imaginary_[n]);
    pattern.defocused_.push_back(weight * std::polar(1.0, 4 * edge_phase * place * place));
  }
  return pattern;
}

double ArrayPattern::width() const {
  return half_power_width([this](double x) { return perfect_intensity(x); }, 0.1);
}

ArrayPattern::Lobe ArrayPattern::highest_side_lobe() const {
  const double last = weights_.empty() ? 40 : std::min(40.0, static_cast<double>(weights_.size()) / 2);
  const double x = highest_side_lobe_at([this](double at) { return perfect_intensity(at); }, 0.01, last);
  return {x, x > 0 ? 10 * std::log10(perfect_intensity(x)) : -std::numeric_limits<double>::infinity()};
}

// One way, by Parseval's theorem, the integral of the squared pattern is that of the squared weights, a sum over
// elements. The two-way intensity is band-limited to two cycles per unit of x, so that samples closer than half a unit
// sum to its integral exactly.
double ArrayPattern::equivalent_beam() const {
  if (!two_way_) {
    return 1 / taper_efficiency();
  }
  constexpr double kStep = 0.25;
  constexpr double kLineEnd = 1000;  // The integral beyond is less than 1e-11 for a line.
  const double end = weights_.empty() ? kLineEnd : static_cast<double>(weights_.size()) / 2;
  double sum = 0.5 * (perfect_intensity(0) + perfect_intensity(end));
  for (int i = 1; i * kStep < end; ++i) {
    sum += perfect_intensity(i * kStep);
  }
  return 2 * kStep * sum;
}

double ArrayPattern::taper_efficiency() const {
  if (weights_.empty()) {
    return 1 / line_power(line_);
  }
  return 1 / (static_cast<double>(weights_.size()) *
              std::inner_product(weights_.begin(), weights_.end(), weights_.begin(), 0.0));
}

double ArrayPattern::length(double wavelength, double beam_width) const {
  const double width = half_power_width(
      [this](double x) {
        const double one_way = perfect_one_way(x);
        return one_way * one_way;
      },
      0.1);
  return width * wavelength / (2 * std::sin(beam_width / 2));
}

}  // namespace insonify
