// make_relief.cpp -- synthesizes ripples and roughness as periodic Gaussian random surfaces with a given spectrum.
//
// The method (waves of random phase and amplitude, summed by FFT) follows Bell, "Application of optical ray tracing
// techniques to the simulation of sonar images", Opt. Eng. 36 (1997), who makes isotropic and directional seabeds by
// filtering noise. The spectrum of roughness is the power law of APL-UW TR 9407, section IV, with its typical exponent
// as the default.

#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

#include "base/philox.h"
#include "base/vector_math.h"
#include "insonify/error.h"
#include "insonify/relief.h"

namespace insonify {
namespace {

constexpr int kTexels = 512;            // Texels along each side of the tile.
constexpr double kDefaultTile = 4;      // Side of the tile where neither size nor wavelength is given [m].
constexpr double kRipplesInATile = 24;  // Ripples along a side of the default tile.

// Relative widths (standard deviations) of the ripples' spectrum, along their wavevector and across it. They make
// crests some five wavelengths long.
constexpr double kBandAlong = 0.07, kBandAcross = 0.1;

using Complex = std::complex<float>;
using Waves = std::vector<Complex>;  // [row][column]: a spectrum over wavenumbers, or values over positions.

// Wavenumber of a column or row of a spectrum, in cycles per tile.
int cycles(int index) {
  return index < kTexels / 2 ? index : index - kTexels;
}

// Inverse two-dimensional Fourier transform: rows, then columns.
Waves sum_of(const Waves& spectrum) {
  Eigen::FFT<float> fft;
  fft.SetFlag(Eigen::FFT<float>::Unscaled);
  Waves places(spectrum.size());
  std::vector<Complex> line(kTexels), summed;
  for (int row = 0; row < kTexels; ++row) {
    std::copy_n(&spectrum[static_cast<std::size_t>(row) * kTexels], kTexels, line.begin());
    fft.inv(summed, line);
    std::copy_n(summed.begin(), kTexels, &places[static_cast<std::size_t>(row) * kTexels]);
  }
  for (int column = 0; column < kTexels; ++column) {
    for (int row = 0; row < kTexels; ++row) {
      line[row] = places[static_cast<std::size_t>(row) * kTexels + column];
    }
    fft.inv(summed, line);
    for (int row = 0; row < kTexels; ++row) {
      places[static_cast<std::size_t>(row) * kTexels + column] = summed[row];
    }
  }
  return places;
}

// A random spectrum.
struct RandomWaves {
  Waves waves;             // Complex amplitudes.
  double power = 0;        // Expected variance of heights, and ...
  double slope_power = 0;  // ... of slopes, with wavenumbers in cycles per tile.
};

// Draws a random spectrum with complex Gaussian amplitudes.
// @param power  Expected power at the wavenumber (x, y) [cycles per tile].
template <typename Power>
RandomWaves random_waves(std::uint64_t seed, std::uint32_t stream, const Power& power) {
  RandomWaves random{.waves = Waves(static_cast<std::size_t>(kTexels) * kTexels)};
  for (int row = 0; row < kTexels; ++row) {
    for (int column = 0; column < kTexels; ++column) {
      const int x = cycles(column), y = cycles(row);
      // At the Nyquist wavenumber the slope at the texels is zero; the mean height does not matter.
      if (x == -kTexels / 2 || y == -kTexels / 2 || (x == 0 && y == 0)) {
        continue;
      }
      const PhiloxCounter words = philox({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), stream,
                                          static_cast<std::uint32_t>(RandomPurpose::kRelief)},
                                         philox_key(seed));
      const double mean_power = power(x, y);
      const float radius = static_cast<float>(std::sqrt(mean_power)) * std::sqrt(-2 * fast_log(uniform_open(words[0])));
      const SineCosine angle = fast_sine_cosine(uniform_open(words[1]));
      random.waves[static_cast<std::size_t>(row) * kTexels + column] = {radius * angle.cosine, radius * angle.sine};
      random.power += mean_power;
      random.slope_power += mean_power * (x * x + y * y);
    }
  }
  return random;
}

double mean_square(const Waves& places) {
  double sum = 0;
  for (const Complex& place : places) {
    const auto value = static_cast<double>(place.real());
    sum += value * value;
  }
  return sum / static_cast<double>(places.size());
}

// Adds the slopes of a random surface whose expected rms height is `height` [m]. The slopes are scaled so that the
// realization has exactly the expected mean square slope, since scattering depends on slopes and not on heights.
void add_slopes(const RandomWaves& random, double height, double tile_size, Tile<Eigen::Vector2f>& slopes) {
  Waves along[2] = {Waves(random.waves.size()), Waves(random.waves.size())};
  for (std::size_t i = 0; i < random.waves.size(); ++i) {
    const int number[2] = {cycles(static_cast<int>(i % kTexels)), cycles(static_cast<int>(i / kTexels))};
    for (int axis = 0; axis < 2; ++axis) {
      along[axis][i] = random.waves[i] * Complex(0, static_cast<float>(number[axis]));
    }
  }
  const Waves right = sum_of(along[0]), up = sum_of(along[1]);
  const double wanted = 2 * std::numbers::pi / tile_size * height * std::sqrt(random.slope_power / random.power);
  const auto scale = static_cast<float>(wanted / std::sqrt(mean_square(right) + mean_square(up)));
  for (std::size_t i = 0; i < right.size(); ++i) {
    // Rows of a tile run from the top down.
    const std::size_t row = i / kTexels, column = i % kTexels;
    slopes.texels[(kTexels - 1 - row) * kTexels + column] += scale * Eigen::Vector2f(right[i].real(), up[i].real());
  }
}

RandomWaves ripples(const ReliefConfig& config, double tile_size) {
  const double number = tile_size / config.ripple_wavelength;  // Ripples along a side of the tile.
  const double cos_direction = std::cos(config.ripple_direction), sin_direction = std::sin(config.ripple_direction);
  return random_waves(config.relief_seed, 0, [&](int x, int y) {
    const double along = (x * cos_direction + y * sin_direction) / number - 1;
    const double across = (y * cos_direction - x * sin_direction) / number;
    return std::exp(-0.5 * (along * along / (kBandAlong * kBandAlong) + across * across / (kBandAcross * kBandAcross)));
  });
}

RandomWaves roughness(const ReliefConfig& config) {
  return random_waves(config.relief_seed, 1,
                      [&](int x, int y) { return std::pow(std::hypot(x, y), -config.roughness_exponent); });
}

double tile_size_of(const ReliefConfig& config) {
  if (config.tile_size > 0) {
    return config.tile_size;
  }
  return config.ripple_wavelength > 0 ? kRipplesInATile * config.ripple_wavelength : kDefaultTile;
}

}  // namespace

Relief make_relief(const ReliefConfig& config) {
  Relief relief;
  relief.tile_size = tile_size_of(config);
  relief.by_position = true;
  relief.slopes = {kTexels, kTexels,
                   std::vector<Eigen::Vector2f>(std::size_t{kTexels} * kTexels, Eigen::Vector2f::Zero())};
  if (config.ripple_wavelength > 0) {
    add_slopes(ripples(config, relief.tile_size), config.ripple_height / (2 * std::numbers::sqrt2), relief.tile_size,
               relief.slopes);
  }
  if (config.roughness_height > 0) {
    add_slopes(roughness(config), config.roughness_height, relief.tile_size, relief.slopes);
  }
  return relief;
}

}  // namespace insonify
