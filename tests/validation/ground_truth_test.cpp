// ground_truth_test.cpp -- the ground truth of pings, on scenes where it is known (T10, T16 of
// docs/concepts/physics-tests.md).

#include <numeric>

#include "engines/random_scene.h"
#include "insonify/error.h"
#include "support/message_of.h"
#include "support/shadow_sonar.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::ground_truth_test {
namespace {

class GroundTruthTest : public testing::TestWithParam<Method> {};

Scenario with_truth(const SonarConfig& sonar, const Method& method, GroundTruth truth = GroundTruth::kFull) {
  Scenario scenario = calibrated(sonar, method);
  scenario.ground_truth = truth;
  return scenario;
}

std::uint16_t instance_at(const Ping& ping, int bin, int beam, int rank) {
  return ping.strongest_instance[kStrongestCount * ping.index(bin, beam) + rank];
}
float share_at(const Ping& ping, int bin, int beam, int rank) {
  return ping.strongest_share[kStrongestCount * ping.index(bin, beam) + rank];
}

// Three beams of 4 degrees, bins of half a metre.
SonarConfig coarse_sonar() {
  SonarConfig sonar;
  sonar.beam_count = 3;
  sonar.azimuth_aperture = 12 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.elevation_center = 2 * kDegree;
  sonar.min_range = 5;
  sonar.max_range = 15;
  sonar.bin_count = 20;
  sonar.sampling = {32, 800};
  return sonar;
}
constexpr int kPlateBin = 10;  // 10.0 to 10.5 m.

// A square of 0.1 m at 10.2 m that faces the sonar.
Scene plate_up(double elevation, double lambert_db) {
  Scene scene = plate_at(0, 0.1, diffuse(lambert_db));
  scene.instances[0].world_from_mesh = {.position = 10.2 * Vec3(std::cos(elevation), 0, std::sin(elevation)),
                                        .orientation = orientation_from_rpy(0, -elevation, 0)};
  return scene;
}

// Equal squares whose backscatter is 1 : 4 : 2 give 1/7, 4/7 and 2/7 of the echo.
Scene three_plates() {
  return scene_of_all({plate_up(-4 * kDegree, -16.0206), plate_up(2 * kDegree, -10), plate_up(8 * kDegree, -13.0103)});
}

TEST_P(GroundTruthTest, PlatesInOneBinShareItsEcho) {
  const Ping ping = ping_of(with_truth(coarse_sonar(), GetParam()), three_plates());
  constexpr double kSampling = 0.02;  // Tolerance of shares: each plate is sampled by 23 rows.
  for (int beam = 0; beam < 3; ++beam) {
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      const bool plates = beam == 1 && bin == kPlateBin;
      for (int rank = 0; rank < kStrongestCount; ++rank) {
        constexpr std::uint16_t kOrder[] = {1, 2, 0};
        EXPECT_EQ(instance_at(ping, bin, beam, rank), plates ? kOrder[rank] : kNoLabel);
        EXPECT_NEAR(share_at(ping, bin, beam, rank), plates ? (4 >> rank) / 7.0 : 0.0, plates ? kSampling : 0);
      }
      EXPECT_EQ(ping.instance[ping.index(bin, beam)], plates ? 1 : kNoLabel);
      EXPECT_EQ(ping.material[ping.index(bin, beam)], plates ? 1 : kNoLabel);
      EXPECT_EQ(ping.path_order[ping.index(bin, beam)], plates ? 1 : 0);
    }
  }
  EXPECT_NEAR(ping.elevation[ping.index(kPlateBin, 1)], 2 * kDegree, 0.02 * kDegree);
}

// An array receives the plates in all beams through its side lobes; labels are those of each beam's own slice.
TEST_P(GroundTruthTest, BeamsOfAnArrayLabelTheirOwnSlice) {
  Scenario scenario = with_truth(coarse_sonar(), GetParam());
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  const Ping ping = ping_of(scenario, three_plates());
  EXPECT_NEAR(share_at(ping, kPlateBin, 1, 0), 4 / 7.0, 0.03);
  EXPECT_NEAR(share_at(ping, kPlateBin, 1, 1), 2 / 7.0, 0.03);
  for (const int beam : {0, 2}) {
    EXPECT_GT(ping.intensity[ping.index(kPlateBin, beam)], 0);
    EXPECT_GT(ping.direct_intensity[ping.index(kPlateBin, beam)], 0);
    EXPECT_EQ(ping.instance[ping.index(kPlateBin, beam)], kNoLabel);
    EXPECT_EQ(ping.path_order[ping.index(kPlateBin, beam)], 0);
  }
}

