// speckle_motion_test.cpp -- how the speckle of a flat bed changes as the sonar moves, against the integral over the
// bed's scatterers; and with objects that move.

#include <complex>
#include <numbers>
#include <optional>

#include "validation/calibrated_scene.h"

namespace insonify::validation::speckle_motion_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kBeams = 16;  // Over 7.5 degrees, each of 1 degree.
constexpr double kSpacing = 7.5 / kBeams * kDegree;
constexpr double kCell = kSpacing / 2;    // Bearing cells are half a beam spacing.
constexpr double kHeard = 5.3 * kDegree;  // Of the fan, with the guard cells beside it, on either side of the axis.

struct Setting {
  PulseKind pulse;
  double duration, bandwidth;  // [s], [Hz]
  double bin;                  // [m]
  double first;                // Range of the first bin [m].
  int bins;
  double elevation, aperture;  // [deg]
  int rows;
  int places;  // Of the sonar, whose pings are compared.
};
constexpr double kHeight = 3;  // Of the sonar above the bed [m].

// A tone of 50 us in fine bins; bins alone; a tone and a chirp of two bins; and near the sonar, where the bed is steep.
constexpr Setting kFine{PulseKind::kCw, 50e-6, 1e3, 0.005, 18, 1600, -9, 8, 400, 18};
constexpr Setting kBins{PulseKind::kNone, 50e-6, 1e3, 0.026, 14, 500, -12, 20, 200, 16};
constexpr Setting kTone{PulseKind::kCw, 100e-6, 1e3, 0.026, 14, 500, -12, 20, 200, 24};
constexpr Setting kChirp{PulseKind::kLfm, 2e-3, 15e3, 0.026, 14, 500, -12, 20, 200, 16};
constexpr Setting kNear{PulseKind::kCw, 100e-6, 1e3, 0.026, 6, 200, -24, 20, 200, 80};

struct Motion {
  Vec3 step;
  double yaw;
};

// Correlation of two series of intensities, from sums over several places of the sonar.
struct Sums {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void add(double x, double y) { n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y; }
  void add(const Sums& other, double sign) {
    n += sign * other.n, a += sign * other.a, b += sign * other.b;
    aa += sign * other.aa, bb += sign * other.bb, ab += sign * other.ab;
  }
  [[nodiscard]] double correlation() const { return (n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b)); }
};

class SpeckleMotionTest : public testing::Test {
 protected:
  void set(const Setting& setting) {
    setting_ = setting;
    SonarConfig sonar;
    sonar.beam_count = kBeams;
    sonar.azimuth_aperture = kBeams * kSpacing;
    sonar.azimuth_resolution = 1 * kDegree;
    sonar.elevation_center = setting.elevation * kDegree;
    sonar.elevation_aperture = setting.aperture * kDegree;
    sonar.min_range = setting.first;
    sonar.max_range = setting.first + setting.bins * setting.bin;
    sonar.bin_count = setting.bins;
    sonar.sampling = {4, setting.rows};
    scenario_ = calibrated(sonar, kRays);
    scenario_.receiver.azimuth_pattern = BeamPattern::kRectangular;
    scenario_.receiver.pulse = setting.pulse;
    scenario_.receiver.pulse_duration = setting.duration;
    scenario_.receiver.pulse_bandwidth = setting.bandwidth;
    sound_speed_ = scenario_.water.true_sound_speed();
    wavelength_ = sound_speed_ / sonar.frequency;
    length_ = 0.8858929413781328 * wavelength_ / (2 * std::sin(0.5 * kDegree));
    mean_ = mean_at(kHeight);
    scenario_.receiver.speckle = true;
    simulator_.emplace(scenario_, seabed_at(-kHeight, diffuse(-20)), 2);
  }

  std::vector<float> mean_at(double height) const {
    Scenario even = scenario_;
    even.receiver.speckle = false;
    return ping_of(even, seabed_at(-height, diffuse(-20))).intensity;
  }

  // Intensity over mean intensity.
  std::vector<float> speckle_at(const Vec3& position, double yaw, const std::vector<float>& mean) {
    std::vector<float> received =
        simulator_
            ->ping(0, {.world_from_vehicle = {.position = position, .orientation = orientation_from_rpy(0, 0, yaw)}})
            .intensity;
    for (std::size_t i = 0; i < received.size(); ++i) {
      received[i] = mean[i] > 0 ? received[i] / mean[i] : 0;
    }
    return received;
  }

  // Places of the sonar before it moves, at no round coordinates.
  static Vec3 place(int number) { return {1.373 * number + 0.113, 0.4137 * number + 0.071, 0}; }

