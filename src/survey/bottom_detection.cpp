// bottom_detection.cpp -- follows the bottom from beam to beam, and measures its range in each.

#include "insonify/survey/bottom_detection.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "insonify/error.h"
#include "insonify/field.h"
#include "receiver/array/line_array.h"
#include "receiver/ping_table.h"
#include "survey/beam_echo.h"

namespace insonify {
namespace {

constexpr double kLeastCosine = 0.08;   // Beams within some 5 degrees of the horizontal, or above it, see no bottom.
constexpr float kLeastContrast = 10;    // Of a peak, re the median of the beam's smoothed intensities.
constexpr float kLeastBesides = 1e-3F;  // Of a peak, re the beams before: less is the side lobes' of other beams.
constexpr double kLeastDepth = 0.6, kGreatestDepth = 1.7;  // From a beam to the next ones, re the depth before.
constexpr double kBeyondRing = 1.06;  // Beams whose bottom is so far beyond the echo straight below have it apart.
constexpr std::size_t kBefore = 5;    // Beams whose median depth is that before.

// A ping as rows of beams: copied once, since detection reads along range.
struct Rows {
  explicit Rows(const Ping& ping) : bins(ping.bin_count), intensity(ping.intensity.size()), phase(ping.phase.size()) {
    const auto transpose = [&](const std::vector<float>& from, std::vector<float>& to) {
      for (int bin = 0; bin < ping.bin_count && !from.empty(); ++bin) {
        for (int beam = 0; beam < ping.beam_count; ++beam) {
          to[static_cast<std::size_t>(beam) * bins + bin] = from[ping.index(bin, beam)];
        }
      }
    };
    transpose(ping.intensity, intensity);
    transpose(ping.phase, phase);
  }

  [[nodiscard]] std::span<const float> of(const std::vector<float>& table, int beam) const {
    return table.empty() ? std::span<const float>()
                         : std::span(table).subspan(static_cast<std::size_t>(beam) * bins, bins);
  }

  std::size_t bins;
  std::vector<float> intensity, phase;
};

void smooth(std::span<const float> row, int length, std::vector<float>& smoothed) {
  const int bins = static_cast<int>(row.size()), half = length / 2;
  smoothed.resize(row.size());
  double sum = 0;
  for (int i = 0; i < std::min(half, bins); ++i) {
    sum += row[i];
  }
  for (int i = 0; i < bins; ++i) {
    sum += i + half < bins ? row[i + half] : 0;
    sum -= i - half > 0 ? row[i - half - 1] : 0;
    smoothed[i] = static_cast<float>(std::max(0.0, sum) / length);
  }
}

float median_of(std::span<const float> values, std::vector<float>& scratch) {
  scratch.assign(values.begin(), values.end());
  const auto middle = scratch.begin() + static_cast<std::ptrdiff_t>(scratch.size() / 2);
  std::nth_element(scratch.begin(), middle, scratch.end());
  return *middle;
}

// Median of the values of the beams found last.
class Latest {
 public:
  void add(double value) {
    values_.push_back(value);
    if (values_.size() > kBefore) {
      values_.erase(values_.begin());
    }
  }
  [[nodiscard]] double median() const {  // 0 without any.
    if (values_.empty()) {
      return 0;
    }
    std::vector<double> sorted = values_;
    std::ranges::sort(sorted);
    return sorted[sorted.size() / 2];
  }

