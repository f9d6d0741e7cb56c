#include "insonify/scene_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "insonify/error.h"
#include "insonify/mesh.h"
#include "support/message_of.h"
#include "support/test_engine.h"
#include "view/camera.h"

namespace insonify::scene_view_test {
namespace {

// A scene, an engine that has loaded it, and a sonar 3 m above the scene's floor looking along x.
class Stage {
 public:
  explicit Stage(const char* engine = "cpu") : engine_(test_engine(engine, 1)) {
    sonar.azimuth_aperture = radians_from_degrees(90);
    sonar.beam_count = 16;
    sonar.elevation_aperture = radians_from_degrees(40);
    sonar.elevation_center = radians_from_degrees(-15);
    sonar.max_range = 20;
    pose.position = {0, 0, 3};
  }

  Stage& add(const char* material, Mesh mesh, const Vec3& place) {
    Instance instance;
    instance.name = material;
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    instance.world_from_mesh.position = place;
    instance.materials = {static_cast<std::uint16_t>(scene_.materials.size())};
    scene_.materials.push_back({.name = material});
    scene_.instances.push_back(std::move(instance));
    return *this;
  }

  Stage& add_floor(double size = 400) { return add("sand", make_plane(Vec3::UnitZ(), size, size), Vec3::Zero()); }

  Engine& engine() {
    engine_->set_scene(scene_);
    return engine_->engine();
  }
  [[nodiscard]] const Scene& scene() const { return scene_; }

  Picture draw(const ViewConfig& view, bool outline = true, int width = 160) {
    return draw_scene(engine(), scene_, view, sonar, pose,
                      {.width = width, .height = width * 3 / 4, .sonar_outline = outline});
  }
  ViewConfig fit() { return fitting_view(engine(), scene_, sonar, pose); }

  bool sees(const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const Ray ray{from, way.normalized(), 0, way.norm() * 0.999};
    Hit hit;
    engine().trace({&ray, 1}, {&hit, 1});
    return !std::isfinite(hit.distance);
  }

  SonarConfig sonar;
  Pose pose;

 private:
  Scene scene_;
  std::unique_ptr<TestEngine> engine_;
};

// Image position in half pictures from the middle.
std::pair<double, double> place_in(const ViewConfig& view, const Vec3& point) {
  const Camera::Image image = Camera(view, 4, 3).image_of(point);
  return image.depth > 0 ? std::pair(image.x / 2 - 1, image.y / 1.5 - 1) : std::pair(1e9, 1e9);
}
bool frames(const ViewConfig& view, const Vec3& point) {
  const auto [x, y] = place_in(view, point);
  return std::abs(x) < 1 && std::abs(y) < 1;
}

int brightness(const std::uint8_t* pixel) {
  return pixel[0] + pixel[1] + pixel[2];
}
// Difference of yellow and blue.
int warmth(const std::uint8_t* pixel) {
  return pixel[0] - pixel[2];
}

// Compares a ball's outline with the distance of its centre from each pixel's ray; pixels on the border may be either.
TEST(DrawSceneTest, ABallIsWhereItsOutlineIs) {
  Stage stage;
  const Vec3 centre(10, 1, 2);
  const ViewConfig view{.position = {0, 0, 3}, .look_at = {10, 0, 2.5}, .field_of_view = 0.7};
  stage.add("rubber", make_sphere(30), {0, 0, 5000});  // Out of sight: a scene cannot be empty.
  const Picture without = stage.draw(view, false);
  stage.add("rubber", make_sphere(1.5), centre);
  const Picture with = stage.draw(view, false);
  const Camera camera(view, 160, 120);
  const double pixel = camera.width_at_one() * 10 / 160;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Vec3 direction = camera.direction(x + 0.5, y + 0.5);
      const double off = (centre - view.position).cross(direction).norm();
      // Haze depends on what is in view, but open water does not; dithering depends on the pixel's position only.
      const bool same = std::equal(with.at(x, y), with.at(x, y) + 3, without.at(x, y));
      if (off > 1.5 + pixel) {
        EXPECT_TRUE(same) << x << ' ' << y;
      } else if (off < 1.5 - pixel) {
        EXPECT_FALSE(same) << x << ' ' << y;
      }
    }
  }
}

