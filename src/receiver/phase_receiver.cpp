// phase_receiver.cpp -- the phase between two halves, from their sum and their difference.

#include "receiver/phase_receiver.h"

#include <cmath>

namespace insonify {
namespace {

constexpr std::uint64_t kOtherSeed = 0xd1b54a32d192ed03;  // Noise of the difference is not that of the sum.

}  // namespace

PhaseReceiver::PhaseReceiver(std::shared_ptr<const SplitArray> split, int beams, int bins, bool speckle,
                             const NoiseField::Settings* noise)
    : split_(std::move(split)), bins_(bins) {
  const std::size_t size = static_cast<std::size_t>(beams) * static_cast<std::size_t>(bins);
  differences_.resize(speckle ? size : 0);
  real_.resize(speckle ? 0 : size);
  imaginary_.resize(real_.size());
  if (noise != nullptr && speckle) {
    NoiseField::Settings other = *noise;
    other.seed ^= kOtherSeed;
    noise_.emplace(other);
  }
}

void PhaseReceiver::form(std::span<const std::complex<float>> fields, std::span<const float> energies, BinRange bins) {
  if (differences_.empty()) {
    split_->receive_energy(energies, real_, imaginary_, bins_, bins);
  } else {
    split_->receive_field(fields, differences_, bins_, bins);
  }
}

void PhaseReceiver::add(const DiscreteEchoes& discrete, std::span<const DiscreteEcho> echoes) {
  if (!differences_.empty()) {
    discrete.add_differences(echoes, *split_, differences_);
  }
}

void PhaseReceiver::draw_noise(std::uint64_t ping, Workers& workers) {
  if (noise_) {
    noise_->draw(ping, workers);
  }
}

void PhaseReceiver::measure(const TilePlace& place, int beam, const float* real, const float* imaginary,
                            float deviation, Ping& ping) const {
  const std::size_t start = static_cast<std::size_t>(beam) * bins_ + place.first_bin;
  for (int i = 0; i < place.bin_count; ++i) {
    float of_real = 0, of_imaginary = 0;
    if (differences_.empty()) {
      of_real = real_[start + i];
      of_imaginary = imaginary_[start + i];
    } else {
      const int bin = place.first_bin + i;
      std::complex<float> d = differences_[start + i];
      if (noise_) {
        d += deviation * std::complex<float>(noise_->in_phase(beam)[bin], noise_->quadrature(beam)[bin]);
      }
      of_real = real[i] * real[i] + imaginary[i] * imaginary[i] - std::norm(d);
      of_imaginary = 2 * (real[i] * d.real() + imaginary[i] * d.imag());
    }
    ping.phase[ping.index(place.first_bin + i, beam)] = std::atan2(of_imaginary, of_real);
  }
}

}  // namespace insonify