 private:
  std::vector<double> values_;
};

// What was found in the beams before.
struct Before {
  Latest depths;  // Below the sonar [m].
  Latest levels;  // Beam values.
};

// Cosines of the angles between beams and straight down.
std::vector<double> cosines_of(const BearingGrid& beams, const Pose& world_from_sonar) {
  const Vec3 down = world_from_sonar.orientation.conjugate() * -Vec3::UnitZ();
  std::vector<double> cosines;
  for (const double azimuth : beams.centres) {
    cosines.push_back(std::cos(azimuth) * down.x() + std::sin(azimuth) * down.y());
  }
  return cosines;
}

}  // namespace

BottomDetector::BottomDetector(const SonarConfig& sonar, const BottomDetectionOptions& options)
    : sonar_(sonar), beams_(sonar.bearings()) {
  constexpr double kFarthest = 1e5;
  if (!sonar.is_multibeam()) {
    throw Error(sonar.name + " is not a multibeam (type: mbes), which soundings need");
  }
  check_field("", {"least_range", "m", from_to(0, kFarthest), ""}, options.least_range);
  check_field("", {"greatest_range", "m", above_to(options.least_range, kFarthest), ""}, options.greatest_range);
  check_field("", {"resolution", "m", from_to(0, kFarthest), ""}, options.resolution);
  const auto bin_of = [&](double range) {
    return static_cast<int>(std::clamp((range - sonar.min_range) / sonar.bin_length(), 0.0, 1.0 * sonar.bin_count));
  };
  const double nearest = std::max({options.least_range, sonar.dead_range, sonar.blanking_range});
  first_bin_ = bin_of(nearest);
  last_bin_ = std::max(first_bin_, bin_of(options.greatest_range));
  constexpr int kLeastSmooth = 3;
  const int bins = static_cast<int>(std::ceil(options.resolution / sonar.bin_length() - 1e-6));
  resolution_ = std::max(1, bins);
  smooth_ = std::max(kLeastSmooth, bins) | 1;
}

std::vector<Sounding> BottomDetector::detect(const Ping& ping) const {
  std::vector<Sounding> soundings;
  detect(ping, soundings);
  return soundings;
}

// Writes what was found in a beam.
void BottomDetector::set(Sounding& sounding, std::span<const float> intensity, const BeamEcho& echo) const {
  const double range = range_of(echo.range.place);
  const double deviation = echo.range.deviation * sonar_.bin_length();
  double sum = 0;
  for (int bin = echo.snippet.begin; bin < echo.snippet.end; ++bin) {
    sum += intensity[bin];
  }
  sounding.detection = echo.by_phase ? Detection::kPhase : Detection::kAmplitude;
  sounding.range = static_cast<float>(range);
  sounding.uncertainty = static_cast<float>(deviation);
  sounding.quality = static_cast<float>(std::max(0.0, std::log10(range / deviation)));
  sounding.snippet_begin = echo.snippet.begin;
  sounding.snippet_end = echo.snippet.end;
  sounding.intensity = static_cast<float>(sum / (echo.snippet.end - echo.snippet.begin));
}

// Bins that the footprint of a beam takes up on a level bottom.
int BottomDetector::footprint(int beam, double depth, double cosine) const {
  const double width = beam_width(sonar_) / std::max(kLeastCosine, std::cos(beams_.centres[beam]));
  const double length = depth / (cosine * cosine) * std::sqrt(1 - std::min(1.0, cosine * cosine)) * width;
  return static_cast<int>(std::min(length / sonar_.bin_length(), 0.25 * sonar_.bin_count));
}

// Bins that are searched in a beam: around the depth before, or all.
Snippet BottomDetector::gate(double depth, double cosine) const {
  if (!(depth > 0)) {
    return {first_bin_, last_bin_};
  }
  const auto bin_of = [&](double range) {
    const double bin = (range - sonar_.min_range) / sonar_.bin_length();
    return static_cast<int>(std::clamp(bin, 1.0 * first_bin_, 1.0 * last_bin_));
  };
  return {bin_of(kLeastDepth * depth / cosine), bin_of(kGreatestDepth * depth / cosine)};
}

// Whether an echo goes on where the bins end, so that its middle is not known. Bin 0 is at the sonar itself.
bool BottomDetector::is_cut(const Snippet& snippet) const {
  return snippet.end >= last_bin_ || (snippet.begin <= first_bin_ && first_bin_ > 0);
}

void BottomDetector::detect(const Ping& ping, std::vector<Sounding>& soundings) const {
  check_ping(ping, sonar_);
  soundings.assign(static_cast<std::size_t>(ping.beam_count), Sounding());
  const Rows rows(ping);
  std::vector<float> smoothed, scratch;
  const std::vector<double> cosines = cosines_of(beams_, ping.world_from_sonar);
  for (int beam = 0; beam < ping.beam_count; ++beam) {
    soundings[beam].azimuth = static_cast<float>(beams_.centres[beam]);
  }
  Snippet ring;
  const auto detect_beam = [&](int beam, Before& before) {
    if (cosines[beam] < kLeastCosine || first_bin_ == last_bin_) {
      return;
    }
    const double depth = before.depths.median();
    const std::span<const float> intensity = rows.of(rows.intensity, beam);
    // Averages over a part of the footprint, and bridges fades: speckle must not tear an echo apart.
    const int footprint = this->footprint(beam, depth, cosines[beam]);
    smooth(intensity, std::max(smooth_, footprint / 4) | 1, smoothed);
    const float median = median_of(std::span(smoothed).subspan(first_bin_, last_bin_ - first_bin_), scratch);
    const BeamRow row{intensity, smoothed, rows.of(rows.phase, beam), resolution_, footprint / 2};
    const Snippet gate = this->gate(depth, cosines[beam]);
    const bool to_port = beams_.centres[beam] > 0;
    const float least = std::max(kLeastContrast * median, kLeastBesides * static_cast<float>(before.levels.median()));
    std::optional<BeamEcho> echo = find_echo(row, gate, least, to_port);
    if (echo && echo->snippet.begin < ring.end && depth / cosines[beam] > kBeyondRing * range_of(ring.end)) {
      const auto beyond = find_echo(row, {std::max(gate.begin, ring.end), gate.end}, least, to_port);
      echo = beyond ? beyond : echo;
    }
    if (echo && !is_cut(echo->snippet)) {
      set(soundings[beam], intensity, *echo);
      before.depths.add(double{soundings[beam].range} * cosines[beam]);
      before.levels.add(double{soundings[beam].intensity});
      if (depth == 0) {
        ring = {echo->snippet.begin, echo->snippet.end + smooth_};
      }
    }
  };

  const int middle = static_cast<int>(std::ranges::max_element(cosines) - cosines.begin());
  Before below;
  detect_beam(middle, below);
  Before to_port = below, to_starboard = below;
  for (int beam = middle - 1; beam >= 0; --beam) {
    detect_beam(beam, to_port);
  }
  for (int beam = middle + 1; beam < ping.beam_count; ++beam) {
    detect_beam(beam, to_starboard);
  }
}

Vec3 position_of(const Sounding& sounding, const Pose& world_from_sonar, double range_scale) {
  const double range = range_scale * double{sounding.range}, azimuth = double{sounding.azimuth};
  return world_from_sonar * Vec3(range * std::cos(azimuth), range * std::sin(azimuth), 0);
}

Vec3 position_of(const Sounding& sounding, const Pose& world_from_sonar, const SoundSpeedProfile& profile,
                 double surface_level, double shown_speed) {
  const double azimuth = double{sounding.azimuth};
  const Vec3 launch = world_from_sonar.orientation * Vec3(std::cos(azimuth), std::sin(azimuth), 0);
  const double across = launch.head<2>().norm(), depth = surface_level - world_from_sonar.position.z();
  const RayPoint at = profile.after_time(depth, std::atan2(-launch.z(), across), double{sounding.range} / shown_speed);
  const double ahead = across > 0 ? at.distance / across : 0;
  return {world_from_sonar.position.x() + ahead * launch.x(), world_from_sonar.position.y() + ahead * launch.y(),
          surface_level - at.depth};
}

}  // namespace insonify
