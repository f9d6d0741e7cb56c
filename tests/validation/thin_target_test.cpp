// thin_target_test.cpp -- ropes, rods and nets thinner than the sample spacing, at the default sampling: the level of
// every single ping, wherever they lie among the samples, against closed formulas and integrals over their surface. All
// numbers were derived independently of this code.

#include "base/rotation_between.h"
#include "validation/small_targets.h"

namespace insonify::validation::thin_target_test {
namespace {

// A Gemini 720i: 256 beams over 120 degrees, 20 degrees in elevation, 0.117 degrees from column to column and 0.1 from
// row to row.
SonarConfig gemini(double max_range, int bins = 1000) {
  SonarConfig sonar;
  sonar.beam_count = 256;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = 0.5;
  sonar.max_range = max_range;
  sonar.bin_count = bins;
  sonar.sampling = {4, 200};
  return sonar;
}

// Part of it: +-7.5 and +-6 degrees.
SonarConfig small_sonar(double max_range, int bins = 1000) {
  SonarConfig sonar = gemini(max_range, bins);
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 15 * kDegree;
  sonar.elevation_aperture = 12 * kDegree;
  sonar.sampling = {4, 120};
  return sonar;
}

// Steps of 3 cm across, and of 3 cm along after every fifth.
Vec3 offset_of(int place) {
  return {0.03 * (place / 5 - 2), 0.03 * (place % 5 - 2), 0.011 * (place * 7 % kPlaces - 12)};
}

// Echo of the side of a rod by quadrature over its surface.
double rod_intensity(double radius, double length, const Vec3& middle, const Vec3& axis, double slope,
                     double lambert_db) {
  constexpr int kAround = 400, kAlong = 200;  // Five times as many each change the level by less than 1e-4 dB.
  const Vec3 one = axis.unitOrthogonal(), two = axis.cross(one);
  double sum = 0;
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2 * kPi * (i + 0.5) / kAround;
    const Vec3 normal = one * std::cos(angle) + two * std::sin(angle);
    for (int j = 0; j < kAlong; ++j) {
      const Vec3 place = middle + radius * normal + axis * (length * ((j + 0.5) / kAlong - 0.5));
      const double range = place.norm();
      sum += backscatter(-normal.dot(place) / range, slope, std::pow(10, lambert_db / 10)) / std::pow(range, 4);
    }
  }
  return sum * 2 * kPi / kAround * radius * length / kAlong;
}

// Echo of both flat ends of a rod.
double ends_intensity(double radius, double length, const Vec3& middle, const Vec3& axis, double slope,
                      double lambert_db) {
  double sum = 0;
  for (const double side : {-0.5, 0.5}) {
    const Vec3 place = middle + side * length * axis;
    const double cosine = -2 * side * axis.dot(place) / place.norm();
    sum += backscatter(cosine, slope, std::pow(10, lambert_db / 10)) / std::pow(place.norm(), 4);
  }
  return sum * kPi * radius * radius;
}

Material rope_material(double slope, double lambert_db) {
  Material material = glinting(kReflection, slope);
  material.lambert_db = lambert_db;
  return material;
}

Scene rod_at(double radius, double length, const Vec3& middle, const Vec3& axis, const Material& material) {
  return scene_of(make_cylinder(radius, length), material,
                  {.position = middle, .orientation = rotation_between(Vec3::UnitZ(), axis)});
}

class ThinTargetTest : public testing::TestWithParam<Method> {};
class ThinTargetEffectTest : public testing::TestWithParam<Method> {};

// The quadrature itself. Far from a cylinder much longer than the zone that reflects, geometrical optics has |R|^2 a /
// (4 (a + r) r^2) at the range r to its surface: principal radii a and infinity (Urick 1983, table 9.1, at any range).
TEST(ThinTargetQuadratureTest, HasTheLimitOfGeometricalOptics) {
  const double a = 0.006, r = 12 - a;
  EXPECT_NEAR(
      rod_intensity(a, 4, {12, 0, 0}, Vec3::UnitZ(), 0.02, -200) * std::pow(r, 4) / (0.81 * a * r * r / (4 * (a + r))),
      1, 0.003);
}

struct Rope {
  double diameter, length, distance, roll_deg, tilt_deg, slope, lambert_db;
};

// Upright, lying and aslant in the plane across the sound (roll), square to it and tilted towards it.
TEST_P(ThinTargetTest, RopesHaveTheirTargetStrengthInEveryPing) {
  const bool slow = std::string_view(GetParam().engine) == "reference";
  for (const Rope& rope :
       {Rope{0.012, 1, 12, 0, 0, 0.1, -20}, Rope{0.012, 1, 12, 90, 0, 0.1, -20}, Rope{0.006, 1, 12, 0, 0, 0.05, -25},
        Rope{0.02, 1, 12, 37, 0, 0.1, -20}, Rope{0.012, 1, 12, 0, 20, 0.2, -15}, Rope{0.02, 1, 12, 90, 30, 0.3, -15},
        Rope{0.012, 0.3, 4, 45, 0, 0.1, -20}, Rope{0.006, 0.3, 3, 90, 0, 0.1, -20}, Rope{0.02, 2, 40, 20, 0, 0.1, -20},
        Rope{0.012, 1, 12, 10, 1.5, 0.02, -40}, Rope{0.03, 0.5, 15, 0, 60, 0.1, -12}}) {
    if (slow && rope.roll_deg != 0) {
      continue;
    }
    const Vec3 axis = orientation_from_rpy(rope.roll_deg * kDegree, 0, 0) *
                      (orientation_from_rpy(0, rope.tilt_deg * kDegree, 0) * Vec3::UnitZ());
    const Scene scene =
        rod_at(rope.diameter / 2, rope.length, {rope.distance, 0, 0}, axis, rope_material(rope.slope, rope.lambert_db));
    const Levels levels =
        levels_of(calibrated(small_sonar(rope.distance + 3), GetParam()), scene, rope.distance, offset_of, whole);
    const auto of_rope = [&](auto intensity) {
      return intensity(rope.diameter / 2, rope.length, {rope.distance, 0, 0}, axis, rope.slope, rope.lambert_db);
    };
    const double expected = 10 * std::log10(of_rope(rod_intensity) + of_rope(ends_intensity));
    EXPECT_NEAR(levels.mean_db, expected, kMeanTolerance)
        << rope.diameter << " m at " << rope.distance << ", " << rope.roll_deg << " " << rope.tilt_deg;
    EXPECT_LE(levels.spread_db, kMostSpread)
        << rope.diameter << " m at " << rope.distance << ", " << rope.roll_deg << " " << rope.tilt_deg;
  }
}

// Rods 12 mm thick are silent at half the places if the lattice alone samples them; see the spread of all above.
const Vec3 kPlace(12, 0, 0);
Scene rope(const Vec3& axis = Vec3::UnitY(), double length = 1, double diameter = 0.012) {
  return rod_at(diameter / 2, length, kPlace, axis, rope_material(0.1, -20));
}
double rope_db(const Vec3& axis = Vec3::UnitY(), double length = 1, double diameter = 0.012) {
  return 10 * std::log10(rod_intensity(diameter / 2, length, kPlace, axis, 0.1, -20));
}

Scene black_plate(double x, double side, double y) {
  return scene_of(make_plane(-Vec3::UnitX(), side, side), diffuse(-200), {.position = {x, y, 0}});
}

TEST_P(ThinTargetTest, WallsHideThem) {
  const Scenario scenario = calibrated(small_sonar(15), GetParam());
  EXPECT_LT(total_db(ping_of(scenario, scene_of_all({rope(), black_plate(10, 2, 0)}))), rope_db() - 120);
  // The port half of it: the plate's edge is at y = 0.
  const Levels levels = levels_of(scenario, scene_of_all({rope(), black_plate(11.9, 1, 0.5)}), 12, offset_of, whole);
  EXPECT_NEAR(levels.mean_db, rope_db() - 10 * std::log10(2), kMeanTolerance);
  EXPECT_LE(levels.spread_db, kMostSpread);
}

// Black upright rods of 12 mm, 48 mm apart at half the distance, hide a fourth of a lying rope.
TEST_P(ThinTargetEffectTest, AreSeenThroughOthers) {
  std::vector<Scene> scenes = {rope()};
  for (int i = -12; i <= 12; ++i) {
    scenes.push_back(rod_at(0.006, 1, {6, 0.048 * i, 0}, Vec3::UnitZ(), diffuse(-200)));
  }
  const Levels levels =
      levels_of(calibrated(small_sonar(15), GetParam()), scene_of_all(std::move(scenes)), 12, offset_of, whole);
  EXPECT_NEAR(levels.mean_db, rope_db() + 10 * std::log10(0.75), kMeanTolerance);
  EXPECT_LE(levels.spread_db, kMostSpread);
}

TEST_P(ThinTargetEffectTest, MoveWithTheirObjects) {
  Scene scene = rope(Vec3::UnitY());
  scene.instances[0].moving = true;
  scene.instances[0].world_from_mesh.position = {3, 5, 2};
  Simulator simulator(calibrated(small_sonar(15), GetParam()), scene, 2);
  PingRequest request;
  request.moved = {
      {.instance = 0,
       .world_from_object = {.position = kPlace,
                             .orientation = rotation_between(Vec3::UnitZ(), Vec3(0.2, 1, 0.5).normalized())}}};
  EXPECT_NEAR(total_db(simulator.ping(0, request)), rope_db(Vec3(0.2, 1, 0.5).normalized()), kMeanTolerance);
  request.moved[0].world_from_object.position = {12, 20, 0};
  EXPECT_EQ(whole(simulator.ping(0, request)), 0);
}

// With absorption, and bins both longer and shorter than the rope is thick.
TEST_P(ThinTargetEffectTest, AreSteadyWhateverTheBins) {
  for (const int bins : {37, 3000}) {
    Scenario scenario = calibrated(small_sonar(15, bins), GetParam());
    scenario.water.absorption = true;  // 10 degC, 35 PSU, pH 8, 720 kHz: 0.223461 dB/m.
    scenario.sonars[0].frequency = 720e3;
    const Levels levels = levels_of(scenario, rope(), 12, offset_of, whole);
    EXPECT_NEAR(levels.mean_db, rope_db() - 2 * 0.223461 * 12, kMeanTolerance);
    EXPECT_LE(levels.spread_db, kMostSpread) << bins;
  }
}

// With an array in both directions, on wedges and cones, an upright rope is one line at its range and bearing: its
// loudest beam is steady. (Its loudest cell is not, for a line lies in one bin or between two.)
TEST_P(ThinTargetEffectTest, AreSteadyThroughAnArray) {
  for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
    Scenario scenario = calibrated(small_sonar(15), GetParam());
    scenario.receiver.azimuth_pattern = BeamPattern::kTaylor;
    scenario.receiver.elevation_pattern = BeamPattern::kTaylor;
    scenario.receiver.beam_shape = shape;
    scenario.primary = PrimaryEchoes::kRays;  // Cones and patterns in elevation have no raster.
    const Levels sum = levels_of(scenario, rope(Vec3::UnitZ(), 0.6), 12, offset_of, whole);
    EXPECT_LE(sum.spread_db, 1) << "The lobe is 1.2 m high at 12 m, and the places 0.25 m apart.";
    const Levels line = levels_of(scenario, rope(Vec3::UnitZ(), 0.6), 12, offset_of, [](const Ping& ping) {
      double most = 0;
      for (int beam = 0; beam < ping.beam_count; ++beam) {
        double of_beam = 0;
        for (int bin = 0; bin < ping.bin_count; ++bin) {
          of_beam += ping.intensity[ping.index(bin, beam)];
        }
        most = std::max(most, of_beam);
      }
      return most;
    });
    EXPECT_LE(line.spread_db, kMostSpread);  // 1.3 dB of it where the rope lies between two beams.
  }
}