TEST(DrawSceneTest, AllEnginesDrawTheSame) {
  const ViewConfig view{.position = {-6, 3, 6}, .look_at = {8, 0, 0}};
  const auto draw = [&](const char* engine) {
    Stage stage(engine);
    return stage.add_floor().add("steel", make_box({1, 2, 2}), {8, 0, 1}).draw(view, true, 80);
  };
  const Picture cpu = draw("cpu");
  const Picture reference = draw("reference");
  int different = 0;
  for (std::size_t i = 0; i < cpu.rgb.size(); ++i) {
    different += std::abs(cpu.rgb[i] - reference.rgb[i]) > 2 ? 1 : 0;
  }
  // Single and double precision disagree on some samples at edges.
  EXPECT_LT(different, 0.005 * static_cast<double>(cpu.rgb.size()));
}

TEST(DrawSceneTest, AThingCastsAShadowOnTheFloor) {
  const ViewConfig view{.position = {0, 0, 8}, .look_at = {8, 0, 0}, .field_of_view = 1};
  Stage stage;
  const Picture bare = stage.add_floor().draw(view, false);
  const Picture shaded = stage.add("steel", make_box({0.5, 0.5, 2}), {8, 0, 3}).draw(view, false);
  const Camera camera(view, 160, 120);
  const Box3 box{{7.7, -0.3, 1.9}, {8.3, 0.3, 4.1}};
  int darker = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      // Rays that pass the box by a margin hit the floor in both pictures.
      const Vec3 direction = camera.direction(x + 0.5, y + 0.5);
      bool near_box = false;
      for (double t = 0; t < 14; t += 0.1) {
        const Vec3 point = view.position + t * direction;
        near_box = near_box || ((point - box.low).minCoeff() > 0 && (box.high - point).minCoeff() > 0);
      }
      darker += !near_box && brightness(shaded.at(x, y)) < 0.8 * brightness(bare.at(x, y)) ? 1 : 0;
    }
  }
  EXPECT_GT(darker, 50);
}

// The sector meets the floor from 3 / tan(35 deg) = 4.3 m on. Behind the box, in its acoustic shadow, the floor keeps
// its colour; beside it, it is tinted yellow.
TEST(DrawSceneTest, WhatTheSonarInsonifiesIsYellowAndItsShadowIsNot) {
  Stage stage;
  stage.add_floor().add("steel", make_box({1, 2, 2.5}), {8, 0, 1.25});
  const ViewConfig view{.position = {6, 0, 25}, .look_at = {8, 0.01, 0}, .field_of_view = 0.9};
  const Picture with = stage.draw(view, true);
  const Picture without = stage.draw(view, false);
  const Camera camera(view, 160, 120);
  const auto gain = [&](const Vec3& place) {
    const Camera::Image image = camera.image_of(place);
    const int x = static_cast<int>(image.x);
    const int y = static_cast<int>(image.y);
    return warmth(with.at(x, y)) - warmth(without.at(x, y));
  };
  EXPECT_GT(gain({8, 4, 0}), 15);
  EXPECT_GT(gain({6.5, 0, 0}), 15);
  EXPECT_EQ(gain({11, 0, 0}), 0);  // In the shadow of the box.
  EXPECT_EQ(gain({2, 1, 0}), 0);   // Below the sector.
  EXPECT_EQ(gain({1, 4, 0}), 0);   // Beside it.
}

TEST(DrawSceneTest, ASonarBehindAWallIsNotSeen) {
  Stage stage;
  stage.add_floor().add("concrete", make_box({0.5, 200, 200}), {-2, 0, 0});
  const ViewConfig view{.position = {-12, 0, 4}, .look_at = {0, 0, 2}};
  EXPECT_EQ(stage.draw(view, true).rgb, stage.draw(view, false).rgb);
}

