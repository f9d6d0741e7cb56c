// sdf_files.h -- shared by the SDF tests: a folder for files, loading, and captured log messages.

#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "insonify/files.h"
#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify {

// Poses are read from text and multiplied in double precision.
inline constexpr double kPoseError = 1e-9;

// Vertices are kept in single precision: a few units in the last place of metres.
inline constexpr double kVertexError = 1e-5;

class SdfTest : public testing::Test {
 protected:
  SdfTest() {
    for (const char* list :
         {"INSONIFY_MODEL_PATH", "SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH",
          "GAZEBO_RESOURCE_PATH", "GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH"}) {
      unsetenv(list);
    }
    setenv("HOME", (folder / "home").c_str(), 1);  // Where Fuel's caches are.
  }

  std::string write(const std::string& name, const std::string& text) const { return scratch.write(name, text); }

  /// Writes and loads an SDF file; `said` receives the log messages, with the test's folder removed.
  Scene load(const std::string& text, bool collisions = false) {
    return load(text, WorldOptions{.collisions = collisions});
  }
  Scene load(const std::string& text, const WorldOptions& options) {
    return load_file(write("scene.sdf", text), options);
  }
  Scene load_file(const std::string& path, const WorldOptions& options = {}) {
    said.clear();
    return load_scene(path, options, [&](Severity, const std::string& line) { said.push_back(without_folder(line)); });
  }

  /// Names of a scene's instances, in order.
  static std::vector<std::string> names(const Scene& scene) {
    std::vector<std::string> found;
    for (const Instance& instance : scene.instances) {
      found.push_back(instance.name);
    }
    return found;
  }

  /// Error message of loading, with the test's folder removed. Whatever is missing is an error here.
  std::string error_of(const std::string& text, bool collisions = false) {
    return error_of_file(write("scene.sdf", text), {.collisions = collisions, .strict = true});
  }
  std::string error_of_file(const std::string& path, const WorldOptions& options = {.strict = true}) {
    return without_folder(message_of([&] { load_file(path, options); }));
  }

  [[nodiscard]] std::string without_folder(std::string text) const {
    const std::string prefix = folder.string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    return text;
  }

  ScratchFolder scratch;
  const std::filesystem::path& folder = scratch.path();
  std::vector<std::string> said;
};

/// An SDF file of one model "ship" with one link "hull" with one visual "plate", of the given geometry.
inline std::string sdf_of(const std::string& geometry, const std::string& more_in_visual = "") {
  return fmt::format(R"(<sdf version="1.9" xmlns:insonify="https://insonify.org/sdf">
<model name="ship"><static>true</static>
<link name="hull">
<visual name="plate"><geometry>{}</geometry>{}</visual>
</link></model></sdf>)",
                     geometry, more_in_visual);
}

/// Bounding box of all vertices of an instance, world frame.
inline Box3 world_bounds(const Instance& instance) {
  Box3 box{Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  for (const Vec3f& vertex : instance.mesh->vertices) {
    const Vec3 point = instance.world_from_mesh * vertex.cast<double>();
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  return box;
}

MATCHER_P2(Near3, expected, tolerance,
           "within " + testing::PrintToString(tolerance) + " of " +
               fmt::format("({}, {}, {})", expected.x(), expected.y(), expected.z())) {
  *result_listener << fmt::format("which is ({}, {}, {})", arg.x(), arg.y(), arg.z());
  return (arg - expected).cwiseAbs().maxCoeff() <= tolerance;
}

}  // namespace insonify
