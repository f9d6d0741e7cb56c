// beam_cells.h -- adds echoes to the cells of one beam, four neighbouring bins at a time.

#pragma once

#include <algorithm>
#include <cstring>

#include "echo/echo.h"
#include "insonify/echo_grid.h"

namespace insonify {

/// Half the least length of a stretch [bins]: keeps its density finite.
inline constexpr float kShortestStretch = 5e-5F;

/// The cells of one beam and path order. Positions are in bins, from the near edge of bin 0.
class BeamCells {
 public:
  BeamCells(EchoGrid& grid, int order, int beam)
      : energy_(grid.energy(order, beam).data()),
        weight_(grid.weight(order, beam).data()),
        labels_(grid.label_rows(beam)),
        bins_(static_cast<float>(grid.bin_count())) {}

  /// Spreads a stretch of surface evenly over the positions from `low` to `high`, which differ; the power rises
  /// linearly from `power_low`. What lies outside the bins is dropped.
  /// @param rise     Change of power per bin.  @param density  Weight per bin.
  void add_stretch(float low, float high, float power_low, float rise, float density, SurfaceLabel surface,
                   float elevation) {
    const float end = std::min(high, bins_);
    if (!(high > 0 && low < bins_)) {
      return;
    }
    int bin = static_cast<int>(std::max(low, 0.0F));
    do {
      const Floats low_edge = static_cast<float>(bin) + Floats{0, 1, 2, 3};
      const Floats high_edge = low_edge + 1;
      const Floats from = low_edge > low ? low_edge : low + Floats{};
      const Floats to = high_edge < end ? high_edge : end + Floats{};
      const Floats length = to > from ? to - from : Floats{};
      add(bin, length * density, power_low + (0.5F * (from + to) - low) * rise, surface, elevation);
      bin += kLanes;
    } while (static_cast<float>(bin) < end);
  }

  /// Adds everything to the one bin that holds a position.
  void add_point(float position, float power, float weight, SurfaceLabel surface, float elevation) {
    if (position >= 0 && position < bins_) {
      add(static_cast<int>(position), Floats{weight, 0, 0, 0}, power + Floats{}, surface, elevation);
    }
  }

 private:
  static constexpr int kLanes = 4;
  static_assert(kLanes <= EchoGrid::kPadding);
  using Floats = float __attribute__((vector_size(16)));
  using Words = std::uint32_t __attribute__((vector_size(16)));

  template <typename Lanes, typename Value>
  static Lanes load(const Value* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
  }
  template <typename Lanes, typename Value>
  static void store(Value* to, Lanes lanes) {
    std::memcpy(to, &lanes, sizeof lanes);
  }

  // Weights and powers of four bins. The label is a majority vote weighted by energy (Boyer and Moore, 1981): whoever
  // holds more than half of a cell leads it in the end.
  void add(int bin, Floats weight, Floats power, SurfaceLabel surface, float elevation) {
    const Floats energy = weight * power;
    store(energy_ + bin, load<Floats>(energy_ + bin) + energy);
    store(weight_ + bin, load<Floats>(weight_ + bin) + weight);

    const Words labelled = load<Words>(labels_.surface + bin);
    const Floats lead = load<Floats>(labels_.lead + bin);
    const auto own = labelled == surface + Words{};
    const auto taken = ~own & ~(lead > energy) & (weight > 0);
    const Floats apart = lead > energy ? lead - energy : energy - lead;
    const Floats gained = (own | taken) ? energy : Floats{};
    const Floats kept_energy = taken ? Floats{} : load<Floats>(labels_.energy + bin);
    const Floats kept_moment = taken ? Floats{} : load<Floats>(labels_.elevation_moment + bin);
    store(labels_.surface + bin, taken ? surface + Words{} : labelled);
    store(labels_.lead + bin, own ? lead + energy : apart);
    store(labels_.energy + bin, kept_energy + gained);
    store(labels_.elevation_moment + bin, kept_moment + gained * elevation);
  }

  float* energy_;
  float* weight_;
  EchoGrid::LabelRows labels_;
  float bins_;
};

}  // namespace insonify
