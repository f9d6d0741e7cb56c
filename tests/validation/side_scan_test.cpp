// side_scan_test.cpp -- pings of side-scan sonars against closed forms and quadratures: level of the bed against
// grazing angle, first return, width of a point along the track, shadow of a post, motion while a ping lasts.

#include <numeric>

#include "insonify/error.h"
#include "support/same_pings.h"
#include "validation/decibels.h"
#include "validation/pi.h"
#include "validation/side_scan_scene.h"

namespace insonify::validation::side_scan_test {
namespace {

constexpr Method kMethods[] = {kRays, kReference};

class SideScanTest : public testing::TestWithParam<Method> {};

TEST_P(SideScanTest, LevelOfTheBedFollowsTheGrazingAngle) {
  const SonarConfig sonar = side_scan();
  const Ping ping = ping_over(calibrated(sonar, GetParam()), seabed_at(-kAltitude, diffuse(-23)), Vec3::Zero());
  ASSERT_EQ(ping.beam_count, 2);
  const auto top_hat = [&](double below) { return std::abs(below - 33 * kDegree) <= 25 * kDegree ? 1.0 : 0.0; };
  for (const int bin : {95, 120, 170, 233, 301, 390}) {
    const double level = bed_level(0.1 * bin, 0.1 * (bin + 1), kAltitude, -23, sonar.azimuth_aperture, top_hat);
    EXPECT_NEAR(cell_db(ping, bin, 0), level, 0.2) << bin;
    EXPECT_NEAR(cell_db(ping, bin, 1), level, 0.2) << bin;
    EXPECT_NEAR(ping.elevation[ping.index(bin, 1)], -std::asin(kAltitude / (0.1 * bin + 0.05)), 0.3 * kDegree) << bin;
  }
  // Top hats end at 58 and 8 degrees below horizontal.
  for (const int bin : {50, 72, 84}) {
    EXPECT_EQ(ping.intensity[ping.index(bin, 0)], 0) << bin;
  }
}

// sinc^4 along the track has an equivalent beam of 2/3 wavelength / D; a beam of width w has D = .88589 wavelength / w.
TEST_P(SideScanTest, ArraysHaveTheirLobesOnBothWays) {
  SonarConfig sonar = side_scan();
  sonar.elevation_pattern = BeamPattern::kRectangular;
  Scenario scenario = calibrated(sonar, GetParam());
  scenario.receiver.azimuth_pattern = BeamPattern::kRectangular;
  const Ping ping = ping_over(scenario, seabed_at(-kAltitude, diffuse(-23)), Vec3::Zero());
  const double length =
      0.8858929413781328 / (2 * std::sin(25 * kDegree));  // [wavelengths]: sinc^2 halves at 25 degrees.
  const auto lobes = [&](double below) {
    const double u = kPi * length * std::sin(below - 33 * kDegree);
    return std::pow(std::abs(u) < 1e-9 ? 1 : std::sin(u) / u, 4);
  };
  const double equivalent = 2.0 / 3 * 2 * std::sin(0.4 * kDegree) / 0.8858929413781328;
  for (const int bin : {80, 95, 120, 170, 233, 301, 390}) {
    const double level = bed_level(0.1 * bin, 0.1 * (bin + 1), kAltitude, -23, equivalent, lobes);
    EXPECT_NEAR(cell_db(ping, bin, 0), level, 0.3) << bin;
    EXPECT_NEAR(cell_db(ping, bin, 1), level, 0.3) << bin;
  }
  // The bed is first met straight down, 57 degrees off the axis.
  const int first = static_cast<int>(kAltitude / 0.1);
  EXPECT_EQ(ping.intensity[ping.index(first - 1, 0)], 0);
  EXPECT_GT(cell_db(ping, first, 0), bed_level(7.3, 7.4, kAltitude, -23, equivalent, lobes) - 1);
}

TEST_P(SideScanTest, RollTurnsPortUpAndStarboardDown) {
  const Scenario scenario = calibrated(side_scan(), GetParam());
  const Ping ping = ping_over(scenario, seabed_at(-kAltitude, diffuse(-23)), Vec3::Zero(), 0, {9 * kDegree, 0, 0});
  // Port from 17 degrees above horizontal (-33 + 25 + 9 = 1) to 49 below, starboard from 17 to 67 below.
  const auto first_of = [&](int beam) {
    int bin = 0;
    while (ping.intensity[ping.index(bin, beam)] == 0) {
      ++bin;
    }
    return bin;
  };
  EXPECT_NEAR(first_of(0), kAltitude / std::sin(49 * kDegree) / 0.1, 1);
  EXPECT_NEAR(first_of(1), kAltitude / std::sin(67 * kDegree) / 0.1, 1);
  EXPECT_EQ(ping.intensity[ping.index(260, 1)], 0);  // 7.3 / sin 17 degrees = 24.97 m.
  EXPECT_GT(ping.intensity[ping.index(260, 0)], 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, SideScanTest, testing::ValuesIn(kMethods),
                         [](const auto& info) { return info.param.name; });

// A point passes through the beam: two-way, the width at half power is .6378 wavelength / D times its range.
TEST(SideScanPointTest, IsAsWideAlongTheTrackAsTheBeamIsThere) {
  for (const double range : {9.37, 21.4, 38.86}) {
    Scenario scenario = with_lines();
    scenario.points = {{.position = {0, -range * std::cos(0.5), -range * std::sin(0.5)}, .target_strength_db = -20}};
    Simulator simulator(scenario, Scene{}, 2);
    const double width = range * 0.8 * kDegree * 0.6378333973704464 / 0.8858929413781328;
    const auto level_at = [&](double along) {
      PingRequest request;
      request.world_from_vehicle.position = {along, 0, 0};
      const Ping ping = simulator.ping(0, request);
      double sum = 0;
      for (int bin = 0; bin < ping.bin_count; ++bin) {
        sum += double{ping.intensity[ping.index(bin, 1)]};
        EXPECT_EQ(ping.intensity[ping.index(bin, 0)], 0);
      }
      return db(sum);
    };
    const double peak = level_at(0);
    EXPECT_NEAR(peak, -20 - 40 * std::log10(range), 0.1) << range;
    EXPECT_NEAR(level_at(width / 2) - peak, -3.01, 0.15) << range;
    EXPECT_NEAR(level_at(-width / 2) - peak, -3.01, 0.15) << range;
    EXPECT_NEAR(level_at(1.43 / 0.6378333973704464 * width) - peak, -26.52, 0.7) << range;  // First side lobe.
  }
}

// Sent from x and received at x + v t, the point is in the middle of both beams where it is abeam of x + v t / 2; with
// a turn of w to port, w t / 2 of bearing behind or ahead of that.
TEST(SideScanMotionTest, PointsAreSeenHalfwayBetweenTransmissionAndReception) {
  for (const double speed : {0.0, 2.7, -4.1}) {
    for (const double rate : {0.0, 0.03}) {
      constexpr double kAway = 38.86, kBelow = 0.5;  // Range [m], angle below the horizontal [rad].
      Scenario scenario = with_lines();
      scenario.motion_in_ping = true;
      scenario.points = {
          {.position = {0, -kAway * std::cos(kBelow), -kAway * std::sin(kBelow)}, .target_strength_db = -20}};
      Simulator simulator(scenario, Scene{}, 2);
      const auto energy_at = [&](double along) {
        PingRequest request;
        request.world_from_vehicle.position = {along, 0, 0};
        request.twist = {.linear = {speed, 0, 0}, .angular = {0, 0, rate}};
        const Ping ping = simulator.ping(0, request);
        double sum = 0;
        for (int bin = 0; bin < ping.bin_count; ++bin) {
          sum += double{ping.intensity[ping.index(bin, 1)]};
        }
        return sum;
      };
      const double width = kAway * 0.8 * kDegree * 0.6378333973704464 / 0.8858929413781328;  // [m]
      double sum = 0, moment = 0;
      for (double along = -1.2; along <= 1.2; along += 0.02) {
        sum += energy_at(along);
        moment += along * energy_at(along);
      }
      const double time = 2 * kAway / simulator.scenario().water.true_sound_speed();
      // Turned to port, the starboard beam points ahead: it sees the point from farther behind.
      const double expected = -speed * time / 2 - rate * time / 2 * kAway * std::cos(kBelow);
      EXPECT_NEAR(moment / sum, expected, 0.02 * width) << speed << " m/s, " << rate << " rad/s";
    }
  }
}

// The shadow of a post of height h at range R on a bed H below begins at R and is h R / (H - h) long on the ground.
TEST(SideScanShadowTest, IsAsLongAsThePostIsHigh) {
  constexpr double kGround = 16.2, kHeight = 1.7;
  Scenario scenario = calibrated(side_scan(), kRays);
  const Scene scene = scene_of_all(
      {seabed_at(-kAltitude, diffuse(-23)), scene_of(make_plane(-Vec3::UnitY(), 3, kHeight), diffuse(-23),
                                                     {.position = {0, kGround, kHeight / 2 - kAltitude}})});
  const Ping ping = ping_over(scenario, scene, Vec3::Zero());
  const double end = kGround + kHeight * kGround / (kAltitude - kHeight);
  const double begins = std::hypot(kGround, kAltitude), ends = std::hypot(end, kAltitude);
  const auto bin_of = [](double range) { return static_cast<int>(range / 0.1); };
  for (int bin = bin_of(begins) + 1; bin < bin_of(ends); ++bin) {
    EXPECT_EQ(ping.intensity[ping.index(bin, 0)], 0) << bin;
  }
  EXPECT_GT(ping.intensity[ping.index(bin_of(ends) + 1, 0)], 0);
  EXPECT_GT(ping.intensity[ping.index(bin_of(begins) - 1, 0)], 0);
  EXPECT_GT(ping.intensity[ping.index(bin_of(ends) - 5, 1)], 0);  // Starboard sees the bed.
}

TEST(SideScanPrimaryTest, ConesAreNotRasterised) {
  Scenario scenario = with_lines();
  scenario.primary = PrimaryEchoes::kRaster;
  try {
    scenario.validate();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("primary = raster does not draw the cones of sonars[0]"),
              std::string::npos)
        << error.what();
  }
  scenario.model = EchoModel::kPaper;
  scenario.engine = "cpu";
  EXPECT_NO_THROW(scenario.validate());
}

TEST(SideScanBatchTest, EqualsSinglePings) {
  Scenario scenario = with_lines();
  scenario.receiver.noise = scenario.receiver.speckle = true;
  scenario.sonars[0].crosstalk_db = -40;
  scenario.motion_in_ping = true;
  scenario.ground_truth = GroundTruth::kFull;
  SonarConfig fan = corner_sonar();
  fan.name = "fan";
  scenario.sonars.push_back(fan);
  Scene scene = seabed_at(-kAltitude, diffuse(-23));
  Simulator together(scenario, scene, 2), alone(scenario, scene, 1);
  std::vector<PingRequest> requests(7);
  std::vector<Ping> pings(14);
  std::vector<PingOrder> orders;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    requests[i].number = i;
    requests[i].time = 0.1 * static_cast<double>(i);
    requests[i].world_from_vehicle.position = {0.17 * static_cast<double>(i), 0.3, 0.2};
    requests[i].twist = {.linear = {1.7, 0.1, 0}, .angular = {0, 0, 0.05}};
    orders.push_back({0, &requests[i], &pings[2 * i]});
    orders.push_back({1, &requests[i], &pings[2 * i + 1]});
  }
  together.ping(orders);
  for (std::size_t i = 0; i < orders.size(); ++i) {
    expect_same(alone.ping(orders[i].sonar, *orders[i].request), pings[i]);
  }
}

}  // namespace
}  // namespace insonify::validation::side_scan_test