// A Lambert wall at x = d echoes dI ~ cos(t)^4 dt from the elevation t. The wall is not at the middle of the aperture.
TEST_P(GroundTruthTest, WallSpreadsOverItsHeight) {
  constexpr double kDistance = 10.1, kLow = 0.2, kHigh = 1.8;
  const Scene wall = scene_of(make_box({0.01, 0.2, kHigh - kLow}), diffuse(-20),
                              {.position = {kDistance + 0.005, 0, 0.5 * (kLow + kHigh)}});
  const Ping ping = ping_of(with_truth(coarse_sonar(), GetParam()), wall);

  double sum = 0, moment = 0, square = 0;
  const double from = std::atan(kLow / kDistance), to = std::atan(kHigh / kDistance);
  constexpr int kSteps = 10000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = from + (to - from) * (i + 0.5) / kSteps, weight = std::pow(std::cos(t), 4);
    sum += weight, moment += weight * t, square += weight * t * t;
  }
  const double mean = moment / sum, spread = std::sqrt(square / sum - mean * mean);
  EXPECT_NEAR(ping.elevation[ping.index(kPlateBin, 1)], mean, 1e-4);
  EXPECT_NEAR(ping.elevation_spread[ping.index(kPlateBin, 1)], spread, 0.003 * spread);
  EXPECT_TRUE(std::isnan(ping.elevation_spread[ping.index(kPlateBin, 0)]));
}

// T16. A plate 1 m high at x = 10, the sonar 3 m above the bed, and a wall at x = 20. Elevations are -30 to 0 degrees:
// the bed is insonified from 6 m on; the top of the plate is 11.31 degrees down.
Scene plate_on_a_bed() {
  return scene_of_all({seabed_at(-3, diffuse(-20)),
                       scene_of(make_box({0.01, 4, 1}), diffuse(-20), {.position = {10.005, 0, -2.5}}),
                       plane(-Vec3::UnitX(), {20, 0, 0}, diffuse(-20))});
}

TEST_P(GroundTruthTest, ShadowLiesBehindThePlateAndBehindTheWall) {
  const SonarConfig sonar = shadow_sonar();
  const Ping ping = ping_of(with_truth(sonar, GetParam()), plate_on_a_bed());
  const double bin = sonar.bin_length();
  const double hidden = (std::sin(30 * kDegree) - 2 / std::sqrt(104.0)) / std::sin(30 * kDegree);
  for (int i = 0; i < sonar.bin_count; ++i) {
    const double range = sonar.bin_range(i);
    if (range < 6 - bin) {
      EXPECT_EQ(ping.shadow[i], 0) << range;  // Open water.
    } else if (range > 10.4403 + 2 * bin && range < 15.2971 - bin) {
      EXPECT_NEAR(ping.shadow[i], hidden, 0.005) << range;
      EXPECT_EQ(ping.intensity[i], 0) << range;
      EXPECT_EQ(ping.instance[i], kNoLabel) << range;
    } else if (range > std::sqrt(409.0) + 2 * bin) {
      EXPECT_NEAR(ping.shadow[i], 1, 1e-4) << range;
    } else if (range < 10.4403 - bin || range > 15.2971 + 2 * bin) {
      EXPECT_EQ(ping.shadow[i], 0) << range;  // The bed echoes here.
    }
  }
}

// Surfaces nearer than the first bin cast shadows too.
TEST_P(GroundTruthTest, SurfacesNearerThanTheFirstBinCastShadows) {
  SonarConfig sonar = shadow_sonar();
  sonar.min_range = 12;
  sonar.bin_count = 260;
  const Ping ping = ping_of(with_truth(sonar, GetParam()), plate_on_a_bed());
  EXPECT_NEAR(ping.shadow[0], (0.5 - 2 / std::sqrt(104.0)) / 0.5, 0.005);
  EXPECT_NEAR(ping.shadow[60], (0.5 - 2 / std::sqrt(104.0)) / 0.5, 0.005);  // 15 m.
  EXPECT_EQ(ping.shadow[70], 0);
}

