// engine_geometry_test.cpp -- ranges and bearings of surfaces that can be computed by hand, on every engine. T numbers
// are those of docs/concepts/physics-tests.md.

#include "engines/test_scenes.h"
#include "support/shadow_sonar.h"

namespace insonify::engine_geometry_test {
namespace {

using namespace testing_scenes;

// Positions of echoes do not depend on the model; in the calibrated one these surfaces scatter by Lambert's law.
class EngineGeometryTest : public testing::TestWithParam<EngineAndModel> {
 protected:
  EchoGrid echoes(const Scene& scene, const SonarConfig& sonar, const Pose& pose = {},
                  SecondaryEchoes secondary = SecondaryEchoes::kNone) const {
    const Scene diffuse = without_glints(scene);
    return echoes_of(GetParam().engine, diffuse,
                     {.sonar = sonar,
                      .water = {.absorption = false},
                      .model = GetParam().model,
                      .materials = diffuse.materials,
                      .secondary = secondary},
                     pose);
  }
};

// The return leg from the second surface in the paper model; for the calibrated model see
// validation/multipath_test.cpp.
class ReturnLegTest : public EngineGeometryTest {};

SonarConfig wall_sonar() {
  SonarConfig sonar;
  sonar.beam_count = 128;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 2 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 60;
  sonar.bin_count = 1200;  // 0.05 m.
  sonar.sampling = {.columns_per_beam = 4, .rows = 12};
  return sonar;
}

// T1. A wall x = d is met at d / cos(azimuth): the echo of a beam fills exactly the bins between its two edges. Two
// degrees of elevation add less than 0.02 %.
TEST_P(EngineGeometryTest, WallLiesAtItsSlantRangeInEveryBeam) {
  for (const double distance : {3.217, 10.01, 24.983}) {
    const SceneMaker maker = SceneMaker().add_wall(distance);
    const SonarConfig sonar = wall_sonar();
    const EchoGrid grid = echoes(maker.scene(), sonar);
    const std::vector<double> edges = sonar.bearings().edges();
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      const double a = distance / std::cos(edges[beam]);
      const double b = distance / std::cos(edges[beam + 1]);
      const auto energy = grid.energy(1, beam);
      int first = -1, last = -1;
      for (int bin = 0; bin < sonar.bin_count; ++bin) {
        if (energy[bin] > 0) {
          first = first < 0 ? bin : first;
          last = bin;
        }
      }
      // Half a bin either way: the bins of the near and the far edge hold the ends.
      const double near_bin = std::min(a, b) / sonar.bin_length();
      const double far_bin = std::max(a, b) / std::cos(1 * kDegree) / sonar.bin_length();
      ASSERT_GE(first + 1, near_bin - 0.5) << "beam " << beam << " at " << distance;
      ASSERT_LE(first, near_bin + 0.5) << "beam " << beam << " at " << distance;
      ASSERT_LE(last, far_bin + 0.5) << "beam " << beam << " at " << distance;
      ASSERT_GE(last + 1, far_bin - 0.5) << "beam " << beam << " at " << distance;
      // Mean of d / cos over the slice, by Simpson's rule: exact to 1e-6 of a bin here.
      const double middle = distance / std::cos(0.5 * (edges[beam] + edges[beam + 1]));
      const double mean_bin = (a + 4 * middle + b) / 6 / sonar.bin_length();
      ASSERT_NEAR(centroid_bin(energy), mean_bin, 0.5) << "beam " << beam << " at " << distance;
    }
  }
}

// T8. A small sphere's echo is centred at its azimuth; beam centres are at F (1/2 - (i + 1/2) / N).
TEST_P(EngineGeometryTest, PointTargetsAppearAtTheirAzimuth) {
  SonarConfig sonar;
  sonar.beam_count = 256;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 2 * kDegree;
  sonar.max_range = 20;
  sonar.bin_count = 200;
  sonar.sampling = {.columns_per_beam = 8, .rows = 64};
  for (const double azimuth : {-50.0, -30.0, 0.0, 25.3, 50.0}) {
    const Vec3 centre = point_from_spherical({.range = 15, .azimuth = azimuth * kDegree, .elevation = 0});
    const EchoGrid grid = echoes(SceneMaker().add_sphere(centre, 0.02, 0.8, 0.3).scene(), sonar);
    double sum = 0, moment = 0;
    for (int beam = 0; beam < sonar.beam_count; ++beam) {
      for (const float energy : grid.energy(1, beam)) {
        sum += energy;
        moment += energy * sonar.beam_azimuth(beam) / kDegree;
      }
    }
    ASSERT_GT(sum, 0) << azimuth;
    EXPECT_NEAR(moment / sum, azimuth, 0.5 * 120.0 / 256) << azimuth;
  }
}

// T16. A plate 1 m high at x = 10 m, sonar 3 m above the bed: the top of the plate is at slant 10.198 m, its foot at
// 10.440 m, and its shadow ends at x h / (h - 1) = 15 m, slant 15.297 m.
TEST_P(EngineGeometryTest, ShadowReachesToWhereTheRayOverThePlateMeetsTheBed) {
  const SonarConfig sonar = shadow_sonar();
  const SceneMaker maker =
      SceneMaker().add_floor(-3).add("plate", make_box({0.01, 4, 1}), {.position = {10.005, 0, -2.5}});
  const EchoGrid grid = echoes(maker.scene(), sonar);
  const auto energy = grid.energy(1, 0);
  // From the plate's foot to the end of the shadow, less one bin and the curvature over the beam's width (r (1 / cos 1
  // deg - 1) = 2 mm).
  const int dark_from = static_cast<int>(10.4403 / sonar.bin_length()) + 2;
  const int dark_to = static_cast<int>(15.2971 / sonar.bin_length()) - 1;
  for (int bin = dark_from; bin <= dark_to; ++bin) {
    EXPECT_EQ(energy[bin], 0) << "bin " << bin;
  }
  EXPECT_GT(energy[dark_to + 3], 0);
  EXPECT_GT(energy[static_cast<int>(10.2 / sonar.bin_length())], 0);
}

// The lowest ray of a level sonar h above a flat floor meets it at the range h / sin(half aperture) at every azimuth:
// the near edge of the floor is an arc.
TEST_P(EngineGeometryTest, NearEdgeOfAFlatFloorIsAnArc) {
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 40;
  sonar.bin_count = 800;
  sonar.sampling = {.columns_per_beam = 2, .rows = 100};
  const EchoGrid grid = echoes(SceneMaker().add_floor(-2.5).scene(), sonar);
  const double near_edge = 2.5 / std::sin(10 * kDegree);  // 14.397 m.
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    const auto energy = grid.energy(1, beam);
    const auto first = std::find_if(energy.begin(), energy.end(), [](float e) { return e > 0; }) - energy.begin();
    EXPECT_EQ(first, static_cast<int>(near_edge / sonar.bin_length())) << "beam " << beam;
  }
}

