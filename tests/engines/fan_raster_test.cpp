// fan_raster_test.cpp -- the fan rasteriser, sample by sample, against the geometry of single triangles and against
// rays.

#include "echo/cpu/fan_raster.h"

#include "echo/model/hit_column.h"
#include "engines/random_scene.h"

namespace insonify::fan_raster_test {
namespace {

using namespace testing_scenes;

// A scene rasterised for one sonar.
class Drawing {
 public:
  Drawing(const Scene& scene, const SonarConfig& sonar, const Pose& pose)
      : plan_(make_flat_plan({.sonar = sonar})), strip_(1, plan_->lattice.rows) {
    scene_.set(scene);
    look(pose);
  }

  void move(int instance, const Pose& pose) { scene_.move(instance, pose); }

  void look(const Pose& pose) {
    view_.look(scene_, *plan_, {pose.position - scene_.origin(), pose.orientation});
    raster_.draw(scene_, view_, *plan_, 0, plan_->lattice.columns);
  }

  [[nodiscard]] const Lattice& lattice() const { return plan_->lattice; }

  // One column of hits; rows beyond HitColumn::rows have none.
  HitColumn column(int index) {
    HitColumn hits = strip_.column(0);
    hits.rows = raster_.read(index, hits);
    return hits;
  }

  static bool met(const HitColumn& hits, int row) { return row < hits.rows && hits.surface[row] != kNoSurface; }

