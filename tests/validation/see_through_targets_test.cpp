// see_through_targets_test.cpp -- points, ropes, glints, edges, ghosts and pulses behind foils and nets.

#include "validation/see_through_scene.h"

namespace insonify::validation::see_through_targets_test {
namespace {

// Discrete echoes: a point, a rope thinner than the samples, a smooth plate seen head on, and the pulses of another
// sonar, which pass once.
class SeeThroughTargetTest : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, SeeThroughTargetTest, testing::Values(kRays, kReference),
                         [](const auto& test) { return std::string(test.param.name); });

SonarConfig level_sonar() {
  SonarConfig sonar = wide_sonar();
  sonar.elevation_center = 0;
  return sonar;
}

// By hand: TS - 40 log 12.005 (-43.177) + 2 x 10 log 0.463210410 (-6.685).
TEST_P(SeeThroughTargetTest, APointIsSeenThroughAFoil) {
  Scenario scenario = scenario_of(level_sonar(), GetParam());
  scenario.points = {{.position = {12, 0.35, 0}, .target_strength_db = -20}};
  const double turned = std::atan2(0.35, 12);  // The foil is turned by 20 degrees to the line of sight.
  const auto level = [&](const Material& foil) {
    return db(energy_from(ping_of(scenario, plate_at(6, 30, foil, 20 * kDegree + turned)), level_sonar(), 11));
  };
  EXPECT_NEAR(level(kAluminium), -20 - 43.177 - 6.685, 0.01);
  EXPECT_NEAR(level(net(0.8)), -20 - 43.177 + db(0.64), 0.01);
  EXPECT_EQ(level(net(0)), -std::numeric_limits<double>::infinity());
}

TEST_P(SeeThroughTargetTest, ThinThingsAreSeenThroughANet) {
  const Scene rope = scene_of(make_cylinder(0.006, 2), diffuse(-15), {.position = {12, 0.1, 0}});
  const Scenario scenario = scenario_of(level_sonar(), GetParam());
  const double bare = total_db(ping_of(scenario, rope));
  EXPECT_NEAR(bare, -15 + db(0.5 * kPi * 0.006 * 2) - 40 * std::log10(12), 0.5);
  for (const double before : {0.02, 6.0}) {  // Right before it too.
    EXPECT_NEAR(total_db(ping_of(scenario, scene_of_all({rope, plate_at(12 - before, 30, net(0.8))}))) - bare, db(0.64),
                0.01);
  }
  EXPECT_LT(total_db(ping_of(scenario, scene_of_all({rope, plate_at(6, 30, net(0))}))), bare - 60);
}

TEST_P(SeeThroughTargetTest, GlintsOfPlanePlatesAreSeenThroughANet) {
  Material polished = glinting(0.8, 0.05);
  polished.rms_height = 1e-6;
  const Scenario scenario = scenario_of(level_sonar(), GetParam());
  const Scene plate = plate_at(14, 1, polished);
  const double bare = total_db(ping_of(scenario, plate));
  EXPECT_NEAR(total_db(ping_of(scenario, scene_of_all({plate, plate_at(6, 30, net(0.8))}))) - bare, db(0.64), 0.01);
  // A plate that lets sound through has its own glint, and another behind it is seen through it.
  polished.open_share = 0.5;
  const double half = total_db(ping_of(scenario, plate_at(14, 1, polished)));
  EXPECT_NEAR(half - bare, db(0.5), 0.01);
  const double both = total_db(ping_of(scenario, scene_of_all({plate, plate_at(13.5, 6, net(0.5))})));
  EXPECT_NEAR(both - bare, db(0.25), 0.01);
}

TEST_P(SeeThroughTargetTest, PulsesOfAnotherSonarPassOnce) {
  Scenario scenario = scenario_of(level_sonar(), GetParam());
  scenario.interferers = {{.position = {12, 0, 0}, .source_level_db = 190, .period = 0.011, .duration = 1e-4}};
  const double bare = total_db(ping_of(scenario, {}));
  EXPECT_NEAR(total_db(ping_of(scenario, plate_at(6, 30, net(0.8)))) - bare, db(0.8), 0.01);
}

// The upright edge of a hard plate, seen over it as it is turned by 50 degrees, is a discrete echo. Behind a net it
// loses 0.64. A plate that is open altogether has no edge.
TEST_P(SeeThroughTargetTest, EdgesAreSeenThroughANet) {
  Material polished = glinting(0.9, 0.05);
  polished.rms_height = 1e-6;
  const Scenario scenario = scenario_of(level_sonar(), GetParam());
  const auto edge_db = [&](double open_share, std::vector<Scene> more) {
    polished.open_share = open_share;
    more.insert(more.begin(), plate_at(12, 2, polished, 50 * kDegree));
    return total_db(ping_of(scenario, scene_of_all(std::move(more))));
  };
  const double bare = edge_db(0, {});
  EXPECT_GT(bare, -100);
  EXPECT_NEAR(edge_db(0, {plate_at(6, 30, net(0.8))}) - bare, db(0.64), 0.01);
  EXPECT_LT(edge_db(1, {}), bare - 80);
}

// The ghost of a point by a wall beside it: out by the wall, back straight, and the other way. A net before all of it
// is passed twice; one between wall and point by one leg once. (10, 0) and the wall y = -4: image at y = -8; the leg
// by the wall meets it at (5, -4). The net at x = 8 is met by the straight leg and by the leg behind the wall.
TEST_P(SeeThroughTargetTest, GhostsOfPointsAreSeenThroughANet) {
  SonarConfig sonar = level_sonar();
  sonar.azimuth_aperture = 120 * kDegree;
  Scenario scenario = scenario_of(sonar, GetParam());
  scenario.secondary = SecondaryEchoes::kSelective;
  scenario.max_surfaces = 2;
  scenario.receiver.speckle = false;
  scenario.points = {{.position = {10, 0, 0}, .target_strength_db = 20}};
  Material wall = glinting(0.9, 0.05);
  wall.rms_height = 1e-6;
  const auto ghost = [&](const std::vector<Scene>& more) {
    std::vector<Scene> scenes = {scene_of(make_plane(Vec3::UnitY(), 40, 40), wall, {.position = {0, -4, 0}})};
    scenes.insert(scenes.end(), more.begin(), more.end());
    // Ghosts at (10 + 12.806) / 2 = 11.403 m.
    const Ping ping = ping_of(scenario, scene_of_all(std::move(scenes)));
    const std::vector<double> sums = by_range(ping);
    return *std::max_element(sums.begin() + 103, sums.begin() + 106);
  };
  const double bare = ghost({});
  ASSERT_GT(bare, 0);
  EXPECT_NEAR(ghost({scene_of(make_plane(-Vec3::UnitX(), 7.8, 7.8), net(0.8), {.position = {8, 0, 0}})}) / bare, 0.64,
              0.02);
  EXPECT_NEAR(ghost({scene_of(make_plane(-Vec3::UnitX(), 1, 1), net(0.8), {.position = {8, 0, 0}})}) / bare, 0.8, 0.02);
  EXPECT_LT(ghost({scene_of(make_plane(-Vec3::UnitX(), 1, 1), net(0), {.position = {8, 0, 0}})}) / bare, 1e-6);
}

}  // namespace
}  // namespace insonify::validation::see_through_targets_test
