// gap_test.cpp -- sonars with gaps between their beams: what lies in a gap is not received, and the beams have the
// levels that they have without gaps.

#include "insonify/picture.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::gap_test {
namespace {

class GapTest : public testing::TestWithParam<Method> {};

// Two beams of 1 degree abeam, as the two sides of a side-scan sonar.
SonarConfig two_sides() {
  SonarConfig sonar;
  sonar.beam_count = 2;
  sonar.beam_azimuths = {90 * kDegree, -90 * kDegree};
  sonar.beam_widths = {1 * kDegree};
  sonar.azimuth_aperture = sonar.bearings().extent();
  sonar.elevation_aperture = 40 * kDegree;
  sonar.min_range = 4;
  sonar.max_range = 16;
  sonar.bin_count = 120;
  sonar.sampling = {8, 300};
  return sonar;
}

SonarConfig one_side(int beam) {
  SonarConfig sonar = two_sides();
  sonar.beam_count = 1;
  sonar.beam_azimuths = {sonar.beam_azimuths[static_cast<std::size_t>(beam)]};
  sonar.beam_widths.clear();
  sonar.azimuth_aperture = 1 * kDegree;
  return sonar;
}

// Sixteen beams of a degree, or those with an even index.
SonarConfig comb(bool with_gaps) {
  SonarConfig sonar;
  sonar.azimuth_resolution = 1.6 * kDegree;
  sonar.elevation_aperture = 30 * kDegree;
  sonar.elevation_center = -20 * kDegree;
  sonar.min_range = 4;
  sonar.max_range = 16;
  sonar.bin_count = 120;
  sonar.sampling = {8, 300};
  for (int beam = 0; beam < 16; beam += with_gaps ? 2 : 1) {
    sonar.beam_azimuths.push_back((7.5 - beam) * kDegree);
  }
  sonar.beam_count = static_cast<int>(sonar.beam_azimuths.size());
  if (with_gaps) {
    sonar.beam_widths = {1 * kDegree};
  }
  sonar.azimuth_aperture = sonar.bearings().extent();
  return sonar;
}

double sum_of_beam(const Ping& ping, int beam) {
  double sum = 0;
  for (int bin = 0; bin < ping.bin_count; ++bin) {
    sum += double{ping.intensity[ping.index(bin, beam)]};
  }
  return sum;
}

double db(double value) {
  return 10 * std::log10(value);
}

// Compares each beam of the comb with the same of the sonar without gaps, as levels over all bins.
void expect_same_levels(Scenario scenario, const Scene& scene, double tolerance_db) {
  const Ping whole = ping_of(scenario, scene);
  const SonarConfig with = scenario.sonars[0];
  scenario.sonars = {comb(true)};
  scenario.sonars[0].pulse = with.pulse;
  scenario.sonars[0].pulse_duration = with.pulse_duration;
  const Ping gapped = ping_of(scenario, scene);
  ASSERT_EQ(gapped.beam_count, 8);
  for (int beam = 0; beam < 8; ++beam) {
    EXPECT_NEAR(db(sum_of_beam(gapped, beam)), db(sum_of_beam(whole, 2 * beam)), tolerance_db) << beam;
  }
}

Scene bed() {
  return seabed_at(-4, diffuse(-20));
}

TEST_P(GapTest, PointsBesideTheBeamsAreNotReceived) {
  Scenario scenario = calibrated(two_sides(), GetParam());
  for (const double azimuth : {90.4, 89.6, -89.6, -90.4}) {
    scenario.points = {{.position = point_from_spherical({10.01, azimuth * kDegree, 0}), .target_strength_db = -20}};
    const Ping ping = ping_of(scenario, {});
    EXPECT_NEAR(total_db(ping), -20 - 40 * std::log10(10.01), 1e-3) << azimuth;
    EXPECT_EQ(sum_of_beam(ping, azimuth > 0 ? 1 : 0), 0) << azimuth;
  }
  for (const double azimuth : {0.0, 45.0, 89.4, -89.4, 90.6, 180.0}) {
    scenario.points = {{.position = point_from_spherical({10.01, azimuth * kDegree, 0}), .target_strength_db = -20}};
    EXPECT_EQ(total_db(ping_of(scenario, {})), -std::numeric_limits<double>::infinity()) << azimuth;
  }
}

// A sphere around the sonar, a seabed, and a plate ahead that no beam sees.
TEST_P(GapTest, TwoSidesHaveTheLevelsOfEachAlone) {
  const Scene shell = sphere_at({0, 0, 0}, 10, diffuse(-20), 0.2);
  const Scene plate = plate_at(8, 1, diffuse(-10));
  EXPECT_EQ(total_db(ping_of(calibrated(two_sides(), GetParam()), plate)), -std::numeric_limits<double>::infinity());
  for (const Scene& scene : {shell, bed()}) {
    const Ping both = ping_of(calibrated(two_sides(), GetParam()), scene);
    for (int beam = 0; beam < 2; ++beam) {
      const Ping alone = ping_of(calibrated(one_side(beam), GetParam()), scene);
      EXPECT_GT(sum_of_beam(alone, 0), 0);
      EXPECT_NEAR(db(sum_of_beam(both, beam)), db(sum_of_beam(alone, 0)), 0.01) << beam;
    }
  }
}

TEST_P(GapTest, EverySecondBeamHasItsLevel) {
  Scenario scenario = calibrated(comb(false), GetParam());
  const Scene curved = sphere_at({9, 0, -4}, 1.5, diffuse(-15), 0.2);  // Normals turn from column to column.
  for (const bool has_pulse : {false, true}) {
    scenario.sonars[0].pulse = has_pulse ? PulseKind::kCw : PulseKind::kNone;
    scenario.sonars[0].pulse_duration = 266e-6;  // Two bins.
    scenario.receiver.azimuth_pattern = BeamPattern::kTopHat;
    expect_same_levels(scenario, bed(), 0.02);
    expect_same_levels(scenario, curved, 0.05);
    scenario.receiver.azimuth_pattern = BeamPattern::kHann;
    expect_same_levels(scenario, bed(), 0.1);
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, GapTest, testing::Values(kReference, kRays, kRaster), kName);

// With speckle, noise and all ground truth. Speckle and noise are random: the mean of 960 cells is within 4 / sqrt(960)
// of the expected one, .53 dB; of a beam's 120, three standard deviations are 1.2 dB.
TEST(GapReceiverTest, SpeckleAndNoiseHaveTheirMeans) {
  for (const BeamPattern pattern : {BeamPattern::kTopHat, BeamPattern::kHann}) {
    Scenario scenario = calibrated(comb(true), kRays);
    scenario.ground_truth = GroundTruth::kFull;
    scenario.receiver.azimuth_pattern = pattern;
    const Ping mean = ping_of(scenario, bed());
    scenario.receiver.speckle = true;
    EXPECT_NEAR(total_db(ping_of(scenario, bed())), total_db(mean), 0.6);

    scenario.receiver.noise = true;
    scenario.receiver.ambient_noise_db = 80;
    double whole = 0, gapped = 0;
    for (const bool with_gaps : {false, true}) {
      scenario.sonars = {comb(with_gaps)};
      const Ping noise = ping_of(scenario, {});
      for (int beam = 0; beam < noise.beam_count; ++beam) {
        (with_gaps ? gapped : whole) += sum_of_beam(noise, beam) / noise.beam_count;
      }
    }
    EXPECT_NEAR(db(gapped / whole), 0, 0.8);  // Beams of 1.6 degrees at half power, with gaps or without.
  }
}

// Labels, path orders and shadows are those of the beams' own slices: the same with and without gaps.
TEST(GapReceiverTest, GroundTruthIsThatOfTheBeamsOwnSlices) {
  const Scene scene = scene_of_all({bed(), scene_of(make_box({1, 0.6, 6}), diffuse(-10), {.position = {9, 0, -4}})});
  for (const BeamPattern pattern : {BeamPattern::kTopHat, BeamPattern::kHann}) {
    Scenario scenario = calibrated(comb(false), kRays);
    scenario.receiver.azimuth_pattern = pattern;
    scenario.ground_truth = GroundTruth::kFull;
    const Ping whole = ping_of(scenario, scene);
    scenario.sonars = {comb(true)};
    const Ping gapped = ping_of(scenario, scene);
    int shadows = 0, boxes = 0, differ = 0;
    for (int beam = 0; beam < 8; ++beam) {
      for (int bin = 0; bin < gapped.bin_count; ++bin) {
        const std::size_t at = gapped.index(bin, beam), same = whole.index(bin, 2 * beam);
        shadows += gapped.shadow[at] > 0.5F ? 1 : 0;
        boxes += gapped.instance[at] == 1 ? 1 : 0;
        differ += gapped.path_order[at] != whole.path_order[same] || gapped.instance[at] != whole.instance[same] ||
                          std::abs(gapped.shadow[at] - whole.shadow[same]) > 0.1F
                      ? 1
                      : 0;
      }
    }
    EXPECT_GT(shadows, 20);
    EXPECT_GT(boxes, 10);
    EXPECT_LE(differ, 10);  // Of 960: at the ends of the surfaces, where samples differ.
  }
}

// A sonar that turns to starboard by some degrees until an echo arrives receives it as far to port of where it sent to:
// from a beam in the gap beside it, where it is lost, or in the next beam. Into gaps nothing is sent. Beams are at 7.5,
// 5.5 .. -6.5 degrees.
TEST(GapReceiverTest, EchoesMoveOverGapsWhileTheSonarListens) {
  const auto in_beam = [](double azimuth) { return std::abs(std::remainder(azimuth + 0.5, 2.0)) < 0.5; };
  for (const double turned : {0.0, -1.0, -2.0}) {
    for (const double azimuth : {-0.5, -1.5}) {
      Scenario scenario = calibrated(comb(true), kRays);
      scenario.motion_in_ping = true;
      scenario.points = {{.position = point_from_spherical({10.02, azimuth * kDegree, -20 * kDegree})}};
      const double time = 2 * 10.02 / scenario.water.true_sound_speed();
      scenario.trajectory.waypoints = {{.time = 0}, {.time = 1, .orientation = {0, 0, turned * kDegree / time}}};
      EXPECT_EQ(total_db(ping_of(scenario, {})) > -100, in_beam(azimuth) && in_beam(azimuth - turned))
          << turned << ' ' << azimuth;
    }
  }
  // A floor fills all beams, also with the motion.
  Scenario still = calibrated(comb(true), kRays), moving = still;
  moving.motion_in_ping = true;
  moving.trajectory.waypoints = {{.time = 0}, {.time = 1, .position = {1, 0, 0}}};
  EXPECT_NEAR(total_db(ping_of(moving, bed())), total_db(ping_of(still, bed())), 0.1);
}

TEST(GapPictureTest, GapsAreDrawnEmpty) {
  SonarConfig sonar = two_sides();
  Ping ping;
  ping.beam_count = 2;
  ping.bin_count = sonar.bin_count;
  ping.intensity.assign(static_cast<std::size_t>(2) * sonar.bin_count, 1.0F);
  const Picture picture = draw_fan(ping, sonar, {.height = 400, .annotations = false});
  int bright = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    bright += picture.rgb[i] > 200 ? 1 : 0;
  }
  // Two slices of a degree of a circle, of which the picture shows about half.
  EXPECT_GT(bright, 0);
  EXPECT_LT(bright, picture.width * picture.height / 50);
}

}  // namespace
}  // namespace insonify::validation::gap_test
