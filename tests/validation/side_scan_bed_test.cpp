// side_scan_bed_test.cpp -- what a side-scan sonar receives from a textured bed and from the sea's surface: contrast of
// ripples along and across, a coherent sum over scatterers (levels and statistics of speckle), the surface return.

#include <complex>
#include <numeric>
#include <random>

#include "insonify/mesh.h"
#include "insonify/relief.h"
#include "validation/calibrated_scene.h"
#include "validation/decibels.h"
#include "validation/pi.h"

namespace insonify::validation::side_scan_bed_test {
namespace {

constexpr double kAltitude = 6.1;

SonarConfig side_scan() {
  SonarConfig sonar;
  sonar.type = SonarType::kSideScan;
  sonar.frequency = 455e3;
  sonar.beam_count = 2;
  sonar.azimuth_aperture = 0.6 * kDegree;
  sonar.elevation_aperture = 50 * kDegree;
  sonar.depression = 28 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 30;
  sonar.bin_count = 600;
  sonar.sampling = {4, 2048};
  return sonar;
}

Ping ping_at(const Scenario& scenario, const Scene& scene, const Pose& pose) {
  PingRequest request;
  request.world_from_vehicle = pose;
  return Simulator(scenario, scene, 2).ping(0, request);
}

constexpr double kLength = 1.3, kHeight = 0.04;  // Ripples: wavelength, and crest above mean [m].
constexpr int kSteps = 40, kRipples = 60;        // Columns of a ripple in the mesh; ripples.

Scene rippled_mesh() {
  HeightGrid grid{
      .columns = kRipples * kSteps + 1, .rows = 2, .spacing_x = kLength / kSteps, .spacing_y = 80, .heights = {}};
  for (int i = 0; i < 2 * grid.columns; ++i) {
    grid.heights.push_back(static_cast<float>(kHeight * std::cos(2 * kPi * (i % grid.columns) / kSteps)));
  }
  return scene_of(make_height_field(grid), diffuse(-22), {.position = {0, 0, -kAltitude}});
}

Scene rippled_relief() {
  Tile<float> heights{kSteps, 1, {}};
  for (int i = 0; i < kSteps; ++i) {
    heights.texels.push_back(static_cast<float>(kHeight * std::cos(2 * kPi * (i + 0.5) / kSteps)));
  }
  Relief relief;
  relief.slopes = slopes_of_heights(heights);
  relief.rise_per_tile = true;
  relief.tile_size = kLength;
  Scene scene =
      scene_of(make_plane(Vec3::UnitZ(), kRipples * kLength, 80), diffuse(-22), {.position = {0, 0, -kAltitude}});
  scene.instances[0].reliefs = {std::make_shared<const Relief>(relief)};
  return scene;
}

// Ratio of standard deviation and mean of the echo over its trend, the mean over a wavelength, from 13 to 21 m.
double contrast(const Scene& scene, double heading) {
  const Ping ping = ping_at(calibrated(side_scan(), kRays), scene,
                            {.position = {0.4, 0.3, 0}, .orientation = orientation_from_rpy(0, 0, heading)});
  const int half = static_cast<int>(kLength / 0.05 / 2);
  double sum = 0, squares = 0, count = 0;
  for (int bin = 260; bin < 420; ++bin) {
    double trend = 0;
    for (int near = bin - half; near < bin + half; ++near) {
      trend += double{ping.intensity[ping.index(near, 1)]} / (2 * half);
    }
    const double value = double{ping.intensity[ping.index(bin, 1)]} / trend;
    sum += value;
    squares += value * value;
    ++count;
  }
  return std::sqrt(squares / count - sum * sum / count / count) / (sum / count);
}

// Crests are along y. Flying along them the sonar looks across.
TEST(SideScanRippleTest, HaveContrastAcrossAndNoneAlongAsADisplacedMeshHas) {
  const double across = contrast(rippled_mesh(), 90 * kDegree), along = contrast(rippled_mesh(), 0);
  EXPECT_GT(across, 0.4);
  EXPECT_LT(along, 0.06);
  EXPECT_NEAR(contrast(rippled_relief(), 90 * kDegree) / across, 1, 0.1);
  EXPECT_LT(contrast(rippled_relief(), 0), 0.06);
  const double oblique = contrast(rippled_mesh(), 50 * kDegree);
  EXPECT_NEAR(contrast(rippled_relief(), 50 * kDegree) / oblique, 1, 0.12);
  EXPECT_LT(oblique, across);
}

// Side lobes of a fan of 20 degrees reach up to 90 degrees off its axis, 62 above horizontal, where the surface is 3.9
// m / sin 62 degrees = 4.42 m away; nothing comes before.
TEST(SideScanSurfaceTest, IsReceivedByTheLobesThatLookUp) {
  SonarConfig sonar = side_scan();
  sonar.elevation_pattern = BeamPattern::kRectangular;
  sonar.elevation_aperture = 20 * kDegree;
  Scenario scenario = calibrated(sonar, kRays);
  scenario.surface = SeaSurface{.level = 3.9, .wind_speed = 6};
  const Ping ping = ping_at(scenario, seabed_at(-kAltitude, diffuse(-22)), {});
  for (const int side : {0, 1}) {
    for (int bin = 0; bin < 88; ++bin) {
      EXPECT_EQ(ping.intensity[ping.index(bin, side)], 0) << bin;
    }
    EXPECT_GT(std::accumulate(&ping.intensity[ping.index(88, 0)], &ping.intensity[ping.index(95, 0)], 0.0F), 0);
  }
}

// A patch of bed as point scatterers, summed frequency by frequency (Coiras, Mignotte, Petillot, Bell and Lebart, IET
// Radar, Sonar and Navigation 3(1), 2009, compare side-scan images in this way): exact phases, the patterns of lines
// across and along, no model of range bins or of speckle.
class CoherentBed {
 public:
  static constexpr double kNear = 16, kFar = 18;  // Slant ranges that are compared [m].
  static constexpr double kBand = 30e3, kSpeed = 1500;
  static constexpr int kTones = 192;

