// oculus_image.cpp -- the image of a simple ping result: gains of rows, and pixels.

#include <algorithm>
#include <cmath>
#include <limits>

#include "insonify/wire/oculus_sonar.h"
#include "wire/little_endian.h"

namespace insonify {
namespace {

double ratio_of(double decibels) {
  return std::pow(10, decibels / 10);
}

// Amplitude of an intensity before the gain of its row, 1 at full scale.
class Amplitude {
 public:
  explicit Amplitude(const MessageLevels& levels)
      : is_square_(levels.decibels), scale_(static_cast<float>(ratio_of(-levels.high_db))) {}

  float operator()(float intensity) const {
    const float share = std::max(0.0F, intensity * scale_);
    return is_square_ ? std::sqrt(share) : share;
  }

 private:
  bool is_square_;
  float scale_;
};

double range_gain_db(const MessageLevels& levels, double range) {
  return levels.gain_per_decade * std::log10(range);
}

// The gain that brings the brightest pixels, without the plan's gain, to half of the full amplitude [dB].
double assisting_gain_db(const OculusPlan& plan, const Ping& ping, const MessageLevels& levels) {
  constexpr std::size_t kStride = 7;  // Prime to usual numbers of beams: it meets all of them.
  const Amplitude amplitude(levels);
  std::vector<float> samples;
  samples.reserve(ping.intensity.size() / kStride + 1);
  for (std::size_t i = 0; i < ping.intensity.size(); i += kStride) {
    const auto bin = static_cast<int>(i / static_cast<std::size_t>(ping.beam_count));
    const double gain = ratio_of(range_gain_db(levels, (plan.blank_rows + bin + 0.5) * plan.row_length) / 2);
    samples.push_back(amplitude(ping.intensity[i]) * static_cast<float>(gain));
  }
  const auto rank = static_cast<std::ptrdiff_t>((1 - kOculusAssistShare) * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), samples.begin() + rank, samples.end());
  const double bright = samples[static_cast<std::size_t>(rank)];
  return bright > 0 ? std::clamp(20 * std::log10(0.5 / bright), -kOculusAssistSpan, kOculusAssistSpan)
                    : kOculusAssistSpan;
}

std::uint32_t gain_word(double gain_db) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  return static_cast<std::uint32_t>(std::clamp(std::round(kOculusGainUnit * ratio_of(gain_db)), 1.0, kMost));
}

template <typename Pixel>
void add_pixels(std::vector<std::uint8_t>& image, const Ping& ping, int bin, const Amplitude& amplitude, double gain,
                double exponent) {
  // Of 32 bits the largest float below 2^32.
  constexpr float kMost =
      sizeof(Pixel) < sizeof(float) ? static_cast<float>(std::numeric_limits<Pixel>::max()) : 4294967040.0F;
  const auto factor = static_cast<float>(std::sqrt(gain));
  const auto power = static_cast<float>(exponent);
  for (int beam = 0; beam < ping.beam_count; ++beam) {
    const float share = std::min(1.0F, factor * amplitude(ping.intensity[ping.index(bin, beam)]));
    put(image, static_cast<Pixel>(std::lround(kMost * std::pow(share, power))));
  }
}

}  // namespace

std::vector<std::uint8_t> oculus_image(const OculusPlan& plan, const Ping* ping, const MessageLevels& levels,
                                       int beams) {
  const std::size_t pixel_size = plan.fire.wide() ? 4 : plan.fire.has(kOculus16Bits) ? 2 : 1;
  const std::size_t row_size = static_cast<std::size_t>(beams) * pixel_size;
  const double exponent = (plan.fire.gamma == 0 ? 255 : plan.fire.gamma) / 255.0;
  const Amplitude amplitude(levels);
  double gain_db = plan.gain_db;
  if (ping != nullptr && plan.fire.has(kOculusGainAssist)) {
    gain_db += assisting_gain_db(plan, *ping, levels);
  }

  std::vector<std::uint8_t> image;
  image.reserve(static_cast<std::size_t>(plan.rows) * (row_size + sizeof(std::uint32_t)));
  for (int row = 0; row < plan.rows; ++row) {
    // Pixels have the gain of the word, rounding included.
    const std::uint32_t word = gain_word(gain_db + range_gain_db(levels, (row + 0.5) * plan.row_length));
    if (plan.fire.has(kOculusGainSent)) {
      put(image, word);
    }
    if (ping == nullptr || row < plan.blank_rows) {
      image.resize(image.size() + row_size);
    } else if (pixel_size == 4) {
      add_pixels<std::uint32_t>(image, *ping, row - plan.blank_rows, amplitude, word / kOculusGainUnit, exponent);
    } else if (pixel_size == 2) {
      add_pixels<std::uint16_t>(image, *ping, row - plan.blank_rows, amplitude, word / kOculusGainUnit, exponent);
    } else {
      add_pixels<std::uint8_t>(image, *ping, row - plan.blank_rows, amplitude, word / kOculusGainUnit, exponent);
    }
  }
  return image;
}

}  // namespace insonify
