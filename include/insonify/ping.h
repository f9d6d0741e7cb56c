// ping.h -- one ping: the received intensities of one transmission, and their ground truth.

#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/ground_truth.h"

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

  // Where the receiver is asked for them, else empty.
  std::vector<std::complex<float>> field;  ///< What intensity is the squared magnitude of; phase re the carrier.
  std::vector<std::uint16_t> counts;       ///< As the instrument delivers them, see SonarConfig::bits.

  // Ground truth, from the same deposit; docs/concepts/ground-truth.md. Empty with GroundTruth::kNone.
  std::vector<std::uint16_t>
      instance;  ///< Index into Scene::instances of the strongest; kNoLabel where nothing echoed.
  std::vector<std::uint16_t> material;  ///< Index into Scene::materials of the same.
  std::vector<float> elevation;  ///< Mean elevation of the same in the sonar frame [rad]; NaN where nothing echoed.

  // Filled in with GroundTruth::kFull only, of what falls into each beam's own slice of azimuth. The first two hold
  // kStrongestCount values a bin, the strongest first: value k of a cell is at [kStrongestCount * index(bin, beam) +
  // k].
  std::vector<std::uint16_t> strongest_instance;  ///< Indices into Scene::instances; kNoLabel beyond the last.
  std::vector<float> strongest_share;    ///< What each gave of the energy of the bin's echoes, 0..1; 0 beyond the last.
  std::vector<float> elevation_spread;   ///< Standard deviation of the strongest's elevations [rad]; NaN where none.
  std::vector<std::uint8_t> path_order;  ///< Surfaces met by the paths that gave most, 1..kPathOrders; 0 where none.
  std::vector<float> shadow;             ///< For bins without a direct echo: the share of the beam that nearer surfaces
                                         ///< hide, 0..1; of others 0.
  std::vector<float> direct_intensity;   ///< What paths with one surface give, noise and speckle left out.

  [[nodiscard]] std::size_t index(int bin, int beam) const { return static_cast<std::size_t>(bin) * beam_count + beam; }
};

}  // namespace insonify
