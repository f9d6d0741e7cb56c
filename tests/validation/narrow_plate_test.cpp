// narrow_plate_test.cpp -- plates up to a few columns wide, turned towards the sonar by their edge, at the default
// sampling: the level of every single ping. Columns are 0.234 degrees apart: 57 mm at 14 m, 0.16 m at 40 m.

#include <fmt/format.h>

#include "validation/small_targets.h"

namespace insonify::validation::narrow_plate_test {
namespace {

constexpr double kLambertDb = -25;

SonarConfig default_sonar(double max_range) {
  SonarConfig sonar;
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 15 * kDegree;
  sonar.elevation_aperture = 6 * kDegree;
  sonar.min_range = 1;
  sonar.max_range = max_range;
  sonar.bin_count = 1000;
  return sonar;
}

// Over 0.74 m, of which each step is another place among the columns.
Vec3 offset_of(int place) {
  return {0, 0.031 * (place - 12), 0.013 * (place * 7 % kPlaces - 12)};
}

struct Plate {
  double distance, columns, height;
  [[nodiscard]] double width() const { return distance * columns * 15.0 / 64 * kDegree; }
};
constexpr std::array kPlates{Plate{8, 0.3, 0.3}, Plate{8, 1, 0.3},  Plate{14, 1, 0.06},
                             Plate{14, 2, 0.3},  Plate{25, 3, 0.3}, Plate{40, 0.5, 1.2},
                             Plate{40, 1, 0.3},  Plate{40, 2, 1.2}, Plate{60, 2.4, 0.3}};

// A plate of some thickness, turned about the vertical axis, with Lambert's backscatter.
struct TurnedPlate {
  Plate plate;
  double thickness, degrees;

  [[nodiscard]] Pose pose() const { return {{plate.distance, 0, 0}, orientation_from_rpy(0, 0, degrees * kDegree)}; }
  [[nodiscard]] Mesh mesh() const {
    return thickness > 0 ? make_box({thickness, plate.width(), plate.height})
                         : make_plane(-Vec3::UnitX(), plate.height, plate.width());
  }
  // The sum of mu A cos^2 / r^4 over the two faces that the sonar sees.
  [[nodiscard]] double intensity_from(const Vec3& sonar) const {
    const Vec3 path = pose().position - sonar, seen = pose().orientation.conjugate() * path.normalized();
    const double areas = plate.height * (plate.width() * seen.x() * seen.x() + thickness * seen.y() * seen.y());
    return std::pow(10, kLambertDb / 10) * areas / std::pow(path.norm(), 4);
  }
};

// Level of every ping within 0.3 dB.
// @param factor  On the sum of all bins.
void expect_level(Simulator& simulator, const TurnedPlate& plate, PingRequest request, double factor = 1) {
  double least = 1e300, most = -1e300;
  Ping ping;
  for (int place = 0; place < kPlaces; ++place) {
    request.world_from_vehicle.position = offset_of(place);
    simulator.ping(0, request, ping);
    const double difference = 10 * std::log10(whole(ping) / (factor * plate.intensity_from(offset_of(place))));
    least = std::min(least, difference);
    most = std::max(most, difference);
  }
  const std::string what = fmt::format("{} columns at {} m, {} m thick, {} degrees", plate.plate.columns,
                                       plate.plate.distance, plate.thickness, plate.degrees);
  EXPECT_GE(least, -0.3) << what;
  EXPECT_LE(most, 0.3) << what;
}

class NarrowPlateTest : public testing::TestWithParam<Method> {
 protected:
  static void expect_levels(double thickness, std::initializer_list<double> turns) {
    for (const Plate& plate : kPlates) {
      for (const double degrees : turns) {
        const TurnedPlate turned{plate, thickness, degrees};
        Simulator simulator(calibrated(default_sonar(plate.distance + 5), GetParam()),
                            scene_of(turned.mesh(), diffuse(kLambertDb), turned.pose()), 2);
        expect_level(simulator, turned, {});
      }
    }
  }
};

TEST_P(NarrowPlateTest, SheetsHaveTheirLevelInEveryPing) {
  expect_levels(0, {0, 40, 71, 80, -109});
}

TEST_P(NarrowPlateTest, PlatesHaveTheirLevelInEveryPing) {
  expect_levels(0.01, {60, 71, 120});
}

// In bins of 0.45 m, and with a tone of 200 us, 100 mm long after its filter, in bins of 45 mm: the sum over bins is
// greater by its length in bins. Then the plate that another one was moved to.
TEST_P(NarrowPlateTest, CoarseBinsPulsesAndMotionKeepTheLevel) {
  const TurnedPlate here{{40, 1, 0.3}, 0.01, 71}, there{{34, 40 / 34.0, 0.3}, 0.01, 75};  // The same plate.
  for (const auto& [bins, pulse] : {std::pair{100, PulseKind::kNone}, std::pair{1000, PulseKind::kCw}}) {
    SonarConfig sonar = default_sonar(46);
    sonar.bin_count = bins;
    Scenario scenario = calibrated(sonar, GetParam());
    scenario.water.sound_speed = 1500;
    scenario.receiver.pulse = pulse;
    scenario.receiver.pulse_duration = 200e-6;
    const double factor = pulse == PulseKind::kNone ? 1 : 1500 * 200e-6 / 3 / 0.045;
    Scene scene = scene_of(here.mesh(), diffuse(kLambertDb), here.pose());
    scene.instances[0].moving = true;
    Simulator simulator(scenario, scene, 2);
    expect_level(simulator, here, {}, factor);
    expect_level(simulator, there, {.moved = {{.name = "diffuse", .world_from_object = there.pose()}}}, factor);
  }
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, NarrowPlateTest, testing::Values(kRays, kRaster), kName);

}  // namespace
}  // namespace insonify::validation::narrow_plate_test