// A horizontal rope is a line without gaps: every beam that it crosses has its share.
TEST_P(ThinTargetEffectTest, LinesHaveNoGaps) {
  const SonarConfig sonar = gemini(15);
  const Scenario scenario = calibrated(sonar, GetParam());
  Simulator simulator(scenario, rod_at(0.006, 2, {9, 0, 0.5}, Vec3::UnitY(), diffuse(-15)), 2);
  const Ping ping = simulator.make_ping(0, 0);
  // mu cos^2 over half of the section is pi a / 2 a unit of length; the beam is 0.46875 degrees wide.
  const double range = std::hypot(9, 0.5);
  const double expected = std::pow(10, -1.5) * kPi * 0.006 / 2 * (9 * 0.46875 * kDegree) / std::pow(range, 4);
  for (int beam = 123; beam <= 132; ++beam) {
    double sum = 0;
    for (int bin = 0; bin < ping.bin_count; ++bin) {
      sum += ping.intensity[ping.index(bin, beam)];
      if (ping.intensity[ping.index(bin, beam)] > 0) {
        EXPECT_EQ(ping.instance[ping.index(bin, beam)], 0);
        EXPECT_NEAR(ping.elevation[ping.index(bin, beam)], std::asin(0.5 / range), 0.002);
        EXPECT_NEAR(sonar.bin_range(bin), range - 0.006 * kPi / 4, 2 * sonar.bin_length());
      }
    }
    EXPECT_NEAR(10 * std::log10(sum / expected), 0, 0.6) << beam;
  }
}