  double pulse(double away) const {
    const double x = std::abs(away);
    if (setting_.pulse == PulseKind::kNone) {
      return x < setting_.bin / 2 ? 1 : 0;
    }
    if (setting_.pulse == PulseKind::kCw) {
      return std::max(0.0, 1 - 2 * x / (sound_speed_ * setting_.duration));
    }
    const double phase = 2 * kPi * setting_.bandwidth * x / sound_speed_;
    return phase < 1e-9 ? 1 : std::sin(phase) / phase;
  }
  double reach() const {
    return setting_.pulse == PulseKind::kNone ? setting_.bin
           : setting_.pulse == PulseKind::kCw ? sound_speed_ * setting_.duration / 2
                                              : 12 * sound_speed_ / (2 * setting_.bandwidth);  // All but 1 % of sinc^2.
  }
  double pattern(double sine) const {
    const double x = kPi * length_ * sine / wavelength_;
    return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x;
  }

  // Correlation of the intensities of a beam at `azimuth`, at range `first` before and `second` after a motion: the
  // squared magnitude of that of the fields. Scatterers are uncorrelated and lie on the bed, at (r, a) before; each
  // contributes its pattern and pulse before and after, and the phase of twice the difference of its ranges.
  double theory(double first, double second, double azimuth, const Motion& motion) const {
    std::complex<double> common = 0;
    double before = 0, after = 0;
    const double wavenumber = 2 * kPi / wavelength_;
    constexpr int kAcross = 400;
    const int along = setting_.pulse == PulseKind::kLfm ? 200 : 80;
    for (int i = 0; i < kAcross; ++i) {
      const double a = kHeard * (2 * (i + 0.5) / kAcross - 1);
      for (int j = 0; j < along; ++j) {
        const double r = first + 1.1 * reach() * (2 * (j + 0.5) / along - 1);
        const double level = std::sqrt(r * r - kHeight * kHeight);
        const double x = level * std::cos(a) - motion.step.x(), y = level * std::sin(a) - motion.step.y();
        const double later = std::hypot(x, y, kHeight + motion.step.z()), bearing = std::atan2(y, x) - motion.yaw;
        const double one = pattern(std::sin(a) - std::sin(azimuth)) * pulse(r - first);
        const double other = pattern(std::sin(bearing) - std::sin(azimuth)) * pulse(later - second);
        common += one * other * std::polar(1.0, 2 * wavenumber * (r - later));
        before += one * one, after += other * other;
      }
    }
    return after > 0 ? std::norm(common) / (before * after) : 0;
  }

  // Compares the two beams next to the axis, over all ranges and from several places. The standard error of the
  // correlation is that of the jackknife over places; four of them are allowed, and `model` beside.
  void expect_theory(const Motion& motion, double model) {
    constexpr int kMargin = 20;
    const int places = setting_.places;
    const std::vector<float> mean_later = motion.step.z() == 0 ? mean_ : mean_at(kHeight + motion.step.z());
    std::vector<Sums> sums(places);
    Sums all;
    double expected = 0, terms = 0;
    for (int number = 0; number < places; ++number) {
      const std::vector<float> first = speckle_at(place(number), 0, mean_);
      const std::vector<float> later = speckle_at(place(number) + motion.step, motion.yaw, mean_later);
      for (const int beam : {kBeams / 2 - 1, kBeams / 2}) {
        const double azimuth = (kBeams / 2 - 0.5 - beam) * kSpacing;
        for (int bin = kMargin; bin < setting_.bins - kMargin; ++bin) {
          const double range = setting_.first + (bin + 0.5) * setting_.bin;
          const double level = std::sqrt(range * range - kHeight * kHeight);
          const double moved_to = std::hypot(level * std::cos(azimuth) - motion.step.x(),
                                             level * std::sin(azimuth) - motion.step.y(), kHeight + motion.step.z());
          const int moved = static_cast<int>(std::floor((moved_to - setting_.first) / setting_.bin));
          if (moved < kMargin || moved >= setting_.bins - kMargin) {
            continue;
          }
          sums[number].add(double{first[bin * kBeams + beam]}, double{later[moved * kBeams + beam]});
          if (number == 0 && bin % (setting_.bins / 12) == 0) {
            expected += theory(range, setting_.first + (moved + 0.5) * setting_.bin, azimuth, motion);
            terms += 1;
          }
        }
      }
      all.add(sums[number], 1);
    }
    double variance = 0;
    for (const Sums& one : sums) {
      Sums others = all;
      others.add(one, -1);
      variance += std::pow(others.correlation() - all.correlation(), 2) * (places - 1) / places;
    }
    EXPECT_NEAR(all.correlation(), expected / terms, 4 * std::sqrt(variance) + model)
        << "moved by " << motion.step.transpose() << " m, turned by " << motion.yaw / kDegree << " degrees, bins of "
        << setting_.bin << " m";
    EXPECT_LT(std::sqrt(variance), 0.02) << "too few places";
  }

