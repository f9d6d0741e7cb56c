// relief_echo_test.cpp -- effect of reliefs (slopes and reflectivity) on echoes, on every engine, rasterised and
// traced.

#include <cmath>
#include <numbers>

#include "engines/random_scene.h"

namespace insonify::relief_echo_test {
namespace {

using namespace testing_scenes;
using Vec2f = Eigen::Vector2f;

std::shared_ptr<const Relief> constant(const Vec2f& slope, float reflectivity = 1) {
  Relief relief;
  relief.slopes = {1, 1, {slope}};
  relief.reflectivity = {1, 1, {reflectivity}};
  return std::make_shared<const Relief>(relief);
}

void give(Scene& scene, int instance, std::shared_ptr<const Relief> relief) {
  scene.instances[instance].reliefs.assign(1, std::move(relief));
}

// An engine and its method for primary echoes.
struct Way {
  std::string engine;
  PrimaryEchoes primary;
};
std::vector<Way> ways() {
  std::vector<Way> all;
  for (const std::string_view name : usable_engines()) {
    all.push_back({std::string(name), PrimaryEchoes::kRays});
    if (engine_kind(name).draws_primaries) {
      all.push_back({std::string(name), PrimaryEchoes::kRaster});
    }
  }
  return all;
}
class ReliefEchoTest : public testing::TestWithParam<Way> {
 public:
  EchoGrid echoes(const Scene& scene, FlatPlanSettings settings, const Pose& pose = {}) {
    settings.primary = GetParam().primary;
    return echoes_of(GetParam().engine, scene, settings, pose);
  }
};
INSTANTIATE_TEST_SUITE_P(Engines, ReliefEchoTest, testing::ValuesIn(ways()), [](const auto& test) {
  return test.param.engine + (test.param.primary == PrimaryEchoes::kRaster ? "Raster" : "Rays");
});

// One narrow beam straight ahead, without absorption or sigmoid: the mean power of the echoes is |cos| x reflectivity.
FlatPlanSettings pencil() {
  FlatPlanSettings settings{.secondary = SecondaryEchoes::kNone};
  settings.sonar.beam_count = 1;
  settings.sonar.azimuth_aperture = settings.sonar.elevation_aperture = 0.2 * kDegree;
  settings.sonar.max_range = 10;
  settings.sonar.sampling = {2, 4};
  settings.water.absorption = false;
  settings.paper.sigmoid = Sigmoid::kNone;
  return settings;
}

double mean_power(const EchoGrid& grid) {
  double energy = 0, weight = 0;
  for (int bin = 0; bin < grid.bin_count(); ++bin) {
    energy += grid.energy(1, 0)[bin];
    weight += grid.weight(1, 0)[bin];
  }
  return energy / weight;
}

// A wall at 30 degrees of incidence, whose normal is tilted to either side by a slope of tan(20 degrees).
TEST_P(ReliefEchoTest, SlopesTiltTheNormal) {
  Scene scene =
      SceneMaker()
          .add("wall", make_plane(Vec3::UnitX(), 40, 40), {{5, 0, 0}, orientation_from_rpy(0, 0, 30 * kDegree)}, 0.8)
          .scene();
  const auto power = [&](const Vec2f& slope) {
    give(scene, 0, constant(slope));
    return mean_power(echoes(scene, pencil()));
  };
  const auto slope = static_cast<float>(std::tan(20 * kDegree));
  EXPECT_NEAR(power({0, 0}), 0.8 * std::cos(30 * kDegree), 1e-4);
  // The wall's normal is its x axis, and the right of its relief is its y axis, 30 degrees left of the world's. A
  // relief that rises to that side tilts the normal away from it.
  EXPECT_NEAR(power({slope, 0}), 0.8 * std::cos(10 * kDegree), 1e-4);
  EXPECT_NEAR(power({-slope, 0}), 0.8 * std::cos(50 * kDegree), 1e-4);
  EXPECT_NEAR(power({0, slope}), 0.8 * std::cos(30 * kDegree) * std::cos(20 * kDegree), 1e-4);
  // Tilted by more than the grazing angle, the surface faces away from the sonar.
  EXPECT_EQ(power({-static_cast<float>(std::tan(70 * kDegree)), 0}), 0);
}

TEST_P(ReliefEchoTest, PatchesReflectLess) {
  Scene scene = SceneMaker().add_wall(5).scene();
  give(scene, 0, constant({0, 0}, 0.25F));
  EXPECT_NEAR(mean_power(echoes(scene, pencil())), 0.2, 1e-4);
}

// A relief tilts the surface in the same direction on both sides of a triangle.
TEST_P(ReliefEchoTest, BothSidesOfATriangleHaveTheSameRelief) {
  const auto power = [&](bool turned, const Vec2f& slope) {
    Mesh mesh = make_plane(Vec3::UnitX(), 40, 40);
    if (turned) {
      for (auto& triangle : mesh.triangles) {
        std::swap(triangle[1], triangle[2]);
      }
      for (Vec3f& normal : mesh.normals) {
        normal = -normal;
      }
    }
    Scene scene = SceneMaker().add("wall", mesh, {{5, 0, 0}, orientation_from_rpy(0, 0, 30 * kDegree)}).scene();
    give(scene, 0, constant(slope));
    return mean_power(echoes(scene, pencil()));
  };
  // Heights are along the normal: a slope that rises on the front falls on the back.
  EXPECT_NEAR(power(false, {0.2F, 0}), power(true, {-0.2F, 0}), 1e-5);
}

// A relief without slopes changes nothing.
TEST_P(ReliefEchoTest, FlatReliefChangesNothing) {
  const RandomScene random(3);
  Scene flat = random.scene;
  for (std::size_t i = 0; i < flat.instances.size(); ++i) {
    give(flat, static_cast<int>(i), constant({0, 0}));
  }
  const FlatPlanSettings settings{.sonar = random.sonar, .secondary = SecondaryEchoes::kAll};
  const EchoGrid plain = echoes(random.scene, settings, random.pose), with = echoes(flat, settings, random.pose);
  EXPECT_LE(difference(plain, with, 1), 1e-5);
  EXPECT_LE(difference(plain, with, 2), 1e-4);
}

Relief bumpy(int seed) {
  Relief relief = make_relief({.roughness_height = 0.02, .relief_seed = static_cast<std::uint64_t>(seed)});
  relief.reflectivity = {2, 2, {1, 0.5F, 0.7F, 0.9F}};
  return relief;
}

// Gives every other object a relief; half of these are mapped by texture coordinates.
Scene roughened(const RandomScene& random, int seed) {
  Scene scene = random.scene;
  for (std::size_t i = 0; i < scene.instances.size(); i += 2) {
    Instance& instance = scene.instances[i];
    Relief relief = bumpy(seed);
    if (i % 4 == 0) {
      relief.by_position = false;
      Mesh mesh = *instance.mesh;
      for (const auto& triangle : mesh.triangles) {
        auto& corners = mesh.texture_coordinates.emplace_back();
        for (int k = 0; k < 3; ++k) {
          const Vec3f& vertex = mesh.vertices[triangle[k]];
          corners[k] = {0.5F * vertex.x() + 0.2F * vertex.z(), 0.4F * vertex.y() - 0.3F * vertex.z()};
        }
      }
      instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    }
    give(scene, static_cast<int>(i), std::make_shared<const Relief>(std::move(relief)));
  }
  return scene;
}

// Energy of each order in several scenes, and how much of it two engines have in other cells.
class Apart {
 public:
  void add(const EchoGrid& expected, const EchoGrid& found) {
    for (int order = 1; order <= kPathOrders; ++order) {
      shares_[order - 1].push_back(difference(expected, found, order));
      sum_[order - 1] += total(expected, order);
      apart_[order - 1] += total(expected, order) * shares_[order - 1].back();
    }
  }
  [[nodiscard]] double share(int order) const { return apart_[order - 1] / sum_[order - 1]; }

