// discrete_echoes.h -- echoes that no cell holds, on their way into beams and bins.

#pragma once

#include <complex>
#include <span>

#include "echo/grid/echo_grid.h"
#include "receiver/bearing_response.h"
#include "receiver/range_response.h"

namespace insonify {

/// What beams hear of discrete echoes: each in every beam by the array's gain at its own bearing, and in the bins about
/// its own by the pulse. Null for none of either: then in its own beam, its own bin.
class DiscreteEchoes {
 public:
  static constexpr double kFloorDb = BearingResponse::kFloorDb;

  DiscreteEchoes(const BearingResponse* bearing, const RangeResponse* range, int beams, int bins)
      : bearing_(bearing), range_(range), beams_(beams), bins_(bins) {}

  /// Adds |g p|^2 of their intensities, or g p of their fields.
  /// @param beams  [beam][bin]
  void add(std::span<const DiscreteEcho> echoes, std::span<float> beams) const;
  void add(std::span<const DiscreteEcho> echoes, std::span<std::complex<float>> beams) const;

  /// The same of direct echoes alone: of order 1.
  void add_direct(std::span<const DiscreteEcho> echoes, std::span<float> beams) const;

 private:
  void add_one(const DiscreteEcho& echo, std::span<float> beams) const;
  template <typename Add>
  void for_each_cell(const DiscreteEcho& echo, const Add& add) const;

  const BearingResponse* bearing_;
  const RangeResponse* range_;
  int beams_, bins_;
};

}  // namespace insonify