// A point target in a bin in which a plate hides the bed: the bin has a direct echo, and so no shadow. The point has no
// instance.
TEST_P(GroundTruthTest, PointIsADirectEchoWithoutALabel) {
  Scenario scenario = with_truth(shadow_sonar(), GetParam());
  scenario.points = {{.position = {12, 0, -1}, .target_strength_db = -20}};
  const Ping ping = ping_of(scenario, plate_on_a_bed());
  const int bin = static_cast<int>(std::sqrt(145.0) / 0.05);
  EXPECT_GT(ping.shadow[bin - 1], 0);
  EXPECT_EQ(ping.shadow[bin], 0);
  EXPECT_GT(ping.direct_intensity[bin], 0);
  EXPECT_EQ(ping.path_order[bin], 1);
  EXPECT_EQ(ping.instance[bin], kNoLabel);
  EXPECT_EQ(share_at(ping, bin, 0, 0), 0);
}

// Ghosts of a point by way of the sea surface, with path orders 2 and 3, are not direct echoes.
TEST_P(GroundTruthTest, GhostsOfPointsAreNotDirect) {
  SonarConfig sonar = shadow_sonar();
  sonar.elevation_aperture = 100 * kDegree;
  sonar.elevation_center = 0;
  sonar.position = {0, 0, -5};
  Scenario scenario = with_truth(sonar, GetParam());
  scenario.secondary = SecondaryEchoes::kAll;
  scenario.surface = SeaSurface{};
  scenario.points = {{.position = {10, 0, -4}}};
  const Ping ping = ping_of(scenario, {});
  const double ranges[] = {10.04987562112089, 11.7517498340973, 13.45362404707371};
  for (int order = 1; order <= 3; ++order) {
    const int bin = static_cast<int>(ranges[order - 1] / sonar.bin_length());
    EXPECT_GT(ping.intensity[bin], 1e-6) << order;
    EXPECT_EQ(ping.path_order[bin], order);
    EXPECT_EQ(ping.direct_intensity[bin] > 1e-6, order == 1) << order;
  }
}

Scenario corner_with_truth(const Method& method) {
  SonarConfig sonar = corner_sonar();
  sonar.position = {0, 0, -5};
  sonar.beam_count = 16;
  sonar.sampling = {4, 400};
  Scenario scenario = with_truth(sonar, method);
  scenario.secondary = SecondaryEchoes::kAll;
  return scenario;
}

// The corner of T10. The energy of each path order in a bin is the difference between pings with more and with fewer
// surfaces allowed.
TEST_P(GroundTruthTest, PathOrderIsThatOfMostOfTheEcho) {
  Scenario scenario = corner_with_truth(GetParam());
  std::vector<Ping> pings;
  for (const int surfaces : {1, 2, 3}) {
    scenario.max_surfaces = surfaces;
    pings.push_back(ping_of(scenario, corner(1, -20)));
  }
  int found[kPathOrders + 1] = {};
  for (std::size_t i = 0; i < pings[2].intensity.size(); ++i) {
    const double energy[] = {pings[0].intensity[i], pings[1].intensity[i] - pings[0].intensity[i],
                             pings[2].intensity[i] - pings[1].intensity[i]};
    const auto most = std::ranges::max_element(energy);
    const double sum = energy[0] + energy[1] + energy[2];
    const int others =
        static_cast<int>(std::ranges::count_if(energy, [&](double e) { return e > *most - 0.01 * sum; }));
    if (sum == 0) {
      EXPECT_EQ(pings[2].path_order[i], 0) << i;
    } else if (others == 1) {
      EXPECT_EQ(pings[2].path_order[i], 1 + (most - energy)) << i;
    }
    ++found[pings[2].path_order[i]];
  }
  EXPECT_GT(found[1], 100);
  EXPECT_GT(found[2], 100);
  EXPECT_GT(found[3], 10);
  // At the apex, straight ahead, it is the double bounce.
  EXPECT_EQ(pings[2].path_order[pings[2].index(static_cast<int>((10.4403 - 5) / scenario.sonars[0].bin_length()), 7)],
            2);
}

// With array, pulse and gain, the direct intensity equals the ping without secondary echoes.
TEST_P(GroundTruthTest, DirectIntensityIsThePingWithoutSecondaryEchoes) {
  Scenario scenario = corner_with_truth(GetParam());
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 1e-3;
  scenario.receiver.time_varied_gain = 30;
  scenario.water.volume_backscatter_db = -40;
  scenario.receiver.speckle = true;
  scenario.receiver.noise = true;
  const Ping all = ping_of(scenario, corner(1, -20));
  scenario.secondary = SecondaryEchoes::kNone;
  scenario.water.volume_backscatter_db = {};
  scenario.receiver.speckle = scenario.receiver.noise = false;
  const Ping direct = ping_of(scenario, corner(1, -20));
  for (std::size_t i = 0; i < all.intensity.size(); ++i) {
    ASSERT_NEAR(all.direct_intensity[i], direct.intensity[i], 1e-5 * direct.intensity[i]) << i;
    ASSERT_EQ(direct.direct_intensity[i], all.direct_intensity[i]) << i;
  }
}

