// paper_receiver.cpp -- means, noise, gain and near field of the `paper` model.

#include "receiver/paper_receiver.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/philox.h"

namespace insonify {
namespace {

constexpr int kBeamsPerTask = 16;  // One cache line of a row of the ping.
constexpr int kBinsPerBlock = 64;

using Block = Eigen::Array<float, kBinsPerBlock, 1>;

// Two independent standard normal numbers for each bin of a block. One Philox call serves two neighbouring bins.
struct NormalPairs {
  Block first, second;
};

NormalPairs draw_normals(int beam, int first_bin, std::uint64_t ping, std::uint64_t seed) {
  std::array<std::uint32_t, kBinsPerBlock> word1, word2;
  for (int i = 0; i < kBinsPerBlock / 2; ++i) {
    const PhiloxCounter words =
        philox({static_cast<std::uint32_t>(first_bin / 2 + i), static_cast<std::uint32_t>(beam),
                static_cast<std::uint32_t>(ping),
                static_cast<std::uint32_t>(RandomPurpose::kPaperNoise) ^ static_cast<std::uint32_t>(ping >> 32) << 8},
               philox_key(seed));
    word1[2 * i] = words[0];
    word2[2 * i] = words[1];
    word1[2 * i + 1] = words[2];
    word2[2 * i + 1] = words[3];
  }
  // Box and Muller (1958).
  Block radius, angle;
  for (int i = 0; i < kBinsPerBlock; ++i) {
    radius[i] = uniform_open(word1[i]);
    angle[i] = 2 * std::numbers::pi_v<float> * uniform_open(word2[i]);
  }
  radius = (-2 * radius.log()).sqrt();
  return {radius * angle.cos(), radius * angle.sin()};
}

// How much of an echo is heard at the range of a bin: 0 at min_range, rising in a straight line to 1 at blanking_range.
float near_field(const SonarConfig& sonar, int bin) {
  if (sonar.blanking_range <= sonar.min_range) {
    return 1;
  }
  const double along = (sonar.bin_range(bin) - sonar.min_range) / (sonar.blanking_range - sonar.min_range);
  return static_cast<float>(std::clamp(along, 0.0, 1.0));
}

float mean_over(float energy, float weight) {
  return weight > 0 ? energy / weight : 0.0F;
}

}  // namespace

void receive_paper(const EchoGrid& grid, const SonarConfig& sonar, const PaperReceiverSettings& settings,
                   Workers& workers, Ping& ping) {
  const int beams = grid.beam_count();
  const int bins = grid.bin_count();
  ping.beam_count = beams;
  ping.bin_count = bins;
  const std::size_t cells = static_cast<std::size_t>(beams) * bins;
  ping.intensity.resize(cells);
  ping.instance.resize(cells);
  ping.material.resize(cells);
  ping.elevation.resize(cells);

  const auto spread = static_cast<float>(settings.model.multiplicative_deviation);
  const auto mean = static_cast<float>(settings.model.multiplicative_mean);
  const auto floor = static_cast<float>(settings.model.additive_deviation);
  const auto gain = static_cast<float>(sonar.gain);
  workers.for_each((beams + kBeamsPerTask - 1) / kBeamsPerTask, [&](int task, int) {
    const int first_beam = task * kBeamsPerTask;
    const int last_beam = std::min(first_beam + kBeamsPerTask, beams);
    for (int first_bin = 0; first_bin < bins; first_bin += kBinsPerBlock) {
      const int count = std::min(kBinsPerBlock, bins - first_bin);
      for (int beam = first_beam; beam < last_beam; ++beam) {
        NormalPairs noise;
        if (settings.noise) {
          noise = draw_normals(beam, first_bin, ping.number, settings.seed);
        }
        const auto labels = grid.labels(beam);
        for (int i = 0; i < count; ++i) {
          const int bin = first_bin + i;
          float value = 0;
          for (int order = 1; order <= grid.order_count(); ++order) {
            value += mean_over(grid.energy(order, beam)[bin], grid.weight(order, beam)[bin]);
          }
          value = std::min(value, 1.0F);
          if (settings.noise) {
            value = value * (mean + spread * noise.first[i]) + floor * noise.second[i];
          }
          const std::size_t cell = ping.index(bin, beam);
          ping.intensity[cell] = std::clamp(value * gain * near_field(sonar, bin), 0.0F, 1.0F);
          const EchoGrid::Label& label = labels[bin];
          ping.instance[cell] = label.instance;
          ping.material[cell] = label.material;
          ping.elevation[cell] =
              label.instance == kNoLabel ? std::numeric_limits<float>::quiet_NaN() : label.elevation();
        }
      }
    }
  });
}

}  // namespace insonify
