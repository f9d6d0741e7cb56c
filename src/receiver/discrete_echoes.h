// discrete_echoes.h -- adds discrete echoes to beams and bins with their exact bearing: array gain times pulse.

#pragma once

#include <complex>
#include <span>

#include "echo/grid/echo_grid.h"
#include "receiver/array/bearing_response.h"
#include "receiver/array/split_array.h"
#include "receiver/pulse/range_response.h"

namespace insonify {

/// Adds each discrete echo (an ideal point or an interfering pulse) to all beams, with the array's gain g at the echo's
/// own bearing, and to the bins around its own, with the pulse's amplitude p. Without an array it is added to its own
/// beam only, without a pulse to its own bin only. Another sonar's pulse has the array's gain one way, and no p.
class DiscreteEchoes {
 public:
  static constexpr double kFloorDb = BearingResponse::kFloorDb;

  /// @param bearing, range  Array pattern and pulse; null for none. Must outlive this object.
  /// @param share           Factor on the intensity of echoes: CoarseBins::discrete(). Does not apply to other sonars'
  ///                        pulses.
  DiscreteEchoes(const BearingResponse* bearing, const RangeResponse* range, int beams, int bins, float share = 1)
      : bearing_(bearing), range_(range), beams_(beams), bins_(bins), share_(share) {}

  /// Adds |g p|^2 x intensity to energies, or g p x field to complex fields.
  /// @param beams  [beam][bin], added to.
  void add(std::span<const DiscreteEcho> echoes, std::span<float> beams) const;
  void add(std::span<const DiscreteEcho> echoes, std::span<std::complex<float>> beams) const;

  /// Adds d p x field to the differences between the halves of an array.
  void add_differences(std::span<const DiscreteEcho> echoes, const SplitArray& split,
                       std::span<std::complex<float>> differences) const;

  /// Adds only the direct echoes, those of path order 1.
  void add_direct(std::span<const DiscreteEcho> echoes, std::span<float> beams) const;

 private:
  void add_one(const DiscreteEcho& echo, std::span<float> beams) const;
  [[nodiscard]] std::complex<double> gain(const DiscreteEcho& echo, int beam) const;
  template <typename Gain, typename Add>
  void for_each_cell(const DiscreteEcho& echo, const Gain& gain, const Add& add) const;
  template <typename Gain>
  void add_fields(std::span<const DiscreteEcho> echoes, const Gain& gain, std::span<std::complex<float>> beams) const;

  const BearingResponse* bearing_;
  const RangeResponse* range_;
  [[nodiscard]] float intensity(const DiscreteEcho& echo) const {
    return echo.order > 0 ? share_ * echo.intensity : echo.intensity;
  }

  int beams_, bins_;
  float share_;
};

}  // namespace insonify
