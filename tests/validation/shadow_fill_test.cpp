// shadow_fill_test.cpp -- what fills shadows: the floor that a smooth post mirrors, and the side lobes of an array
// whose elements differ (docs/concepts/shadows.md).

#include "insonify/array_pattern.h"
#include "validation/secondary_grid.h"

namespace insonify::validation::shadow_fill_test {
namespace {

constexpr double kDepth = 3;                // Of the floor below the sonar [m].
constexpr double kMu = 0.03;                // Lambert's parameter of the floor.
constexpr double kAway = 6, kRadius = 0.3;  // The post's axis; its radius [m].
constexpr double kTop = -0.4;               // Of the post [m].
constexpr double kInterval = 0.5;           // Of range [m].

SonarConfig looking_down() {
  SonarConfig sonar;
  sonar.beam_count = 100;
  sonar.azimuth_aperture = 100 * kDegree;
  sonar.elevation_aperture = 26 * kDegree;
  sonar.elevation_center = -20 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 15;
  sonar.bin_count = 200;
  sonar.sampling = {24, 1200};
  return sonar;
}

// Energy by way of a smooth post that reflects all sound onto a floor, and straight back, in intervals of range: a sum
// over directions (a, e) of |R|^2 mu cos(out)/back^2 d Omega, where each is reflected by the circle that the post is
// seen from above. The reciprocal path has as much. What the sonar hears of it lies within the aperture; a convex post
// hides nothing of the floor that it reflects sound to.
std::vector<double> by_post(const SonarConfig& sonar) {
  constexpr int kAcross = 1000, kUp = 2000;
  std::vector<double> sums(static_cast<std::size_t>(sonar.max_range / kInterval), 0.0);
  const double widest = std::asin(kRadius / kAway), lowest = sonar.elevation_center - 0.5 * sonar.elevation_aperture;
  const double step_a = 2 * widest / kAcross, step_e = sonar.elevation_aperture / kUp;
  for (int i = 0; i < kAcross; ++i) {
    const double a = (i + 0.5) * step_a - widest, off = kAway * std::sin(a);
    const double flat = kAway * std::cos(a) - std::sqrt(kRadius * kRadius - off * off);  // From above, to the post.
    for (int k = 0; k < kUp; ++k) {
      const double e = lowest + (k + 0.5) * step_e;
      const double there = kDepth / -std::sin(e);
      const double onward = there * std::cos(e) - flat;  // From above, from the post to the floor.
      if (onward < 0 || flat * std::tan(e) > kTop) {
        continue;
      }
      const double x = flat * std::cos(a), y = flat * std::sin(a);
      const double nx = (x - kAway) / kRadius, ny = y / kRadius;
      const double into = std::cos(a) * nx + std::sin(a) * ny;
      const double fx = x + onward * (std::cos(a) - 2 * into * nx), fy = y + onward * (std::sin(a) - 2 * into * ny);
      const double back = std::hypot(fx, fy, kDepth);
      if (std::abs(std::atan2(fy, fx)) > 0.5 * sonar.azimuth_aperture ||
          std::abs(-std::asin(kDepth / back) - sonar.elevation_center) > 0.5 * sonar.elevation_aperture) {
        continue;
      }
      const auto interval = static_cast<std::size_t>(0.5 * (there + back) / kInterval);
      if (interval < sums.size()) {
        sums[interval] += 2 * kMu * kDepth / (back * back * back) * std::cos(e) * step_a * step_e;
      }
    }
  }
  return sums;
}

class ShadowFillTest : public testing::TestWithParam<Method> {};

// The post is as bright as the floor that it mirrors, at ranges at which its shadow lies.
TEST_P(ShadowFillTest, SmoothPostShowsTheFloorInItsShadow) {
  const SonarConfig sonar = looking_down();
  const Scene post = scene_of(make_cylinder(kRadius, kDepth + kTop, 0.02), glinting(1, 0.005),
                              {.position = {kAway, 0, 0.5 * (kTop - kDepth)}});
  const Scene scene = scene_of_all({seabed_at(-kDepth, diffuse(10 * std::log10(kMu))), post});
  const EchoGrid grid = secondary_grid(GetParam(), scene, sonar, {}, {.max_surfaces = 2});
  const std::vector<double> expected = by_post(sonar);
  std::vector<double> sums(expected.size(), 0.0);
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    for (int bin = 0; bin < sonar.bin_count; ++bin) {
      sums[static_cast<std::size_t>(sonar.bin_range(bin) / kInterval)] += grid.energy(2, beam)[bin];
    }
  }
  double sum = 0, expected_sum = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sum += sums[i];
    expected_sum += expected[i];
    if (expected[i] > 0.02 * *std::ranges::max_element(expected)) {
      EXPECT_NEAR(10 * std::log10(sums[i] / expected[i]), 0, 1) << i * kInterval << " m";  // Footprints blur intervals.
    }
  }
  EXPECT_NEAR(10 * std::log10(sum / expected_sum), 0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Methods, ShadowFillTest, testing::Values(kRays, kRaster),
                         [](const auto& test) { return test.param.name; });

// A plate 3 m away hides 36.9 degrees of a floor whose echo, per radian of azimuth, is the same everywhere. Elements
// with errors of s nepers (rms) and p radians receive e^(s^2 + p^2) - 1 of what reaches them without focus: relative to
// the floor, whose extent in u = sin(azimuth) is du/cos(azimuth), the shadow holds (e^(s^2 + p^2) - 1) cos(azimuth) D/N
// times the angle of the lit floor, with an array of D wavelengths and N elements.
TEST(ElementErrorTest, DifferentElementsFillShadows) {
  constexpr double kDb = 1.5, kPhase = 8 * kDegree, kBeside = 26 * kDegree;
  constexpr int kElements = 180, kSeeds = 6;
  SonarConfig sonar;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.azimuth_resolution = 1 * kDegree;
  sonar.elevation_aperture = 30 * kDegree;
  sonar.min_range = 9;
  sonar.max_range = 11;
  sonar.bin_count = 20;
  sonar.sampling = {4, 600};
  Scenario scenario = calibrated(sonar, kRays);
  scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
  scenario.receiver.elements = kElements;
  const Scene scene = scene_of_all({plate_at(3, 2, diffuse(-20)), seabed_at(-1, diffuse(-20))});
  const auto shadow = [&] {
    const std::vector<double> energy = [&] {
      const Ping ping = ping_of(scenario, scene);
      std::vector<double> beams(ping.beam_count, 0.0);
      for (std::size_t i = 0; i < ping.intensity.size(); ++i) {
        beams[i % ping.beam_count] += double{ping.intensity[i]};
      }
      return beams;
    }();
    double dark = 0, lit = 0;
    int dark_beams = 0, lit_beams = 0;
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      const double azimuth = std::abs(sonar.beam_azimuth(beam));
      dark += azimuth < 12 * kDegree ? energy[beam] : 0;
      dark_beams += azimuth < 12 * kDegree ? 1 : 0;
      lit += std::abs(azimuth - kBeside) < 3 * kDegree ? energy[beam] : 0;
      lit_beams += std::abs(azimuth - kBeside) < 3 * kDegree ? 1 : 0;
    }
    return dark / dark_beams / (lit / lit_beams);
  };
  const double perfect = shadow();
  EXPECT_LT(perfect, 0.002);
  scenario.receiver.element_error_db = kDb;
  scenario.receiver.element_error = kPhase;
  double mean = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    scenario.seed = seed;
    mean += shadow() / kSeeds;
  }
  const double length = ArrayPattern({.window = ArrayWindow::kTaylor, .elements = kElements}).length(1, 1 * kDegree);
  const double nepers = kDb * std::log(10.0) / 20;
  const double lit = (120 - 2 * 18.435) * kDegree;
  const double errors = std::exp(nepers * nepers + kPhase * kPhase) - 1;
  const double filled = errors * std::cos(kBeside) * length / kElements * lit;
  EXPECT_NEAR(mean, perfect + filled / (1 + filled), 0.1 * filled);
}

}  // namespace
}  // namespace insonify::validation::shadow_fill_test