 private:
  std::shared_ptr<const FlatPlan> plan_;
  RasterScene scene_;
  FanView view_;
  Workers workers_{1};
  FanRaster raster_{workers_};
  HitStrip strip_;
};

SonarConfig fan_of(double azimuth, double elevation) {
  SonarConfig sonar;
  sonar.beam_count = 25;
  sonar.azimuth_aperture = azimuth * kDegree;
  sonar.elevation_aperture = elevation * kDegree;
  sonar.max_range = 30;
  sonar.sampling = {.columns_per_beam = 3, .rows = 61};
  return sonar;
}

Mesh triangle_mesh(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  Mesh mesh;
  mesh.vertices = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  static_cast<void>(clean_mesh(mesh));
  return mesh;
}

// A triangle in the plane x = 5 with corners (y, z) = (-1, -0.5), (1, -0.5) and (0, 1). A direction meets the plane at
// (y, z) = (5 tan az, 5 tan el / cos az), at the range 5 / (cos az cos el).
TEST(FanRasterTest, ATriangleCoversTheDirectionsBetweenItsCorners) {
  SceneMaker maker;
  maker.add("sail", triangle_mesh({5, -1, -0.5F}, {5, 1, -0.5F}, {5, 0, 1}), {}, 0.6);
  Drawing drawing(maker.scene(), fan_of(40, 30), {});
  const Lattice& lattice = drawing.lattice();
  int met = 0, missed = 0;
  for (int column = 0; column < lattice.columns; ++column) {
    const HitColumn hits = drawing.column(column);
    for (int row = 0; row < lattice.rows; ++row) {
      const double azimuth = lattice.azimuth[column], elevation = lattice.elevations(column)[row];
      const double y = 5 * std::tan(azimuth), z = 5 * std::tan(elevation) / std::cos(azimuth);
      const double inside = std::min(z + 0.5, 1 - z - 1.5 * std::abs(y));  // Above the foot, below the sides.
      if (std::abs(inside) < 1e-5) {
        continue;  // On an edge.
      }
      ASSERT_EQ(Drawing::met(hits, row), inside > 0) << "at " << y << ", " << z;
      if (inside > 0) {
        ++met;
        EXPECT_NEAR(hits.range[row], 5 / (std::cos(azimuth) * std::cos(elevation)), 1e-5);
        EXPECT_NEAR(std::abs(hits.normal_x[row]),
                    std::hypot(hits.normal_x[row], hits.normal_y[row], hits.normal_z[row]), 1e-6);
        EXPECT_FLOAT_EQ(hits.reflectivity[row], 0.6F);
      } else {
        ++missed;
      }
    }
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(missed, 500);
}

// A spherical shell of triangles whose vertices are in the directions of the samples: every sample lies on an edge, and
// must hit one of the triangles.
TEST(FanRasterTest, NoSampleFallsBetweenTriangles) {
  for (const auto& [columns_per_beam, tilt] : {std::pair{1, 0.0}, {3, 0.0}, {1, -43.0}, {3, 31.0}}) {
    SonarConfig sonar = fan_of(60, 40);
    sonar.sampling.columns_per_beam = columns_per_beam;
    sonar.elevation_center = tilt * kDegree;
    Drawing blank({}, sonar, {});
    const Lattice& lattice = blank.lattice();
    Mesh shell;
    const int columns = lattice.columns, rows = lattice.rows;
    for (int column = 0; column < columns; ++column) {
      for (int row = 0; row < rows; ++row) {
        const double azimuth = lattice.azimuth[column];
        // The outermost vertices lie beyond the fan.
        const double beyond = row == 0 ? -0.1 : row + 1 == rows ? 0.1 : 0;
        const double outwards = column == 0 ? 0.1 : column + 1 == columns ? -0.1 : 0;
        shell.vertices.push_back(
            point_from_spherical({9, azimuth + outwards, lattice.elevations(0)[row] + beyond}).cast<float>());
      }
    }
    for (int column = 0; column + 1 < columns; ++column) {
      for (int row = 0; row + 1 < rows; ++row) {
        const auto a = static_cast<std::uint32_t>(column * rows + row), b = a + static_cast<std::uint32_t>(rows);
        shell.triangles.push_back({a, b, b + 1});
        shell.triangles.push_back({a, b + 1, a + 1});
      }
    }
    static_cast<void>(clean_mesh(shell));
    SceneMaker maker;
    maker.add("shell", std::move(shell));
    Drawing drawing(maker.scene(), sonar, {});
    for (int column = 0; column < columns; ++column) {
      const HitColumn hits = drawing.column(column);
      for (int row = 0; row < rows; ++row) {
        ASSERT_TRUE(Drawing::met(hits, row)) << column << ", " << row;
        ASSERT_NEAR(hits.range[row], 9, 0.03);
      }
    }
  }
}

TEST(FanRasterTest, SurfacesBeyondTheRangeAreNotHit) {
  SceneMaker maker;
  maker.add_wall(29.9);
  Drawing drawing(maker.scene(), fan_of(40, 30), {});
  const Lattice& lattice = drawing.lattice();
  for (int column = 0; column < lattice.columns; ++column) {
    const HitColumn hits = drawing.column(column);
    for (int row = 0; row < lattice.rows; ++row) {
      const double range = 29.9 / (std::cos(lattice.azimuth[column]) * std::cos(lattice.elevations(column)[row]));
      EXPECT_EQ(Drawing::met(hits, row), range < 30) << range;
    }
  }
}

// Hit by hit against rays on random scenes, a quarter of them with a fan of 360 degrees, a third of them with one that
// looks steeply up or down.
TEST(FanRasterTest, HitsWhatRaysHit) {
  double samples = 0, met = 0, one_only = 0, other = 0, range_apart = 0, normal_apart = 0;
  for (int seed = 0; seed < kScenes; ++seed) {
    RandomScene random(seed);
    if (seed % 4 == 3) {
      random.sonar.azimuth_aperture = 360 * kDegree;
    }
    if (seed % 3 == 2) {
      const double half = random.sonar.elevation_aperture / 2;
      random.sonar.elevation_center = (seed % 2 == 0 ? 1 : -1) * (75 * kDegree - half);
    }
    const auto engine = test_engine("cpu", 2);
    engine->set_scene(random.scene);
    Drawing drawing(random.scene, random.sonar, random.pose);
    random.move_all([&](int instance, const Pose& pose) {
      engine->move_instance(instance, pose);
      drawing.move(instance, pose);
    });
    drawing.look(random.pose);
    const Lattice& lattice = drawing.lattice();
    std::vector<Ray> rays(lattice.rows);
    std::vector<Hit> hits(lattice.rows);
    for (int column = 0; column < lattice.columns; ++column) {
      for (int row = 0; row < lattice.rows; ++row) {
        const Vec3 direction = point_from_spherical({1, lattice.azimuth[column], lattice.elevations(column)[row]});
        rays[row] = {random.pose.position, random.pose.orientation * direction, 0, random.sonar.max_range};
      }
      engine->trace(rays, hits);
      const HitColumn drawn = drawing.column(column);
      for (int row = 0; row < lattice.rows; ++row) {
        const bool by_ray = hits[row].instance != kNoLabel;
        ++samples;
        if (by_ray != Drawing::met(drawn, row)) {
          ++one_only;
        } else if (by_ray) {
          ++met;
          if (instance_of(drawn.surface[row]) != hits[row].instance) {
            ++other;
            continue;
          }
          range_apart += std::abs(drawn.range[row] - hits[row].distance);
          const Vec3 normal = Vec3(drawn.normal_x[row], drawn.normal_y[row], drawn.normal_z[row]).normalized();
          normal_apart += 1 - std::abs(normal.dot(hits[row].normal));
        }
      }
    }
  }
  EXPECT_GT(met, 0.3 * samples);
  EXPECT_LE(one_only, 1e-5 * samples);
  EXPECT_LE(other, 1e-5 * samples);
  EXPECT_LE(range_apart / met, 1e-5);
  EXPECT_LE(normal_apart / met, 1e-5);
  RecordProperty("mean_range_apart", std::to_string(range_apart / met));
}

}  // namespace
}  // namespace insonify::fan_raster_test
