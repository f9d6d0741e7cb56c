// mesh_probe.h -- measures a generated mesh by tracing rays at it.

#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "insonify/geometry.h"
#include "insonify/mesh.h"
#include "insonify/scene.h"
#include "scenes/obj_mesh.h"
#include "support/test_engine.h"

namespace insonify::testing_scenes {

/// Coordinates in the files are whole millimetres [m].
inline constexpr double kRounding = 1e-3;

/// One generated mesh to trace rays at, in its own frame.
class Probe {
 public:
  explicit Probe(const std::string& name) {
    Mesh mesh = read_obj(generated_meshes() / (name + ".obj"));
    EXPECT_EQ(clean_mesh(mesh).dropped(), 0U);
    Instance instance{.name = name};
    instance.materials.assign(mesh.material_names.size(), 0);
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    scene_.materials.push_back({.name = "anything"});
    scene_.instances.push_back(std::move(instance));
    engine_->set_scene(scene_);
  }

  /// Distance to the first surface; infinite where there is none.
  double distance(const Vec3& from, const Vec3& direction) {
    const std::vector<Ray> rays = {{.origin = from, .direction = direction.normalized()}};
    std::vector<Hit> hits(1);
    engine_->trace(rays, hits);
    return hits.front().distance;
  }

  /// Height of the highest surface at a horizontal position.
  double height(double x, double y) { return 50 - distance({x, y, 50}, -Vec3::UnitZ()); }

 private:
  Scene scene_;
  std::unique_ptr<TestEngine> engine_ = test_engine("cpu", 1);
};

}  // namespace insonify::testing_scenes