TEST(DrawSceneTest, RefusesViewsThatShowNothing) {
  Stage stage;
  stage.add_floor();
  EXPECT_EQ(message_of([&] {
              (void)stage.draw({.position = {1, 2, 3}, .look_at = {1, 2, 3}});
            }),
            "view.look_at must be another place than view.position");
  EXPECT_EQ(message_of([&] { (void)stage.draw({.field_of_view = 3.1}); }),
            "view.field_of_view_deg = 177.6169165 deg must be greater than 0, at most 170 deg");
  EXPECT_EQ(message_of([&] { (void)stage.draw({}, true, 12); }),
            "view.width = 12 pixels must be from 16 to 8192 pixels");
}

TEST(FittingViewTest, ShowsTheSonarAndWhatItSees) {
  Stage stage;
  const Vec3 ball(9, 2, 1);
  stage.add_floor().add("steel", make_sphere(1), ball);
  const ViewConfig view = stage.fit();
  EXPECT_GT(view.position.z(), 1);         // Above the floor.
  EXPECT_LT(view.position.x(), ball.x());  // On the sonar's side.
  EXPECT_TRUE(frames(view, ball));
  EXPECT_TRUE(frames(view, stage.pose.position));
  EXPECT_TRUE(stage.sees(view.position, stage.pose.position));
  const Vec3 to_ball = (ball - view.position).normalized();
  EXPECT_TRUE(stage.sees(view.position, ball - 1.01 * to_ball));
}

// The beams, which reach 5 degrees up, hit the cone at up to 3.8 m of its height of 8 m.
TEST(FittingViewTest, ShowsTheTipOfWhatIsSeenInPart) {
  Stage stage;
  stage.add_floor().add("steel", make_cone(2, 8), {9, 0, 4});
  const ViewConfig view = stage.fit();
  EXPECT_TRUE(frames(view, {9, 0, 8}));
  EXPECT_TRUE(frames(view, stage.pose.position));
}

TEST(FittingViewTest, StaysInsideAClosedTank) {
  Stage stage;
  const Vec3 size(12, 8, 5);
  stage.add("concrete", make_box(size), {0, 0, 2.5}).add("aluminium", make_box({1, 1, 1}), {3, 1, 2});
  stage.pose.position = {-3, -1, 2};
  const ViewConfig view = stage.fit();
  EXPECT_LT((view.position - Vec3(0, 0, 2.5)).cwiseAbs().cwiseQuotient(size / 2).maxCoeff(), 1);
  EXPECT_TRUE(frames(view, stage.pose.position));
  EXPECT_TRUE(stage.sees(view.position, stage.pose.position));
}

// Also where the sound ends at the floor or at the greatest range, far from the only object.
TEST(FittingViewTest, ShowsTheBorderOfTheSector) {
  Stage stage;
  stage.add_floor().add("steel", make_sphere(0.5), {6, 0.5, 0.5});
  const ViewConfig view = stage.fit();
  for (const double azimuth_deg : {-45.0, -20.0, 0.0, 20.0, 45.0}) {
    for (const double elevation_deg : {-35.0, 5.0}) {
      const Vec3 way =
          point_from_spherical({1, radians_from_degrees(azimuth_deg), radians_from_degrees(elevation_deg)});
      const Vec3 end = stage.pose.position + (way.z() < 0 ? std::min(20.0, -3 / way.z()) : 20) * way;
      EXPECT_TRUE(frames(view, end)) << azimuth_deg << ' ' << elevation_deg;
    }
  }
}

// The same scene, a hundred times as large or as small, gives the same picture.
TEST(FittingViewTest, DoesNotDependOnScale) {
  const auto fit = [](double scale) {
    Stage stage;
    stage.add_floor(400 * scale).add("steel", make_box(scale * Vec3(1, 2, 3)), scale * Vec3(9, -2, 1.5));
    stage.sonar.max_range *= scale;
    stage.sonar.min_range *= scale;
    stage.pose.position *= scale;
    return stage.fit();
  };
  const ViewConfig view = fit(1);
  for (const double scale : {0.01, 100.0}) {
    const ViewConfig other = fit(scale);
    // A ray that ends at max_range may be rounded to either side, which moves the camera a little.
    EXPECT_TRUE((other.position / scale).isApprox(view.position, 0.03)) << other.position.transpose();
    EXPECT_EQ(other.field_of_view, view.field_of_view);
  }
}