// Over 200 seeds the mean of the intensity is known to 1 / sqrt(200) of a cell's; a line of 10 cells and more, better.
TEST_P(ThinTargetEffectTest, SpeckleKeepsTheMean) {
  Scenario scenario = calibrated(small_sonar(15), GetParam());
  scenario.receiver.speckle = true;
  double sum = 0;
  constexpr int kSeeds = 200;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    scenario.seed = static_cast<std::uint64_t>(seed);
    sum += whole(ping_of(scenario, rope()));
  }
  EXPECT_NEAR(10 * std::log10(sum / kSeeds), rope_db(), 0.8);
}

// A chain-link like net: rods of 6 mm crossing at right angles, 50 mm apart and aslant, each seen by itself.
TEST_P(ThinTargetEffectTest, NetsHaveTheEchoOfTheirStrands) {
  std::vector<Scene> scenes;
  double expected = 0;
  for (const double sign : {-1.0, 1.0}) {
    for (int i = -6; i <= 6; ++i) {
      const Vec3 axis = Vec3(0, 1, sign).normalized(),
                 middle = Vec3(10, 0, 0) + 0.05 * i * Vec3(0, -sign, 1).normalized();
      scenes.push_back(rod_at(0.003, 0.6, middle + 0.004 * sign * Vec3::UnitX(), axis, rope_material(0.2, -15)));
      expected += rod_intensity(0.003, 0.6, middle, axis, 0.2, -15);
    }
  }
  const Levels levels =
      levels_of(calibrated(small_sonar(13), GetParam()), scene_of_all(std::move(scenes)), 10, offset_of, whole);
  // Where strands cross, the one behind is hidden: 6 of 50 mm, of half the strands.
  EXPECT_NEAR(levels.mean_db, 10 * std::log10(expected * 0.94), kMeanTolerance);
  EXPECT_LE(levels.spread_db, 1);
}

TEST_P(ThinTargetEffectTest, DoNotDependOnThreads) {
  const Scenario scenario = calibrated(small_sonar(15), GetParam());
  const Scene scene = scene_of_all({rope(), black_plate(11.9, 1, 0.5), rope(Vec3(0.3, 1, 1).normalized())});
  const Ping one = Simulator(scenario, scene, 1).make_ping(0, 0), three = Simulator(scenario, scene, 3).make_ping(0, 0);
  EXPECT_EQ(one.intensity, three.intensity);
  EXPECT_EQ(one.instance, three.instance);
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Methods, ThinTargetTest, testing::Values(kReference, kRays, kRaster), kName);
INSTANTIATE_TEST_SUITE_P(Methods, ThinTargetEffectTest, testing::Values(kRays, kRaster), kName);

}  // namespace
}  // namespace insonify::validation::thin_target_test
