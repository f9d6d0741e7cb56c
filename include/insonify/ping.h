// ping.h -- one ping: the received intensities of one transmission, and their ground truth.

#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/ground_truth.h"
#include "insonify/sounding.h"

namespace insonify {

/// One ping. Tables are bin-major: the value of bin i in beam j is at [i * beam_count + j], so that a row is one range.
struct Ping {
  std::uint64_t number = 0;  ///< From 0.
  double time = 0;           ///< Time of transmission [s].
  Pose world_from_sonar;     ///< Pose of the housing.
  double head_angle = 0;     ///< Angle of a scanning head in the housing, positive to port [rad]; else 0.

  int bin_count = 0;
  int beam_count = 0;
  std::vector<float> intensity;  ///< Echo intensity; 0..1 in the `paper` model.

  // If requested of the receiver, else empty.
  std::vector<std::complex<float>> field;  ///< Complex field: |field|^2 is the intensity; phase re the carrier.
  std::vector<std::uint16_t> counts;       ///< As the instrument delivers them, see SonarConfig::bits.

  // Of a multibeam (SonarType::kMultibeam), else empty.
  std::vector<float> phase;         ///< Phase between the halves of the receive array [rad], positive for echoes to
                                    ///< port of the beam's axis; with an azimuth_pattern in the calibrated model.
  std::vector<Sounding> soundings;  ///< [beam] The bottom.

  // Ground truth, from the same deposit; docs/concepts/ground-truth.md. Empty with GroundTruth::kNone.
  std::vector<std::uint16_t>
      instance;  ///< Index into Scene::instances of the strongest surface in the bin; kNoLabel: no echo.
  std::vector<std::uint16_t> material;  ///< Index into Scene::materials of its material.
  std::vector<float> elevation;         ///< Its mean elevation in the sonar frame [rad]; NaN: no echo.

  // Filled in with GroundTruth::kFull only, from echoes in each beam's own slice of azimuth. The first two hold
  // kStrongestCount values per bin, the strongest first: value k of a cell is at [kStrongestCount * index(bin, beam) +
  // k].
  std::vector<std::uint16_t> strongest_instance;  ///< Indices into Scene::instances; kNoLabel beyond the last.
  std::vector<float> strongest_share;    ///< Share of each in the energy of the bin's echoes, 0..1; 0 beyond the last.
  std::vector<float> elevation_spread;   ///< Standard deviation of the strongest's elevations [rad]; NaN: no echo.
  std::vector<std::uint8_t> path_order;  ///< Number of surfaces on the strongest paths, 1..kPathOrders; 0: no echo.
  std::vector<float> shadow;             ///< For bins without a direct echo: the share of the beam that nearer surfaces
                                         ///< hide, 0..1; of others 0.
  std::vector<float> direct_intensity;   ///< Intensity of paths with one surface, without noise and speckle.

  [[nodiscard]] std::size_t index(int bin, int beam) const { return static_cast<std::size_t>(bin) * beam_count + beam; }
};

}  // namespace insonify