  Setting setting_;
  Scenario scenario_;
  double sound_speed_, wavelength_, length_;
  std::optional<Simulator> simulator_;
  std::vector<float> mean_;
};

// What the model leaves out: a beam is sampled by its cells, a pulse by its bins (docs/concepts/speckle.md, Limits).
constexpr double kSampling = 0.015;
// Bins without a pulse divide the bed into halves of a bin. After a shift by x < 1/2 bins they have both halves in
// common in a share 1 - 2x of bins, one in the others: the mean squared overlap is 1 - 3x/2, and (1 - x)^2 for even
// scatterers. They differ by at most 1/16; so do those for x > 1/2, (1 - x)/2.
constexpr double kHalfBins = 1.0 / 16;

// The example is the third: 22 m off, straight ahead, after 0.9 m.
TEST_F(SpeckleMotionTest, AheadItFollowsTheIntegralOverTheBed) {
  set(kFine);
  for (const double step : {0.1, 0.31, 0.9, 1.7}) {
    expect_theory({{step, 0, 0}, 0}, kSampling);
  }
  set(kChirp);
  for (const double step : {0.26, 0.9}) {
    expect_theory({{step, 0, 0}, 0}, kSampling);
  }
  set(kNear);
  for (const double step : {0.052, 0.31, 1.2}) {
    expect_theory({{step, 0, 0}, 0}, kSampling);
  }
}

TEST_F(SpeckleMotionTest, SidewaysAndUpItFollowsTheIntegralOverTheBed) {
  set(kFine);
  expect_theory({{0, 0.1 * length_, 0}, 0}, kSampling);
  expect_theory({{0, -0.25 * length_, 0}, 0}, kSampling);
  expect_theory({{0, 2.42 * length_, 0}, 0}, kSampling);  // Where the phases of neighbouring cells turn once.
  expect_theory({{0, 0, 0.1}, 0}, kSampling);
  expect_theory({{0, 0, 0.5}, 0}, kSampling);
  set(kTone);
  expect_theory({{0, 0, 0.12}, 0}, kSampling);
  expect_theory({{0.3, -0.1 * length_, 0.21}, 0}, kSampling);
  set(kNear);
  expect_theory({{0, 0.1 * length_, 0}, 0}, kSampling);
  expect_theory({{0, 0, 0.1}, 0}, kSampling);
}

// By whole bearing cells; other angles are rounded to them.
TEST_F(SpeckleMotionTest, TurningByCellsItFollowsTheIntegralOverTheBed) {
  set(kTone);
  expect_theory({{0, 0, 0}, kCell}, kSampling);
  expect_theory({{0, 0, 0}, -2 * kCell}, kSampling);
  expect_theory({{0.2, 0, 0.05}, kCell}, kSampling);
}

TEST_F(SpeckleMotionTest, WithoutAPulseBinsHaveInCommonWhatTheyOverlap) {
  set(kBins);
  for (const double step : {0.0065, 0.013, 0.02, 0.1, 0.9}) {
    expect_theory({{step, 0, 0}, 0}, kHalfBins);
  }
  expect_theory({{0, 0, 0.1}, 0}, kHalfBins);
}

// With a pulse too, the mean is that without speckle and intensities are exponentially distributed.
TEST_F(SpeckleMotionTest, MeanAndContrastDoNotDependOnThePulse) {
  for (const Setting& setting : {kFine, kBins, kTone, kChirp, kNear}) {
    set(setting);
    constexpr int kPlaces = 24;
    std::vector<double> means, squares;
    for (int number = 0; number < kPlaces; ++number) {
      const std::vector<float> speckle = speckle_at(place(number), 0, mean_);
      double n = 0, sum = 0, square = 0;
      for (int bin = 10; bin < setting_.bins - 10; ++bin) {
        for (int beam = 0; beam < kBeams; ++beam) {
          const double value = double{speckle[bin * kBeams + beam]};
          n += 1, sum += value, square += value * value;
        }
      }
      means.push_back(sum / n), squares.push_back(square / n);
    }
    const auto mean_and_error = [](const std::vector<double>& values) {
      double mean = 0, variance = 0;
      for (const double value : values) {
        mean += value / kPlaces;
      }
      for (const double value : values) {
        variance += std::pow(value - mean, 2) / (kPlaces - 1);
      }
      return std::pair(mean, std::sqrt(variance / kPlaces));
    };
    const auto [mean, error] = mean_and_error(means);
    EXPECT_NEAR(mean, 1, 4 * error) << setting.bin;
    const auto [square, square_error] = mean_and_error(squares);
    EXPECT_NEAR(square, 2, 4 * square_error + 4 * error) << setting.bin;
    EXPECT_LT(square_error, 0.05);
  }
}