  // In the scene in the middle, and in the worst one.
  [[nodiscard]] double median_share(int order) const {
    std::vector<double> shares = shares_[order - 1];
    std::ranges::sort(shares);
    return shares[shares.size() / 2];
  }
  [[nodiscard]] double worst_share(int order) const { return std::ranges::max(shares_[order - 1]); }

 private:
  std::vector<double> shares_[kPathOrders];
  double apart_[kPathOrders] = {}, sum_[kPathOrders] = {};
};

// An engine with the scene, whose objects have moved.
std::unique_ptr<TestEngine> moved_engine(const std::string& name, const RandomScene& random, const Scene& scene) {
  std::unique_ptr<TestEngine> engine = test_engine(name, 2);
  engine->set_scene(scene);
  random.move_all([&](int instance, const Pose& pose) { engine->move_instance(instance, pose); });
  return engine;
}

// Rounding sometimes decides whether a tilted surface faces the sonar or whether a reflected ray passes an edge. The
// engines therefore agree in the sum over all scenes, but not in each scene.
TEST_P(ReliefEchoTest, AgreesWithTheReference) {
  Apart apart;
  for (int seed = 0; seed < 10; ++seed) {
    const RandomScene random(seed);
    const Scene scene = roughened(random, seed);
    const FlatPlanSettings settings{.sonar = random.sonar,
                                    .secondary = seed % 2 == 0 ? SecondaryEchoes::kAll : SecondaryEchoes::kSelective};
    FlatPlanSettings own = settings;
    own.primary = GetParam().primary;
    apart.add(echoes_of(*moved_engine("reference", random, scene), settings, random.pose),
              echoes_of(*moved_engine(GetParam().engine, random, scene), own, random.pose));
  }
  EXPECT_LE(apart.share(1), 1e-4);
  EXPECT_LE(apart.share(2), 4e-3);
}

// The same in the calibrated model, with facets and arrays; some scenes let sound through. Its lobes are so steep that
// one ray, which rounding turns, may hold some percent of the secondary energy: the typical scene is compared, and the
// worst one with wide limits.
TEST_P(ReliefEchoTest, CalibratedEchoesAgreeWithTheReference) {
  Apart apart;
  for (int seed = 0; seed < 16; ++seed) {
    const RandomScene random(seed);
    Scene scene = roughened(random, seed);
    if (seed / 2 % 2 == 1) {
      let_sound_through(scene);
    }
    const bool drawn = GetParam().primary == PrimaryEchoes::kRaster;  // Only wedges without arrays.
    const FlatPlanSettings settings{
        .sonar = random.sonar,
        .model = EchoModel::kCalibrated,
        .materials = scene.materials,
        .beam_shape = drawn || seed % 4 < 2 ? BeamShape::kWedge : BeamShape::kCone,
        .elevation_array = drawn || seed % 8 < 4 ? std::optional<ArraySettings>() : ArraySettings{},
        .secondary = seed % 2 == 0 ? SecondaryEchoes::kAll : SecondaryEchoes::kSelective,
        .rough_mirrors = seed % 3 == 0,
        .seed = static_cast<std::uint64_t>(seed)};
    FlatPlanSettings own = settings;
    own.primary = GetParam().primary;
    apart.add(echoes_of(*moved_engine("reference", random, scene), settings, random.pose),
              echoes_of(*moved_engine(GetParam().engine, random, scene), own, random.pose));
  }
  EXPECT_LE(apart.share(1), 1e-4);
  EXPECT_LE(apart.median_share(2), 1e-3);
  EXPECT_LE(apart.median_share(3), 5e-3);  // As in agreement.h.
  EXPECT_LE(apart.worst_share(2), 0.1);
  EXPECT_LE(apart.worst_share(3), 0.1);
}

// Rays of echo sources and of probes.
TEST_P(ReliefEchoTest, TracedRaysMeetTheReliefThatTheReferenceMeets) {
  double compared = 0, turned = 0, otherwise = 0;
  for (int seed = 0; seed < 10; ++seed) {
    const RandomScene random(seed);
    const Scene scene = roughened(random, seed);
    std::vector<Ray> rays;
    for (int i = 0; i < 400; ++i) {
      const Vec3 direction = point_from_spherical({1, 0.05 * (i % 20 - 9.5), 0.03 * (i / 20 - 9.5)});
      rays.push_back({random.pose.position, random.pose.orientation * direction, 0, 20});
    }
    std::vector<Hit> expected(rays.size()), found(rays.size());
    moved_engine("reference", random, scene)->trace(rays, expected);
    moved_engine(GetParam().engine, random, scene)->trace(rays, found);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (expected[i].instance != kNoLabel && expected[i].instance == found[i].instance) {
        ++compared;
        turned += (expected[i].normal - found[i].normal).norm();
        otherwise += std::abs(expected[i].texture - found[i].texture) +
                     std::abs(expected[i].reflectivity - found[i].reflectivity);
      }
    }
  }
  ASSERT_GT(compared, 1000);
  EXPECT_LE(turned, 1e-3 * compared);
  EXPECT_LE(otherwise, 1e-4 * compared);
}

// Ripples as triangles against the same ripples as a relief on a flat floor. The paper model gives the mean of |cos| in
// each bin; ranges differ by the height of the ripples, which is half a bin.
TEST_P(ReliefEchoTest, MatchesADisplacedMesh) {
  constexpr double kLength = 0.8, kHeight = 0.02;  // Wavelength, and height of crests above the mean [m].
  constexpr int kSteps = 40, kRipples = 8;
  HeightGrid grid{
      .columns = kRipples * kSteps + 1, .rows = 2, .spacing_x = kLength / kSteps, .spacing_y = 20, .heights = {}};
  Tile<float> heights{kSteps, 1, {}};
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      grid.heights.push_back(static_cast<float>(kHeight * std::cos(2 * std::numbers::pi * column / kSteps)));
    }
  }
  for (int column = 0; column < kSteps; ++column) {
    heights.texels.push_back(static_cast<float>(kHeight * std::cos(2 * std::numbers::pi * (column + 0.5) / kSteps)));
  }
  const Pose floor{{6, 0, -2}, Eigen::Quaterniond::Identity()};
  const Scene displaced = SceneMaker().add("floor", make_height_field(grid), floor).scene();
  Scene mapped = SceneMaker().add("floor", make_plane(Vec3::UnitZ(), kRipples * kLength, 20), floor).scene();
  Relief relief;
  relief.slopes = slopes_of_heights(heights);
  relief.rise_per_tile = true;
  relief.tile_size = kLength;
  give(mapped, 0, std::make_shared<const Relief>(relief));

  FlatPlanSettings settings = pencil();
  settings.sonar.elevation_aperture = 30 * kDegree;
  settings.sonar.elevation_center = -25 * kDegree;
  settings.sonar.bin_count = 200;
  settings.sonar.sampling = {2, 800};
  const EchoGrid a = echoes(displaced, settings), b = echoes(mapped, settings);
  double products = 0, squares_a = 0, squares_b = 0, sum_a = 0, sum_b = 0, count = 0;
  for (int bin = 0; bin < a.bin_count(); ++bin) {
    const double weight_a = a.weight(1, 0)[bin], weight_b = b.weight(1, 0)[bin];
    if (weight_a > 0 && weight_b > 0) {
      const double mean_a = a.energy(1, 0)[bin] / weight_a, mean_b = b.energy(1, 0)[bin] / weight_b;
      products += mean_a * mean_b;
      squares_a += mean_a * mean_a;
      squares_b += mean_b * mean_b;
      sum_a += mean_a;
      sum_b += mean_b;
      ++count;
    }
  }
  ASSERT_GT(count, 80);
  const double covariance = products / count - sum_a * sum_b / count / count;
  const double variance_a = squares_a / count - sum_a * sum_a / count / count;
  const double variance_b = squares_b / count - sum_b * sum_b / count / count;
  EXPECT_GT(covariance / std::sqrt(variance_a * variance_b), 0.97);
  EXPECT_NEAR(std::sqrt(variance_b / variance_a), 1, 0.05);
  EXPECT_NEAR(sum_b / sum_a, 1, 0.03);
}

