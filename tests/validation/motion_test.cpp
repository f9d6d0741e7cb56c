// motion_test.cpp -- motion within a ping: shifts in range and bearing, and the Doppler bias of chirps.

#include "insonify/scenario_requests.h"
#include "receiver/ping_motion.h"
#include "support/message_of.h"
#include "support/same_pings.h"
#include "validation/calibrated_scene.h"

namespace insonify::validation::motion_test {
namespace {

constexpr double kRange = 40, kSoundSpeed = 1500;

// A point at 40 m and a bearing of 10 degrees, and a sonar on a straight trajectory.
class MotionInPingTest : public testing::Test {
 protected:
  static Scenario scenario_of(const Vec3& velocity, double turn_rate) {
    SonarConfig sonar;
    sonar.beam_count = 512;
    sonar.azimuth_aperture = 60 * kDegree;
    sonar.min_range = 39;
    sonar.max_range = 41;
    sonar.bin_count = 800;
    Scenario scenario = calibrated(sonar, kRays);
    scenario.water.sound_speed = kSoundSpeed;
    scenario.motion_in_ping = true;
    scenario.points = {{.position = kRange * Vec3(std::cos(10 * kDegree), std::sin(10 * kDegree), 0)}};
    scenario.trajectory.waypoints = {{.time = 0}, {.time = 1, .position = velocity, .orientation = {0, 0, turn_rate}}};
    return scenario;
  }

