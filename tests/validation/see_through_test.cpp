// see_through_test.cpp -- echoes from behind foils, plates and nets: levels, shadows, labels, and all that a receiver
// does to them. |T|^2 of the foils was computed apart from this code, as six linear equations in the amplitudes of the
// waves in an elastic plate between two half-spaces of water.

#include "support/same_pings.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Gives no echo of its own.
Material net(double open_share) {
  Material material = diffuse(-200);
  material.name = "net";
  material.open_share = open_share;
  return material;
}

Material foil(double density, double sound_speed, double shear_speed) {
  Material material;
  material.name = "foil";
  material.density = density;
  material.sound_speed = sound_speed;
  material.shear_speed = shear_speed;
  material.thickness = 3e-4;
  material.lambert_db = -200;
  return material;
}
const Material kPolyethylene = foil(960, 2430, 950), kAluminium = foil(2700, 6420, 3040);

Material opaque(Material material) {
  material.thickness.reset();
  material.open_share = 0;
  return material;
}

// A degree by a degree.
SonarConfig narrow_sonar() {
  SonarConfig sonar;
  sonar.frequency = 720e3;
  sonar.beam_count = 8;
  sonar.azimuth_aperture = 1 * kDegree;
  sonar.elevation_aperture = 1 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = 20;
  sonar.bin_count = 190;
  sonar.sampling = {4, 40};
  return sonar;
}

SonarConfig wide_sonar() {
  SonarConfig sonar = narrow_sonar();
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.elevation_center = -10 * kDegree;
  sonar.sampling = {4, 100};
  return sonar;
}

// Sum over the bins from a range on.
double energy_from(const Ping& ping, const SonarConfig& sonar, double range) {
  const std::vector<double> sums = by_range(ping);
  double sum = 0;
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    sum += sonar.bin_range(bin) > range ? sums[bin] : 0;
  }
  return sum;
}

double db(double value) {
  return 10 * std::log10(value);
}

Scenario scenario_of(const SonarConfig& sonar, const Method& method) {
  Scenario scenario = calibrated(sonar, method);
  scenario.water.sound_speed = 1500;
  return scenario;
}

class SeeThroughTest : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, SeeThroughTest, testing::Values(kRays, kRaster, kReference),
                         [](const auto& test) { return std::string(test.param.name); });

// A Lambert wall at 10 m in a fan of 1 by 1 degree: mu Omega / 100, times |T|^4, the foil being square to the sound or
// turned about the vertical. |T|^2 as above.
TEST_P(SeeThroughTest, AWallBehindAFoilLosesWhatTheFoilTakesTwice) {
  struct Case {
    Material foil;
    double tilt_deg, transmittance;
  };
  const double solid_angle = kDegree * 2 * std::sin(0.5 * kDegree);
  for (const Case& c :
       {Case{kPolyethylene, 0, 0.951068665}, Case{kPolyethylene, 20, 0.946969718}, Case{kPolyethylene, 35, 0.910565243},
        Case{kAluminium, 0, 0.421163884}, Case{kAluminium, 20, 0.463210410}, Case{kAluminium, 50, 0.745906344}}) {
    const Ping ping =
        ping_of(scenario_of(narrow_sonar(), GetParam()),
                scene_of_all({plate_at(10, 30, diffuse(-15)), plate_at(5, 30, c.foil, c.tilt_deg * kDegree)}));
    EXPECT_NEAR(db(energy_from(ping, narrow_sonar(), 8)), -15 + db(solid_angle / 100) + 2 * db(c.transmittance), 0.03)
        << c.transmittance;
  }
}

// Two foils, one turned, and absorption: the factors multiply, and absorption is that of the whole path.
TEST_P(SeeThroughTest, SurfacesOneAfterAnotherMultiply) {
  Scenario scenario = scenario_of(narrow_sonar(), GetParam());
  scenario.water.absorption = true;
  const auto level = [&](std::vector<Scene> before) {
    before.insert(before.begin(), plate_at(10, 30, diffuse(-15)));
    return db(energy_from(ping_of(scenario, scene_of_all(std::move(before))), narrow_sonar(), 8));
  };
  const double alone = level({});
  EXPECT_NEAR(level({plate_at(4, 30, kPolyethylene, 20 * kDegree), plate_at(6, 30, kAluminium)}) - alone,
              2 * db(0.946969718 * 0.421163884), 0.03);
  EXPECT_NEAR(level({plate_at(4, 30, net(0.8)), plate_at(6, 30, net(0.7)), plate_at(7, 30, kPolyethylene)}) - alone,
              2 * db(0.8 * 0.7 * 0.951068665), 0.03);
}