// Energy of each instance alone: the others keep their geometry and get a material that does not echo.
std::vector<std::vector<float>> exact_count(const SonarConfig& sonar, const Scene& scene) {
  std::vector<std::vector<float>> counts;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    Scene one = scene;
    for (std::size_t m = 0; m < one.materials.size(); ++m) {
      if (m != scene.instances[i].materials[0]) {
        one.materials[m] = diffuse(-300);
      }
    }
    counts.push_back(ping_of(with_truth(sonar, kReference, GroundTruth::kNone), one).intensity);
  }
  return counts;
}

// Against the exact count by the reference engine, however many instances there are in a bin.
TEST_P(GroundTruthTest, SharesAgreeWithAnExactCount) {
  const SonarConfig sonar = coarse_sonar();
  for (const int plates : {4, 9}) {
    std::vector<Scene> scenes;
    for (int i = 0; i < plates; ++i) {
      scenes.push_back(plate_up((-7 + 18.0 * i / plates) * kDegree, -10 - 1.7 * ((i * 5) % plates)));
    }
    const Scene scene = scene_of_all(std::move(scenes));
    const std::vector<std::vector<float>> exact = exact_count(sonar, scene);
    const Ping ping = ping_of(with_truth(sonar, GetParam()), scene);
    const std::size_t cell = ping.index(kPlateBin, 1);
    std::vector<std::pair<double, int>> ranked;
    double all = 0;
    for (int i = 0; i < plates; ++i) {
      ranked.emplace_back(exact[i][cell], i);
      all += exact[i][cell];
    }
    std::ranges::sort(ranked, std::greater());
    constexpr double kShareError = 1e-3;  // Engines agree to 1e-4 of the energy.
    for (int rank = 0; rank < kStrongestCount; ++rank) {
      const int named = instance_at(ping, kPlateBin, 1, rank);
      EXPECT_EQ(named, ranked[rank].second) << plates << ", " << rank;
      EXPECT_NEAR(share_at(ping, kPlateBin, 1, rank), ranked[rank].first / all, kShareError) << plates << ", " << rank;
    }
  }
}

// Full ground truth changes no echo, and agrees with labels where one surface gives most of the energy.
TEST_P(GroundTruthTest, ChangesNoEchoAndAgreesWithTheLabels) {
  int compared = 0;
  for (int seed = 0; seed < 5; ++seed) {
    const testing_scenes::RandomScene random(seed);
    Scenario scenario = with_truth(random.sonar, GetParam());
    scenario.sonars[0].position = random.pose.position;
    scenario.secondary = SecondaryEchoes::kAll;
    const Ping full = ping_of(scenario, random.scene);
    scenario.ground_truth = GroundTruth::kLabels;
    const Ping labels = ping_of(scenario, random.scene);
    scenario.ground_truth = GroundTruth::kNone;
    const Ping none = ping_of(scenario, random.scene);
    EXPECT_EQ(full.intensity, labels.intensity);
    EXPECT_EQ(none.intensity, labels.intensity);
    EXPECT_TRUE(none.instance.empty() && none.material.empty() && none.elevation.empty());
    EXPECT_TRUE(labels.strongest_instance.empty() && labels.shadow.empty() && labels.direct_intensity.empty());
    for (std::size_t i = 0; i < full.intensity.size(); ++i) {
      if (full.strongest_share[kStrongestCount * i] > 0.51F) {
        ++compared;
        ASSERT_EQ(full.instance[i], labels.instance[i]) << seed << ", " << i;
        ASSERT_EQ(full.material[i], labels.material[i]) << seed << ", " << i;
      }
      ASSERT_EQ(full.instance[i], full.strongest_instance[kStrongestCount * i]);
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(GroundTruthErrorTest, FullNeedsTheCalibratedModel) {
  Scenario scenario = with_truth(coarse_sonar(), kRays);
  scenario.model = EchoModel::kPaper;
  EXPECT_EQ(message_of([&] { scenario.validate(); }), "ground_truth = full needs model = calibrated");
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, GroundTruthTest, testing::Values(kReference, kRays, kRaster), kName);

}  // namespace
}  // namespace insonify::validation::ground_truth_test