// Moving scene and sonar together moves the camera with them.
TEST(FittingViewTest, DoesNotDependOnTheOrigin) {
  const auto fit = [](const Vec3& shift) {
    Stage stage;
    stage.add("sand", make_plane(Vec3::UnitZ(), 400, 400), shift);
    stage.add("steel", make_box({1, 2, 3}), shift + Vec3(9, -2, 1.5));
    stage.pose.position += shift;
    return stage.fit();
  };
  const ViewConfig view = fit(Vec3::Zero());
  for (const Vec3& shift : {Vec3(-20, 0, -90), Vec3(0, 70, -5), Vec3(-600, 800, -2000), Vec3(9, -3, 11)}) {
    const ViewConfig other = fit(shift);
    // Rays end at positions in single precision, which moves the camera a little.
    EXPECT_LT((other.position - shift - view.position).norm(), 0.1) << shift.transpose();
    EXPECT_LT((other.look_at - shift - view.look_at).norm(), 0.1) << shift.transpose();
    EXPECT_EQ(other.field_of_view, view.field_of_view);
  }
}

TEST(FittingViewTest, WorksWhereThereIsNothing) {
  Stage stage;
  stage.add("steel", make_sphere(1), {5000, 0, 0});
  const ViewConfig view = stage.fit();
  EXPECT_TRUE(view.position.allFinite());
  EXPECT_TRUE(frames(view, stage.pose.position));
  for (const double azimuth_deg : {-42.0, 0.0, 42.0}) {  // The far end of the sector.
    const double azimuth = radians_from_degrees(azimuth_deg), elevation = stage.sonar.elevation_center;
    EXPECT_TRUE(frames(view, stage.pose * point_from_spherical({20, azimuth, elevation}))) << azimuth_deg;
  }
}

TEST(FittingViewTest, WorksForSonarsThatLookDownOrAround) {
  for (const double pitch_deg : {90.0, 45.0, -90.0}) {
    Stage stage;
    stage.add_floor().add("steel", make_sphere(0.5), {1, 0.5, 0.5});
    stage.pose.orientation = orientation_from_rpy(0, radians_from_degrees(pitch_deg), 0.4);
    const ViewConfig view = stage.fit();
    EXPECT_GT(view.position.z(), 0) << pitch_deg;
    EXPECT_TRUE(frames(view, stage.pose.position)) << pitch_deg;
  }
  Stage stage;
  stage.add_floor().add("steel", make_sphere(1), {-6, 4, 1});
  stage.sonar.type = SonarType::kMechanicallyScanned;
  stage.sonar.beam_count = 1;
  stage.sonar.azimuth_aperture = radians_from_degrees(3);
  const ViewConfig view = stage.fit();
  EXPECT_TRUE(frames(view, stage.pose.position));
  EXPECT_TRUE(frames(view, {-6, 4, 1}));
}

// A cross is drawn at the position unless a surface hides it.
TEST(SceneViewTest, MarksWhatIsSeen) {
  Stage stage;
  stage.add_floor().add("steel", make_plane(-Vec3::UnitX(), 4, 4), {10, 0, 2});
  const ViewConfig view{.position = {0, 0, 2}, .look_at = {10, 0, 2}};
  const auto draw = [&](std::vector<Vec3> marks) {
    return draw_scene(stage.engine(), stage.scene(), view, stage.sonar, stage.pose,
                      {.width = 160, .height = 120, .sonar_outline = false, .marks = std::move(marks)});
  };
  const Picture without = draw({});
  const Picture with = draw({{9, 0, 2}});
  EXPECT_NE(std::string(with.at(80, 60), with.at(80, 60) + 3), std::string(without.at(80, 60), without.at(80, 60) + 3));
  EXPECT_GT(with.at(80, 60)[0], 200);
  EXPECT_EQ(std::string(with.at(90, 70), with.at(90, 70) + 3), std::string(without.at(90, 70), without.at(90, 70) + 3));
  EXPECT_EQ(draw({{11, 0, 2}, {-5, 0, 2}}).rgb, without.rgb);  // Behind the plate; behind the camera.
}

}  // namespace
}  // namespace insonify::scene_view_test