// Eight surfaces are passed, nothing is seen behind a ninth; and nothing where less than -50 dB comes back, |T|^2 =
// 0.00316.
TEST_P(SeeThroughTest, EndsAfterEightSurfacesAndBelowTheLeastShare) {
  const auto energy = [&](int nets, double open_share) {
    std::vector<Scene> scenes = {plate_at(18, 30, diffuse(-15))};
    for (int i = 0; i < nets; ++i) {
      scenes.push_back(plate_at(3 + i, 30, net(open_share)));
    }
    return energy_from(ping_of(scenario_of(narrow_sonar(), GetParam()), scene_of_all(std::move(scenes))),
                       narrow_sonar(), 15);
  };
  const double alone = energy(0, 0);
  EXPECT_NEAR(energy(8, 0.9) / alone, std::pow(0.9, 16), 1e-3);
  EXPECT_EQ(energy(9, 0.9), 0);
  EXPECT_NEAR(energy(1, 0.0033) / alone, 0.0033 * 0.0033, 1e-9);
  EXPECT_EQ(energy(1, 0.0031), 0);
}

// A net across the port half of the fan, 6 m ahead, over a floor: bins behind it lose 0.8^2, all others nothing, and it
// hides no more of the water. The floor keeps its labels.
TEST_P(SeeThroughTest, ANetDimsTheFloorBehindIt) {
  Scenario scenario = scenario_of(wide_sonar(), GetParam());
  scenario.ground_truth = GroundTruth::kFull;
  const Scene floor = seabed_at(-2, diffuse(-20));
  const Ping bare = ping_of(scenario, floor);
  const Ping behind =
      ping_of(scenario,
              scene_of_all({floor, scene_of(make_plane(-Vec3::UnitX(), 20, 20), net(0.8), {.position = {6, 10, 0}})}));
  int dimmed = 0, same = 0;
  for (int bin = 0; bin < bare.bin_count; ++bin) {
    for (int beam = 0; beam < bare.beam_count; ++beam) {
      const std::size_t at = bare.index(bin, beam);
      const double range = wide_sonar().bin_range(bin), ahead = 6 / std::cos(wide_sonar().beam_azimuth(beam));
      if (bare.intensity[at] == 0 || std::abs(range - 1.03 * ahead) < 0.06 * ahead) {
        continue;
      }
      const bool hidden = beam < 16 && range > ahead;
      EXPECT_NEAR(behind.intensity[at] / bare.intensity[at], hidden ? 0.64 : 1, 1e-3) << bin << ", " << beam;
      EXPECT_EQ(behind.instance[at], 0);
      EXPECT_EQ(behind.path_order[at], 1);
      EXPECT_EQ(behind.shadow[at], 0);
      ++(hidden ? dimmed : same);
    }
  }
  EXPECT_GT(dimmed, 1000);
  EXPECT_GT(same, 1500);
}

// Shadow and volume reverberation behind a net in open water: what does not come back, 1 - 0.64, is hidden.
TEST_P(SeeThroughTest, WaterBehindANetIsHiddenInPart) {
  Scenario scenario = scenario_of(narrow_sonar(), GetParam());
  scenario.water.volume_backscatter_db = -60;
  scenario.ground_truth = GroundTruth::kFull;
  const Ping bare = ping_of(scenario, {});
  for (const auto& [distance, first] : {std::pair(6.0, 1.0), std::pair(6.0, 8.0)}) {  // The net nearer than bin 0, too.
    scenario.sonars[0].min_range = first;
    const Ping open = ping_of(scenario, {});
    const Ping ping = ping_of(scenario, plate_at(distance, 30, net(0.8)));
    const int last = ping.bin_count - 1;
    EXPECT_NEAR(ping.shadow[ping.index(last, 3)], 0.36, 1e-3) << first;
    EXPECT_EQ(open.shadow[ping.index(last, 3)], 0);
    if (first < distance) {
      EXPECT_NEAR(ping.intensity[ping.index(last, 3)] / open.intensity[ping.index(last, 3)], 0.64, 1e-3);
      EXPECT_EQ(ping.shadow[ping.index(5, 3)], 0);
    }
  }
}

