// random_scene.h -- random scenes, sonars and poses, the same for a seed on every machine.

#pragma once

#include <random>

#include "engines/test_scenes.h"
#include "insonify/sea_surface.h"

namespace insonify::testing_scenes {

inline constexpr int kScenes = 80;

class Dice {
 public:
  explicit Dice(int seed) : generator_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(generator_); }
  int below(int count) { return std::uniform_int_distribution<>(0, count - 1)(generator_); }

 private:
  std::mt19937 generator_;
};

inline Mesh random_shape(Dice& dice) {
  const double size = dice.between(0.2, 1.5);
  switch (dice.below(5)) {
    case 0:
      return make_box({size, dice.between(0.2, 1.5), dice.between(0.2, 1.5)});
    case 1:
      return make_sphere(size, 0.4);
    case 2:
      return make_cylinder(0.5 * size, 2 * size, 0.4);
    case 3:
      return make_cone(size, 1.5 * size, 0.4);
    default:
      return make_capsule(0.4 * size, size, 0.4);
  }
}

// Several objects around a sonar far from the world's origin, over a floor; some of the objects can move.
struct RandomScene {
  Scene scene;
  SonarConfig sonar;
  Pose pose;

  explicit RandomScene(int seed) {
    Dice dice(seed);
    const Vec3 centre(dice.between(-500, 500), dice.between(-500, 500), dice.between(-50, 0));
    SceneMaker maker;
    const int objects = 2 + dice.below(5);
    for (int i = 0; i < objects; ++i) {
      const Vec3 offset(dice.between(-1, 12), dice.between(-8, 8), dice.between(-3, 3));
      const Pose pose_i{centre + offset,
                        orientation_from_rpy(dice.between(-3, 3), dice.between(-1, 1), dice.between(-3, 3))};
      maker.add("object" + std::to_string(i), random_shape(dice), pose_i, dice.between(0.1, 1));
    }
    maker.add("floor", make_plane(Vec3::UnitZ(), 60, 60), {.position = centre + Vec3(0, 0, dice.between(-5, -2))},
              dice.between(0.1, 1));
    scene = maker.scene();
    for (Instance& instance : scene.instances) {
      instance.moving = dice.below(3) == 0;
    }
    sonar.beam_count = 16 + dice.below(17);
    sonar.azimuth_aperture = dice.between(20, 180) * kDegree;
    sonar.elevation_aperture = dice.between(5, 60) * kDegree;
    sonar.elevation_center = dice.between(-15, 15) * kDegree;
    sonar.max_range = dice.between(8, 20);
    sonar.bin_count = 100 + dice.below(200);
    sonar.sampling = {.columns_per_beam = 1 + dice.below(4), .rows = 20 + dice.below(30)};
    pose = {centre, orientation_from_rpy(dice.between(-1, 1), dice.between(-0.5, 0.8), dice.between(-0.3, 0.3))};
  }

  // Pose to which a moving instance is moved.
  [[nodiscard]] Pose moved_pose(std::size_t instance) const {
    const Pose& from = scene.instances[instance].world_from_mesh;
    return {from.position + Vec3(0.5, -0.3, 0.2), orientation_from_rpy(0.3, 0.2, 0.1) * from.orientation};
  }

  // Calls move(instance, pose) for all moving instances.
  template <typename Move>
  void move_all(const Move& move) const {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      if (scene.instances[i].moving) {
        move(static_cast<int>(i), moved_pose(i));
      }
    }
  }
};

// Puts a scene under a sea, whose surface is a plane wider than the range, as SeaPlane makes it.
inline void add_sea(Scene& scene, const Vec3& position, double wind_speed, double frequency) {
  Instance sea;
  sea.name = "sea_surface";
  sea.mesh = std::make_shared<const Mesh>(make_plane(-Vec3::UnitZ(), 128, 128));
  sea.world_from_mesh.position = position;
  sea.materials = {static_cast<std::uint16_t>(scene.materials.size())};
  sea.moving = sea.endless = true;
  scene.instances.push_back(std::move(sea));
  scene.materials.push_back(sea_surface_material({.wind_speed = wind_speed}, frequency));
}

// Makes nets of a third of a scene's materials and thin plates of another.
inline void let_sound_through(Scene& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    Material& material = scene.materials[i];
    material.lambert_db = -15;
    material.open_share = i % 3 == 0 ? 0.7 : 0;
    material.thickness = i % 3 == 1 ? std::optional(2e-4) : std::nullopt;
  }
}

}  // namespace insonify::testing_scenes
