// discrete_echoes.cpp -- adds discrete echoes one at a time: a ping has few of them.

#include "receiver/discrete_echoes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {

// Another sonar's pulse is received one way.
std::complex<double> DiscreteEchoes::gain(const DiscreteEcho& echo, int beam) const {
  if (bearing_ == nullptr) {
    return 1.0;
  }
  return echo.order > 0 ? bearing_->gain(beam, echo.bearing_sine, echo.bin)
                        : bearing_->one_way_gain(beam, echo.bearing_sine, echo.bin);
}

// Calls add(index into [beam][bin], complex gain times p) for every beam and bin in which the gain of a beam is above
// the floor. Another sonar's pulse is received in its own bins: it is as long as it was sent, not compressed.
template <typename Gain, typename Add>
void DiscreteEchoes::for_each_cell(const DiscreteEcho& echo, const Gain& gain, const Add& add) const {
  const double floor = std::pow(10, kFloorDb / 10);
  const int first_beam = bearing_ != nullptr ? 0 : echo.beam;
  const int last_beam = bearing_ != nullptr ? beams_ : echo.beam + 1;
  const bool is_ours = echo.order > 0;
  const int reach = range_ != nullptr && is_ours ? range_->taps() / 2 : 0;
  const int first_bin = std::max(0, echo.bin - reach), last_bin = std::min(bins_, echo.bin + reach + 1);
  for (int beam = first_beam; beam < last_beam; ++beam) {
    const std::complex<double> of_beam = gain(echo, beam);
    if (std::norm(of_beam) < floor) {
      continue;
    }
    for (int bin = first_bin; bin < last_bin; ++bin) {
      const float pulse = range_ != nullptr && is_ours ? range_->amplitude(bin - echo.bin) : 1.0F;
      add(static_cast<std::size_t>(beam) * bins_ + bin, std::complex<float>(of_beam) * pulse);
    }
  }
}

void DiscreteEchoes::add_one(const DiscreteEcho& echo, std::span<float> beams) const {
  for_each_cell(
      echo, [&](const DiscreteEcho& from, int beam) { return gain(from, beam); },
      [&](std::size_t cell, std::complex<float> received) { beams[cell] += std::norm(received) * intensity(echo); });
}

void DiscreteEchoes::add(std::span<const DiscreteEcho> echoes, std::span<float> beams) const {
  for (const DiscreteEcho& echo : echoes) {
    add_one(echo, beams);
  }
}

void DiscreteEchoes::add_direct(std::span<const DiscreteEcho> echoes, std::span<float> beams) const {
  for (const DiscreteEcho& echo : echoes) {
    if (echo.order == 1) {
      add_one(echo, beams);
    }
  }
}

void DiscreteEchoes::add(std::span<const DiscreteEcho> echoes, std::span<std::complex<float>> beams) const {
  add_fields(
      echoes, [&](const DiscreteEcho& from, int beam) { return gain(from, beam); }, beams);
}

void DiscreteEchoes::add_differences(std::span<const DiscreteEcho> echoes, const SplitArray& split,
                                     std::span<std::complex<float>> differences) const {
  add_fields(
      echoes,
      [&](const DiscreteEcho& from, int beam) { return std::complex<double>(split.gain(beam, from.bearing_sine)); },
      differences);
}

template <typename Gain>
void DiscreteEchoes::add_fields(std::span<const DiscreteEcho> echoes, const Gain& gain,
                                std::span<std::complex<float>> beams) const {
  for (const DiscreteEcho& echo : echoes) {
    const std::complex<float> field =
        std::polar(std::sqrt(intensity(echo)), 2 * std::numbers::pi_v<float> * echo.turns);
    for_each_cell(echo, gain, [&](std::size_t cell, std::complex<float> received) { beams[cell] += received * field; });
  }
}

}  // namespace insonify