// A surface that is open altogether is not there: not in the picture, nor in the ground truth, whatever its relief.
// Where it ends within the fan or meets the bed, samples of the bed on both sides are not joined: the level within half
// a sample there is that of either, one of some hundred rows.
TEST_P(SeeThroughTest, WhatIsOpenAltogetherIsNotThere) {
  Scenario scenario = scenario_of(wide_sonar(), GetParam());
  scenario.ground_truth = GroundTruth::kFull;
  scenario.water.volume_backscatter_db = -60;
  scenario.points = {{.position = {9, 0.5, -1}, .target_strength_db = -30}};
  const std::vector<Scene> scenes = {seabed_at(-2, diffuse(-20)),
                                     sphere_at({9, -2, -1.5}, 0.5, glinting(0.8, 0.1), 0.3)};
  const Ping bare = ping_of(scenario, scene_of_all(scenes));
  Material open = *find_material("granite");
  open.open_share = 1;
  struct Case {
    double ahead;
    bool rippled;
    double tolerance;
  };
  for (const Case& c : {Case{2, false, 1e-5}, Case{6, false, 2e-3}, Case{2, true, 1e-5}}) {
    if (c.rippled) {
      ReliefConfig relief;
      relief.ripple_wavelength = 0.5;
      relief.ripple_height = 0.15;
      open.relief = std::make_shared<const Relief>(make_relief(relief));
    }
    std::vector<Scene> with = scenes;
    with.push_back(plate_at(c.ahead, 30, open, 0.4));
    const Ping ping = ping_of(scenario, scene_of_all(std::move(with)));
    double apart = 0, sum = 0;
    int other = 0;
    for (std::size_t i = 0; i < bare.intensity.size(); ++i) {
      apart += std::abs(double{ping.intensity[i]} - double{bare.intensity[i]});
      sum += bare.intensity[i];
      other += ping.instance[i] != bare.instance[i] || std::abs(ping.shadow[i] - bare.shadow[i]) > 1e-3F ||
                       ping.path_order[i] != bare.path_order[i]
                   ? 1
                   : 0;
    }
    EXPECT_LE(apart / sum, c.tolerance) << c.ahead << c.rippled;
    EXPECT_LE(other, c.tolerance > 1e-3 ? 60 : 3) << c.ahead << c.rippled;  // Of 6080 cells.
  }
}

// What is opaque hides all behind it, as before; what is in front of a net is not changed by it.
TEST_P(SeeThroughTest, OpaqueSurfacesHide) {
  const Scene wall = plate_at(10, 30, diffuse(-15));
  for (const Material& plate : {opaque(kAluminium), net(0)}) {
    const Ping ping = ping_of(scenario_of(narrow_sonar(), GetParam()), scene_of_all({wall, plate_at(5, 30, plate)}));
    EXPECT_EQ(energy_from(ping, narrow_sonar(), 8), 0);
  }
  const double alone = energy_from(ping_of(scenario_of(narrow_sonar(), GetParam()), wall), narrow_sonar(), 8);
  EXPECT_EQ(
      energy_from(ping_of(scenario_of(narrow_sonar(), GetParam()), scene_of_all({wall, plate_at(12, 30, net(0.5))})),
                  narrow_sonar(), 8),
      alone);
}

// The rest of a net scatters: a panel of solidity 0.3 has 0.3 of the echo of a closed one.
TEST_P(SeeThroughTest, TheClosedPartScattersAndReflects) {
  Material panel = diffuse(-12);
  const double closed = total_db(ping_of(scenario_of(narrow_sonar(), GetParam()), plate_at(9, 30, panel)));
  panel.open_share = 0.7;
  EXPECT_NEAR(total_db(ping_of(scenario_of(narrow_sonar(), GetParam()), plate_at(9, 30, panel))) - closed, db(0.3),
              1e-3);
  Material mirror = glinting(0.6, 0.1);
  const double whole = total_db(ping_of(scenario_of(wide_sonar(), GetParam()), plate_at(9, 30, mirror)));
  mirror.open_share = 0.7;
  EXPECT_NEAR(total_db(ping_of(scenario_of(wide_sonar(), GetParam()), plate_at(9, 30, mirror))) - whole, db(0.3), 1e-3);
}