// From one ping to the next, a bin further on, no place on the way has the picture redrawn.
TEST_F(SpeckleMotionTest, HasNoPlaceWhereTheWholePictureChanges) {
  set(kTone);
  double least = 1;
  for (int ping = 1; ping < 100; ++ping) {
    const Vec3 here(ping * 0.27, 0, 0);
    const std::vector<float> before = speckle_at(here, 0, mean_);
    const std::vector<float> after = speckle_at(here + Vec3(kTone.bin, 0, 0), 0, mean_);
    Sums sums;
    for (int bin = 21; bin < kTone.bins - 20; ++bin) {
      for (int beam = 0; beam < kBeams; ++beam) {
        sums.add(double{before[bin * kBeams + beam]}, double{after[(bin - 1) * kBeams + beam]});
      }
    }
    least = std::min(least, sums.correlation());
  }
  EXPECT_GT(least, 0.9);
}

// A bed that moves and turns under a sonar at rest has the speckle that a bed at rest has for a sonar that does the
// opposite.
TEST_F(SpeckleMotionTest, ObjectsCarryTheirSpeckleWithThem) {
  set(kTone);
  const Scene bed = seabed_at(-kHeight, diffuse(-20));
  const MovableObject movable{.name = bed.instances[0].name};
  Simulator moving(scenario_, bed, 2, {&movable, 1});
  const Pose home = bed.instances[0].world_from_mesh;
  for (const auto& [shift, yaw] : {std::pair{Vec3(-0.9, 0, 0), 0.0}, {Vec3(0.4, -2.3, 0), 0.0}, {Vec3(1, 3, 0), 0.7}}) {
    const Pose there{.position = home.position + shift, .orientation = orientation_from_rpy(0, 0, yaw)};
    const std::vector<float> carried =
        moving.ping(0, {.moved = {{.name = movable.name, .world_from_object = there}}}).intensity;
    const std::vector<float> sailed = moving.ping(0, {.world_from_vehicle = home * there.inverse()}).intensity;
    const std::vector<float> rest = moving.ping(0, {}).intensity;
    double difference = 0, change = 0, sum = 0;
    for (std::size_t i = 0; i < carried.size(); ++i) {
      difference += std::abs(carried[i] - sailed[i]), change += std::abs(carried[i] - rest[i]), sum += sailed[i];
    }
    // Single precision puts a few scatterers into neighbouring bins.
    EXPECT_LT(difference, 0.02 * sum) << shift.transpose();
    EXPECT_GT(change, 0.5 * sum) << shift.transpose();
  }
}

// Around an object that moves, the bed keeps its speckle; the object's own is not that of the place it has come to.
TEST_F(SpeckleMotionTest, WhatDoesNotMoveKeepsItsSpeckle) {
  set(kTone);
  Scene scene = scene_of_all({seabed_at(-kHeight, diffuse(-20)), plate_at(20, 1, diffuse(-10))});
  scene.instances[0].name = "bed", scene.instances[1].name = "plate";
  const MovableObject movable{.name = "plate"};
  Simulator moving(scenario_, scene, 2, {&movable, 1});
  const auto ping_with = [&](double x) {
    Pose pose = scene.instances[1].world_from_mesh;
    pose.position.x() = x;
    return moving.ping(0, {.moved = {{.name = "plate", .world_from_object = pose}}});
  };
  const Ping first = ping_with(20), later = ping_with(20.052), back = ping_with(20);
  EXPECT_EQ(first.intensity, back.intensity);
  int same = 0;
  for (int bin = 0; bin < 190; ++bin) {  // Up to 19 m.
    same += first.intensity[bin * kBeams + 7] == later.intensity[bin * kBeams + 7] ? 1 : 0;
  }
  EXPECT_EQ(same, 190);
}

}  // namespace
}  // namespace insonify::validation::speckle_motion_test