// The second surface of a path, a wall reached by way of a floor, has relief too.
TEST_P(ReliefEchoTest, SecondSurfacesHaveReliefToo) {
  Scene scene = SceneMaker().add_floor(-2).add_wall(8).scene();
  FlatPlanSettings settings{.secondary = SecondaryEchoes::kAll};
  settings.sonar.beam_count = 8;
  settings.sonar.azimuth_aperture = 10 * kDegree;
  settings.sonar.elevation_aperture = 10 * kDegree;
  settings.sonar.elevation_center = -20 * kDegree;
  settings.sonar.max_range = 12;
  settings.sonar.sampling = {2, 50};
  settings.water.absorption = false;
  settings.paper.sigmoid = Sigmoid::kNone;
  const EchoGrid plain = echoes(scene, settings);
  ASSERT_GT(total(plain, 2), 0);
  // Rays reflected from the floor meet the wall at the same slope. The wall's winding faces away from the sonar, so a
  // relief that falls upwards on its front rises upwards here, and tilts the normal down towards the rays.
  give(scene, 1, constant({0, -static_cast<float>(std::tan(20 * kDegree))}, 0.5F));
  const EchoGrid leaning = echoes(scene, settings);
  EXPECT_NEAR(total(leaning, 1) / total(plain, 1), 1, 1e-5);  // Echo of the floor.
  EXPECT_NEAR(total(leaning, 2) / total(plain, 2), 0.5 / std::cos(20 * kDegree), 0.01);
}

// A relief tilted away by 15 degrees still faces rays that come down at 20 degrees, and reflects them down at 10, into
// the floor. Such rays are not traced. They would hit another floor below and return past the edge of the first.
TEST_P(ReliefEchoTest, NothingIsReflectedIntoTheSurface) {
  Scene scene = SceneMaker().add_floor(-2, 0.8, 6).add_floor(-2.5).scene();
  give(scene, 0, constant({-0.27F, 0}));
  FlatPlanSettings settings{.secondary = SecondaryEchoes::kAll};
  settings.sonar.azimuth_aperture = 10 * kDegree;
  settings.sonar.elevation_center = -20 * kDegree;
  settings.sonar.elevation_aperture = 4 * kDegree;
  settings.sonar.max_range = 20;
  const EchoGrid grid = echoes(scene, settings);
  EXPECT_GT(total(grid, 1), 0);
  EXPECT_EQ(total(grid, 2), 0);
}

}  // namespace
}  // namespace insonify::relief_echo_test
