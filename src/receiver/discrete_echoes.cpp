// discrete_echoes.cpp -- adds discrete echoes one at a time: a ping has few of them.

#include "receiver/discrete_echoes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {

// Calls add(index into [beam][bin], complex gain g p) for every beam and bin in which the echo's gain is above the
// floor. Another sonar's pulse is received one way, in its own bins: it is as long as it was sent, not compressed.
template <typename Add>
void DiscreteEchoes::for_each_cell(const DiscreteEcho& echo, const Add& add) const {
  const double floor = std::pow(10, kFloorDb / 10);
  const int first_beam = bearing_ != nullptr ? 0 : echo.beam;
  const int last_beam = bearing_ != nullptr ? beams_ : echo.beam + 1;
  const bool is_ours = echo.order > 0;
  const int reach = range_ != nullptr && is_ours ? range_->taps() / 2 : 0;
  const int first_bin = std::max(0, echo.bin - reach), last_bin = std::min(bins_, echo.bin + reach + 1);
  for (int beam = first_beam; beam < last_beam; ++beam) {
    const std::complex<double> gain = bearing_ == nullptr ? 1.0
                                      : is_ours           ? bearing_->gain(beam, echo.bearing_sine, echo.bin)
                                                          : bearing_->one_way_gain(beam, echo.bearing_sine, echo.bin);
    if (std::norm(gain) < floor) {
      continue;
    }
    for (int bin = first_bin; bin < last_bin; ++bin) {
      const float pulse = range_ != nullptr && is_ours ? range_->amplitude(bin - echo.bin) : 1.0F;
      add(static_cast<std::size_t>(beam) * bins_ + bin, std::complex<float>(gain) * pulse);
    }
  }
}

void DiscreteEchoes::add_one(const DiscreteEcho& echo, std::span<float> beams) const {
  for_each_cell(echo,
                [&](std::size_t cell, std::complex<float> gain) { beams[cell] += std::norm(gain) * intensity(echo); });
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
  for (const DiscreteEcho& echo : echoes) {
    const std::complex<float> field =
        std::polar(std::sqrt(intensity(echo)), 2 * std::numbers::pi_v<float> * echo.turns);
    for_each_cell(echo, [&](std::size_t cell, std::complex<float> gain) { beams[cell] += gain * field; });
  }
}

}  // namespace insonify
