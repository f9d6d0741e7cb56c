// see_through_test.cpp -- echoes from behind foils, plates and nets: levels, shadows, labels, and all that a receiver
// does to them. |T|^2 of the foils was computed apart from this code, as six linear equations in the amplitudes of the
// waves in an elastic plate between two half-spaces of water.

#include "validation/see_through_scene.h"

namespace insonify::validation::see_through_test {
namespace {

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

// The same of surfaces nearer than the first bin, whatever is stored and whatever receives: nothing comes back through
// a wall.
TEST_P(SeeThroughTest, WaterBehindSurfacesBeforeTheFirstBinIsHidden) {
  for (const GroundTruth truth : {GroundTruth::kNone, GroundTruth::kLabels, GroundTruth::kFull}) {
    for (const BeamPattern pattern : {BeamPattern::kTopHat, BeamPattern::kTaylor}) {
      for (const bool crossed : {false, true}) {  // With a pulse, bins longer than it, and motion.
        Scenario scenario = scenario_of(narrow_sonar(), GetParam());
        scenario.water.volume_backscatter_db = -55;
        scenario.ground_truth = truth;
        scenario.receiver.azimuth_pattern = pattern;
        scenario.sonars[0].min_range = 7.3;
        scenario.sonars[0].bin_count = crossed ? 19 : 190;
        scenario.receiver.pulse = crossed ? PulseKind::kCw : PulseKind::kNone;
        scenario.receiver.pulse_duration = 80e-6;
        scenario.motion_in_ping = crossed;
        PingRequest request;
        request.twist.linear = Vec3(crossed ? 2 : 0, 0.5, 0);
        const auto behind = [&](const Scene& scene) {
          Ping ping;
          Simulator(scenario, scene, 2).ping(0, request, ping);
          return ping;
        };
        const Ping open = behind({}), net_before = behind(plate_at(2.9, 30, net(0.8))),
                   wall_before = behind(plate_at(2.9, 30, *find_material("steel")));
        for (const int bin : {0, 8, open.bin_count - 1}) {
          const std::size_t at = open.index(bin, 3);
          ASSERT_GT(open.intensity[at], 0);
          EXPECT_NEAR(net_before.intensity[at] / open.intensity[at], 0.64, 1e-3) << bin << crossed;
          EXPECT_NEAR(wall_before.intensity[at] / open.intensity[at], 0, 1e-5) << bin << crossed;
        }
      }
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
}  // namespace insonify::validation::see_through_test