// T10. Two walls at right angles, x = 8 and y = 6: the shortest double bounce has the range of their edge, 10.000 m at
// azimuth 36.870 degrees, and no secondary echo is nearer. Two walls of one mesh reflect each other as two meshes do.
TEST_P(ReturnLegTest, DoubleBounceOfAVerticalDihedralStartsAtItsEdge) {
  SonarConfig sonar;
  sonar.beam_count = 128;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 15;
  sonar.bin_count = 600;
  sonar.sampling = {.columns_per_beam = 4, .rows = 24};
  const Pose front{.position = {8, 6 - 20, 0}}, side{.position = {8 - 20, 6, 0}};
  const Scene two_meshes = SceneMaker()
                               .add("front", make_plane(Vec3::UnitX(), 40, 40), front)
                               .add("side", make_plane(Vec3::UnitY(), 40, 40), side)
                               .scene();
  Mesh corner;
  corner.vertices = {{8, -34, -20}, {8, 6, -20}, {8, 6, 20}, {8, -34, 20}, {-32, 6, -20}, {-32, 6, 20}};
  corner.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  static_cast<void>(clean_mesh(corner));
  const Scene one_mesh = SceneMaker().add("corner", std::move(corner)).scene();
  for (const Scene* scene : {&two_meshes, &one_mesh}) {
    for (const double aperture : {6.0, 44.0}) {
      sonar.elevation_aperture = aperture * kDegree;
      const EchoGrid grid = echoes(*scene, sonar, {}, SecondaryEchoes::kAll);
      int first = sonar.bin_count;
      for (int beam = 0; beam < sonar.beam_count; ++beam) {
        for (int bin = 0; bin < first; ++bin) {
          if (grid.weight(2, beam)[bin] > 0) {
            first = bin;
          }
        }
      }
      ASSERT_LT(first, sonar.bin_count);
      EXPECT_NEAR((first + 0.5) * sonar.bin_length(), 10.0, sonar.bin_length()) << aperture;
      // A ray at the angle delta from the edge has the range d cos(delta): the first bin of 0.025 m contains bearings
      // within 4 degrees of the edge.
      double sum = 0, moment = 0;
      for (int beam = 0; beam < sonar.beam_count; ++beam) {
        sum += grid.weight(2, beam)[first];
        moment += grid.weight(2, beam)[first] * sonar.beam_azimuth(beam) / kDegree;
      }
      EXPECT_NEAR(moment / sum, 36.870, 120.0 / 128) << aperture;
      EXPECT_EQ(total(echoes(*scene, sonar), 2), 0);
    }
  }
}