  explicit CoherentBed(unsigned seed) : random_(seed) {
    const double near = std::sqrt(sq(kNear - 0.4) - sq(kAltitude)), far = std::sqrt(sq(kFar + 0.4) - sq(kAltitude));
    const double reach = 0.55;  // Three beam widths to either side.
    const double area = (far - near) * 2 * reach;
    const int count = static_cast<int>(area * 4000);
    std::uniform_real_distribution<double> along(-reach, reach), ground(near, far);
    std::normal_distribution<double> normal(0, std::sqrt(0.5));
    for (int i = 0; i < count; ++i) {
      const Vec3 place(along(random_), ground(random_), -kAltitude);
      const double r = place.norm(), sine = kAltitude / r;
      const double strength = linear(-22) * sine * sine * area / count;
      const double gains = beam(place.x() / r) * beam(place.x() / r) * across(place, r) * across(place, r);
      add(r, std::sqrt(strength) * gains / (r * r) * std::complex<double>(normal(random_), normal(random_)));
    }
  }

  // Intensity at a range: the tones of the band in phase.
  [[nodiscard]] double intensity(double range) const {
    std::complex<double> sum = 0;
    for (int tone = 0; tone < kTones; ++tone) {
      sum += tones_[tone] * std::polar(1.0, 2 * wavenumber(tone) * (range - kNear));
    }
    return std::norm(sum) / sq(kTones);
  }

 private:
  static double sq(double x) { return x * x; }
  static double sinc(double x) { return std::abs(x) < 1e-9 ? 1 : std::sin(kPi * x) / (kPi * x); }
  static double wavenumber(int tone) { return 2 * kPi * (455e3 + kBand * ((tone + 0.5) / kTones - 0.5)) / kSpeed; }
  static double beam(double sine) { return sinc(0.8858929413781328 / (2 * std::sin(0.3 * kDegree)) * sine); }
  static double across(const Vec3& place, double /*r*/) {
    const double below = std::atan2(-place.z(), place.y());
    return sinc(0.8858929413781328 / (2 * std::sin(25 * kDegree)) * std::sin(below - 28 * kDegree));
  }

  void add(double range, std::complex<double> amplitude) {
    // exp(-2 i k r) for evenly spaced k, by recurrence.
    std::complex<double> turn = std::polar(1.0, -2 * wavenumber(0) * (range - kNear));
    const std::complex<double> step = std::polar(1.0, -2 * (wavenumber(1) - wavenumber(0)) * (range - kNear));
    for (int tone = 0; tone < kTones; ++tone) {
      tones_[tone] += amplitude * turn;
      turn *= step;
    }
  }

  std::mt19937_64 random_;
  std::vector<std::complex<double>> tones_ = std::vector<std::complex<double>>(kTones);
};

double ks_distance(std::vector<double> a, std::vector<double> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  double most = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    a[i] < b[j] ? ++i : ++j;
    most = std::max(most, std::abs(static_cast<double>(i) / a.size() - static_cast<double>(j) / b.size()));
  }
  return most;
}

TEST(SideScanCoherentTest, LevelsAndSpeckleAreThoseOfASumOverScatterers) {
  SonarConfig sonar = side_scan();
  sonar.elevation_pattern = BeamPattern::kRectangular;
  sonar.pulse = PulseKind::kLfm;
  sonar.pulse_duration = 1e-3;
  sonar.pulse_bandwidth = CoherentBed::kBand;
  sonar.assumed_sound_speed = CoherentBed::kSpeed;
  sonar.max_range = 21;
  sonar.bin_count = 2100;  // 10 mm; the pulse resolves 25 mm.
  Scenario scenario = calibrated(sonar, kRays);
  scenario.water.sound_speed = CoherentBed::kSpeed;
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  const Scene bed = seabed_at(-kAltitude, diffuse(-22));
  const Ping mean = ping_at(scenario, bed, {});
  scenario.receiver.speckle = true;
  Simulator simulator(scenario, bed, 2);

  // Every fifth bin, two resolutions apart; pings half a metre apart, three beams.
  std::vector<double> summed, simulated;
  double summed_level = 0, mean_level = 0, simulated_level = 0;
  for (unsigned round = 0; round < 24; ++round) {
    const CoherentBed coherent(round);
    PingRequest request;
    request.world_from_vehicle.position = {0.5 * round, 0, 0};
    const Ping ping = simulator.ping(0, request);
    for (int bin = 1600; bin < 1800; bin += 5) {
      const double expected = double{mean.intensity[mean.index(bin, 0)]};
      summed.push_back(coherent.intensity(sonar.bin_range(bin)) / expected);
      simulated.push_back(double{ping.intensity[ping.index(bin, 0)]} / expected);
      summed_level += summed.back();
      simulated_level += simulated.back();
      mean_level += 1;
    }
  }
  EXPECT_NEAR(db(summed_level / mean_level), 0, 0.6);  // 960 samples: one standard deviation is 0.14 dB.
  EXPECT_NEAR(db(simulated_level / mean_level), 0, 0.6);
  for (double& value : summed) {
    value *= mean_level / summed_level;
  }
  for (double& value : simulated) {
    value *= mean_level / simulated_level;
  }
  const double n = summed.size();
  EXPECT_LT(ks_distance(summed, simulated), 1.63 * std::sqrt(2 / n));  // 1 %.
}

}  // namespace
}  // namespace insonify::validation::side_scan_bed_test