// A curved body behind a net: its lobe is that of its footprint, as without one.
TEST_P(SeeThroughTest, CurvedBodiesKeepTheirTargetStrength) {
  const Scene ball = sphere_at({12, 0.1, 0.05}, 0.15, glinting(0.9, 0.05), 0.1);
  SonarConfig sonar = wide_sonar();
  sonar.elevation_center = 0;
  const double bare = total_db(ping_of(scenario_of(sonar, GetParam()), ball));
  EXPECT_NEAR(bare, db(0.81 * 0.15 * 0.15 / 4) - 40 * std::log10(11.85), 1.5);
  EXPECT_NEAR(total_db(ping_of(scenario_of(sonar, GetParam()), scene_of_all({ball, plate_at(6, 30, net(0.8))}))) - bare,
              db(0.64), 0.01);
}

// A net before a wall, everything that moves, receives and disturbs included, is no net before a wall of 0.64 times the
// backscatter: speckle and clutter of the wall are its own, noise stays.
struct Receiving {
  const char* name;
  void (*set)(Scenario& scenario);
};

class SeeThroughReceiverTest : public testing::TestWithParam<Receiving> {};

void receive(Scenario& scenario) {
  scenario.receiver.speckle = true;
  scenario.receiver.noise = true;
  scenario.receiver.azimuth_pattern = BeamPattern::kHann;
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 2e-4;
  scenario.receiver.pulse_bandwidth = 60e3;
}

TEST_P(SeeThroughReceiverTest, ANetIsAFainterWall) {
  for (const char* engine : {"cpu", "reference"}) {
    SonarConfig sonar = wide_sonar();
    sonar.elevation_center = 0;
    Scenario scenario = scenario_of(sonar, {engine, engine, PrimaryEchoes::kRays});
    scenario.water.absorption = true;
    scenario.ground_truth = GroundTruth::kFull;
    GetParam().set(scenario);
    const auto ping = [&](double open_share, double lambert_db) {
      Material wall = diffuse(lambert_db);
      wall.clutter_shape = 2;
      Simulator simulator(
          scenario, scene_of_all({plane(-Vec3::UnitX(), {10, 0, 0}, wall), plate_at(6, 60, net(open_share), 0.3)}), 2);
      return simulator.make_ping(0, 1);
    };
    const Ping behind = ping(0.8, -15), fainter = ping(1, -15 + db(0.64));
    double apart = 0, sum = 0;
    for (std::size_t i = 0; i < behind.intensity.size(); ++i) {
      apart += std::abs(double{behind.intensity[i]} - double{fainter.intensity[i]});
      sum += fainter.intensity[i];
    }
    EXPECT_GT(sum, 0);
    EXPECT_LE(apart / sum, 1e-4) << engine;
  }
}
INSTANTIATE_TEST_SUITE_P(
    Receivers, SeeThroughReceiverTest,
    testing::Values(Receiving{"plain", [](Scenario&) {}}, Receiving{"fine", receive},
                    Receiving{"coarseBins",
                              [](Scenario& scenario) {
                                receive(scenario);
                                scenario.sonars[0].bin_count = 60;
                              }},
                    Receiving{"pattern",
                              [](Scenario& scenario) {
                                receive(scenario);
                                scenario.receiver.elevation_pattern = BeamPattern::kHann;
                              }},
                    Receiving{"moving",
                              [](Scenario& scenario) {
                                receive(scenario);
                                scenario.motion_in_ping = true;
                                scenario.trajectory.waypoints = {{.time = 0}, {.time = 1, .position = {0.5, 1, 0.2}}};
                              }}),
    [](const auto& test) { return std::string(test.param.name); });

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

// The same bytes for any number of threads, also where beams are divided into other tasks.
TEST(SeeThroughThreadsTest, DoNotMatter) {
  SonarConfig sonar = wide_sonar();
  sonar.beam_count = 150;
  for (const Method& method : {kRays, kRaster}) {
    Scenario scenario = scenario_of(sonar, method);
    scenario.ground_truth = GroundTruth::kFull;
    scenario.secondary = SecondaryEchoes::kSelective;
    const Scene scene = scene_of_all({seabed_at(-2, diffuse(-20)), sphere_at({9, -2, -1.5}, 0.5, glinting(0.8, 0.1)),
                                      plate_at(6, 4, net(0.8), 0.2), plate_at(7, 3, kPolyethylene, -0.3)});
    const Ping one = Simulator(scenario, scene, 1).make_ping(0, 0);
    for (const int threads : {2, 5}) {
      expect_same(Simulator(scenario, scene, threads).make_ping(0, 0), one);
    }
  }
}

}  // namespace
}  // namespace insonify::validation