// A wall between the second surface and the sonar blocks the return leg.
TEST_P(ReturnLegTest, ObstructedReturnLegGivesNoEcho) {
  // A mirror at 45 degrees at x = 5 sends a level ray to port, where a plate at y = 5 would send it back to the sonar
  // along a straight line through (2.5, 2.5).
  SonarConfig sonar;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 2 * kDegree;
  sonar.elevation_aperture = 2 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 15;
  sonar.bin_count = 300;
  sonar.sampling = {.columns_per_beam = 8, .rows = 16};
  const auto scene = [](bool blocked) {
    SceneMaker maker;
    maker.add("mirror", make_plane(Vec3(-1, 1, 0).normalized(), 1, 1), {.position = {5, 0, 0}});
    maker.add("plate", make_plane(Vec3::UnitY(), 1, 1), {.position = {5, 5, 0}});
    if (blocked) {
      maker.add("screen", make_plane(Vec3(1, 1, 0).normalized(), 1, 1), {.position = {2.5, 2.5, 0}});
    }
    return maker;
  };
  const EchoGrid open = echoes(scene(false).scene(), sonar, {}, SecondaryEchoes::kAll);
  // (5 + 5 + sqrt(50)) / 2 = 8.536 m.
  EXPECT_NEAR(centroid_bin(open.energy(2, 0)) * sonar.bin_length(), (10 + std::sqrt(50.0)) / 2, sonar.bin_length());
  EXPECT_EQ(total(echoes(scene(true).scene(), sonar, {}, SecondaryEchoes::kAll), 2), 0);
}

TEST_P(EngineGeometryTest, EchoesNearerThanTheFirstBinAreDropped) {
  SonarConfig sonar = wall_sonar();
  sonar.min_range = 4;
  const EchoGrid grid = echoes(SceneMaker().add_wall(3.217).scene(), sonar);
  const int ahead = sonar.beam_count / 2;
  EXPECT_TRUE(std::ranges::all_of(grid.energy(1, ahead), [](float e) { return e == 0; }));
}

// A wall straight ahead, sampled by two rows symmetric about the axis: both have the same range, so that footprints
// have zero length in range. With thousands of bins single precision has few digits left within a bin.
TEST_P(EngineGeometryTest, EchoesOfZeroLengthAreWholeInEveryBin) {
  SonarConfig sonar;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = 1 * kDegree;
  sonar.elevation_aperture = 10 * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 20;
  sonar.sampling = {.columns_per_beam = 1, .rows = 2};
  const SceneMaker maker = SceneMaker().add_wall(19.42);
  double expected = 0;
  for (const int bins : {100, 2000, 16000}) {
    sonar.bin_count = bins;
    const EchoGrid grid = echoes(maker.scene(), sonar);
    double sum = 0, weight = 0;
    for (int bin = 0; bin < bins; ++bin) {
      sum += grid.energy(1, 0)[bin];
      weight += grid.weight(1, 0)[bin];
    }
    expected = expected == 0 ? sum : expected;
    EXPECT_GT(sum, 0) << bins;
    EXPECT_NEAR(sum / expected, 1, 1e-4) << bins;
    EXPECT_NEAR(weight / (sonar.azimuth_aperture * 2 * std::sin(0.5 * sonar.elevation_aperture)), 1, 1e-4) << bins;
  }
  // The same with the wall nearer than the first bin.
  sonar.min_range = 19.9;
  sonar.bin_count = 500;
  const EchoGrid before = echoes(maker.scene(), sonar);
  EXPECT_EQ(total(before, 1), 0);
}

TEST_P(EngineGeometryTest, EmptyWaterGivesNothing) {
  const EchoGrid grid = echoes(Scene{}, wall_sonar(), {}, SecondaryEchoes::kAll);
  EXPECT_EQ(total(grid, 1), 0);
  EXPECT_EQ(total(grid, 2), 0);
  EXPECT_EQ(grid.label(3, 10).instance, kNoLabel);
}

// Every part of the aperture is deposited exactly once: the weights of a wall that fills it sum to its solid angle,
// azimuth aperture x 2 sin(half the elevation aperture).
TEST_P(EngineGeometryTest, WeightsAddUpToTheSolidAngle) {
  const SonarConfig sonar = wall_sonar();
  const EchoGrid grid = echoes(SceneMaker().add_wall(10.01).scene(), sonar);
  double sum = 0;
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    for (const float weight : grid.weight(1, beam)) {
      sum += weight;
    }
  }
  const double solid_angle = sonar.azimuth_aperture * 2 * std::sin(sonar.elevation_aperture / 2);
  EXPECT_NEAR(sum, solid_angle, 1e-5 * solid_angle);  // Single-precision sums.
}

std::vector<EngineAndModel> paper_engines() {
  std::vector<EngineAndModel> engines = engines_and_models();
  std::erase_if(engines, [](const EngineAndModel& on) { return on.model != EchoModel::kPaper; });
  return engines;
}

constexpr auto kName = [](const auto& test) { return test.param.name; };
INSTANTIATE_TEST_SUITE_P(Engines, EngineGeometryTest, testing::ValuesIn(engines_and_models()), kName);
INSTANTIATE_TEST_SUITE_P(Engines, ReturnLegTest, testing::ValuesIn(paper_engines()), kName);

}  // namespace
}  // namespace insonify::engine_geometry_test