  // Range and bearing of the strongest cell [m, deg].
  static std::pair<double, double> peak(const Scenario& scenario, const Scene& scene = {}) {
    const Ping ping = ping_of(scenario, scene);
    const auto at = std::ranges::max_element(ping.intensity) - ping.intensity.begin();
    const SonarConfig& sonar = scenario.sonars[0];
    return {sonar.bin_range(static_cast<int>(at / ping.beam_count)),
            sonar.beam_azimuth(static_cast<int>(at % ping.beam_count)) / kDegree};
  }
};

TEST_F(MotionInPingTest, StandingStillChangesNothing) {
  Scenario scenario = scenario_of({0, 0, 0}, 0);
  const Ping moved = ping_of(scenario, plate_at(40, 4, diffuse(-10)));
  scenario.motion_in_ping = false;
  EXPECT_EQ(ping_of(scenario, plate_at(40, 4, diffuse(-10))).intensity, moved.intensity);
}

// The range is r - (v . d) r / c: the path back is shorter by the approach during the travel time.
TEST_F(MotionInPingTest, ApproachShortensTheRange) {
  for (const Vec3& velocity : {Vec3(3, 0, 0), Vec3(-2, 0, 0), Vec3(0, 4, 0)}) {
    const double nearer = velocity.dot(Vec3(std::cos(10 * kDegree), std::sin(10 * kDegree), 0)) * kRange / kSoundSpeed;
    EXPECT_NEAR(peak(scenario_of(velocity, 0)).first, kRange - nearer, 0.0026) << velocity.transpose();
  }
}

// The beams have turned by w t when the echo arrives.
TEST_F(MotionInPingTest, TurningShiftsTheBearing) {
  for (const double rate : {30.0, -45.0}) {
    const double turned = rate * 2 * kRange / kSoundSpeed;
    EXPECT_NEAR(peak(scenario_of({0, 0, 0}, rate * kDegree)).second, 10 - turned, 0.12) << rate;
  }
}

// A point at 29.4 degrees that the fan, which ends at 30, leaves behind by turning 2.4 degrees to starboard: the
// outermost beam still hears it by its side lobes, as sinc^2 of (D / wavelength) (sin(31.8) - sin(beam)). Without an
// array, no beam does.
TEST_F(MotionInPingTest, PointsThatLeaveTheFanAreHeardBesideIt) {
  const auto at_bearing = [](double degrees, double turn_rate, BeamPattern pattern = BeamPattern::kRectangular) {
    Scenario scenario = scenario_of({0, 0, 0}, turn_rate);
    scenario.sonars[0].azimuth_resolution = 1 * kDegree;
    scenario.receiver.azimuth_pattern = pattern;
    scenario.points[0].position = kRange * Vec3(std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0);
    return cell_db(ping_of(scenario, {}), 400, 0);
  };
  const double beam = 30 - 30.0 / 512, pi = std::acos(-1.0), lines = 0.8858929413781328 / (2 * std::sin(0.5 * kDegree));
  const double x = pi * lines * (std::sin(31.8 * kDegree) - std::sin(beam * kDegree));
  EXPECT_NEAR(at_bearing(29.4, -45 * kDegree), at_bearing(beam, 0) + 20 * std::log10(std::abs(std::sin(x) / x)), 0.1);
  EXPECT_EQ(at_bearing(29.4, -45 * kDegree, BeamPattern::kTopHat), -std::numeric_limits<double>::infinity());
}

// A sonar that moves across has passed by u t, t = 2 r / c, when the echo arrives: it appears behind by 2 u / c, at
// every range. From the positions at transmission and at reception, without that formula.
TEST_F(MotionInPingTest, MovingAcrossShiftsTheBearing) {
  const Vec3 point = kRange * Vec3(std::cos(10 * kDegree), std::sin(10 * kDegree), 0);
  for (const Vec3& velocity : {Vec3(0, 9, 0), Vec3(0, -14, 0), Vec3(-12, 6, 0), Vec3(18, 0, 0)}) {
    const Vec3 way = point - velocity * (2 * kRange / kSoundSpeed);
    const double expected = std::atan2(way.y(), way.x()) / kDegree;
    EXPECT_GT(std::abs(expected - 10), 0.2);
    EXPECT_NEAR(peak(scenario_of(velocity, 0)).second, expected, 0.07)  // Half a beam, and the square of v / c.
        << velocity.transpose();
  }
}

// The same for surfaces, for a fan that looks down, whose bearings are those of level distances, and while it turns.
TEST_F(MotionInPingTest, SurfacesAppearBehindASonarThatMovesAcross) {
  constexpr double kDown = 35 * kDegree;
  Scenario scenario = scenario_of({0, 12, 0}, -20 * kDegree);
  scenario.points.clear();
  SonarConfig& sonar = scenario.sonars[0];
  sonar.elevation_center = -kDown;
  sonar.elevation_aperture = 8 * kDegree;
  const Vec3 middle = 40 * Vec3(std::cos(kDown), 0, -std::sin(kDown));
  Scene scene = plate_at(40, 0.3, diffuse(-10));
  scene.instances[0].world_from_mesh.position = middle;
  scene.instances[0].world_from_mesh.orientation = orientation_from_rpy(0, kDown, 0);
  const double t = 2 * 40 / kSoundSpeed;
  const Vec3 way = middle - Vec3(0, 12, 0) * t;
  EXPECT_NEAR(peak(scenario, scene).second, std::atan2(way.y(), way.x()) / kDegree + 20 * t, 0.3);  // Half the plate.
}

// With a rising chirp, the Doppler shift f = 2 v f0 / c shortens the measured range by f T c / (2 B) (Cook and
// Bernfeld, Radar Signals (1967); docs/concepts/motion-in-ping.md).
TEST_F(MotionInPingTest, ChirpsHaveADopplerBias) {
  Scenario scenario = scenario_of({3, 0, 0}, 0);
  scenario.receiver.pulse = PulseKind::kLfm;
  scenario.receiver.pulse_duration = 1e-3;
  scenario.receiver.pulse_bandwidth = 50e3;
  const double speed = 3 * std::cos(10 * kDegree);
  const double shift = 2 * speed * scenario.sonars[0].frequency / kSoundSpeed;
  const double bias = shift * 1e-3 * kSoundSpeed / (2 * 50e3);
  EXPECT_GT(bias, 0.04);
  EXPECT_NEAR(peak(scenario).first, kRange * (1 - speed / kSoundSpeed) - bias, 0.004);
}

// Echoes of surfaces are shifted as those of points, with their labels and energy.
TEST_F(MotionInPingTest, SurfacesKeepTheirEnergyAndLabels) {
  Scenario scenario = scenario_of({2, 0, 0}, -30 * kDegree);
  scenario.points.clear();
  scenario.ground_truth = GroundTruth::kFull;
  const Scene plate = plate_at(40, 0.5, diffuse(-10));
  const Ping moved = ping_of(scenario, plate);
  scenario.motion_in_ping = false;
  const Ping still = ping_of(scenario, plate);
  EXPECT_NEAR(total_db(moved), total_db(still), 0.05);
  const auto [range, bearing] = [&] {
    scenario.motion_in_ping = true;
    return peak(scenario, plate);
  }();
  EXPECT_NEAR(range, 40 * (1 - 2 / kSoundSpeed), 0.004);
  EXPECT_NEAR(bearing, 30 * 2 * 40 / kSoundSpeed, 0.4);
  for (std::size_t i = 0; i < moved.intensity.size(); ++i) {
    EXPECT_EQ(moved.intensity[i] > 0, moved.instance[i] == 0);
    EXPECT_EQ(moved.intensity[i] > 0, moved.path_order[i] == 1);
  }
}

// Steady motion given as a twist, and as a trajectory.
TEST_F(MotionInPingTest, TwistFromOutsideGivesThePingOfTheTrajectoryOfThatSpeed) {
  for (const auto& [velocity, turn_rate] :
       {std::pair(Vec3(3, 0, 0), 0.0), std::pair(Vec3(-1, 2, 0.5), 30.0), std::pair(Vec3(0, 0, 0), -45.0)}) {
    SCOPED_TRACE(velocity.transpose());
    Scenario scenario = scenario_of(velocity, turn_rate * kDegree);
    scenario.sonars[0].position = {0.4, -0.3, 0.2};
    scenario.receiver.speckle = true;
    scenario.receiver.noise = true;
    scenario.ground_truth = GroundTruth::kFull;
    const Scene plate = plate_at(40, 3, diffuse(-10));
    const Ping expected = ping_of(scenario, plate);
    const Pose start = scenario.trajectory.at(0);
    scenario.trajectory = {};
    Simulator simulator(scenario, plate, 2);
    const Twist twist{.linear = velocity, .angular = {0, 0, turn_rate * kDegree}};
    expect_same(simulator.ping(0, {.world_from_vehicle = start, .twist = twist}), expected);
    EXPECT_NE(simulator.ping(0, {.world_from_vehicle = start}).intensity, expected.intensity);
  }
}

TEST_F(MotionInPingTest, TwistsBeyondAHundredMetresASecondAreRefused) {
  Simulator simulator(scenario_of({0, 0, 0}, 0), {}, 1);
  EXPECT_EQ(message_of([&] {
              (void)simulator.ping(0, {.number = 2, .twist = {.linear = {99, 99, 0}}});
            }),
            "ping 2 of sonar: twist.linear comes to 140 m/s; with motion_in_ping at most 100 m/s");
}

TEST_F(MotionInPingTest, WithoutItATwistHasNoEffect) {
  Scenario scenario = scenario_of({0, 0, 0}, 0);
  scenario.motion_in_ping = false;
  Simulator simulator(scenario, plate_at(40, 4, diffuse(-10)), 1);
  expect_same(simulator.ping(0, {.twist = {.linear = {3, 0, 0}}}), simulator.ping(0, {}));
}

TEST(PingMotionTest, IsTheVelocityBetweenTwoPoses) {
  const Pose first{{1, 2, 3}, orientation_from_rpy(0, 0, 90 * kDegree)};
  const Pose last{{1, 3, 3}, orientation_from_rpy(0, 0, 80 * kDegree)};
  const PingMotion motion = motion_between(first, last, 0.5);
  EXPECT_LT((motion.velocity - Vec3(2, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(motion.turn_rate, -20 * kDegree, 1e-12);
  EXPECT_EQ(motion_between(first, first, 0.5).turn_rate, 0);
}

}  // namespace
}  // namespace insonify::validation::motion_test
