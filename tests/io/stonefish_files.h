// stonefish_files.h -- shared by the Stonefish tests: a folder for files, loading, and captured log messages.

#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "insonify/files.h"
#include "support/message_of.h"
#include "support/test_files.h"

namespace insonify {

class StonefishTest : public testing::Test {
 protected:
  StonefishTest() {
    for (const char* list : {"INSONIFY_MODEL_PATH", "AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH"}) {
      unsetenv(list);
    }
  }

  std::string write(const std::string& name, const std::string& text) const { return scratch.write(name, text); }

  /// Writes and loads a scenario of these elements; `said` receives the log messages, with the test's folder removed.
  Scene load(const std::string& elements, const WorldOptions& options = {}) {
    return load_file(write("pool.scn", scenario(elements)), options);
  }
  Scene load_file(const std::string& path, const WorldOptions& options = {}) {
    said.clear();
    return load_scene(path, options, [&](Severity, const std::string& line) { said.push_back(without_folder(line)); });
  }

  /// The only instance of a scenario of one element.
  Instance only(const std::string& element, const WorldOptions& options = {}) {
    Scene scene = load(element, options);
    EXPECT_EQ(scene.instances.size(), 1U);
    return scene.instances.at(0);
  }

  /// Reads a scenario of ours from text.
  Scenario parse(const std::string& yaml, const std::vector<std::string>& settings = {}) {
    said.clear();
    return parse_scenario(yaml, scratch.path(), settings,
                          [&](Severity, const std::string& line) { said.push_back(without_folder(line)); });
  }

  std::string error_of(const std::string& elements, const WorldOptions& options = {}) {
    return without_folder(message_of([&] { load(elements, options); }));
  }
  std::string error_of_file(const std::string& path) {
    return without_folder(message_of([&] { load_file(path); }));
  }

  static std::string scenario(const std::string& elements) { return "<scenario>\n" + elements + "\n</scenario>"; }

  static std::string transform(const std::string& name, const std::string& xyz, const std::string& rpy = "0 0 0") {
    return fmt::format("<{} xyz='{}' rpy='{}'/>", name, xyz, rpy);
  }

  /// A static sphere of 1 m with its middle at `xyz`.
  static std::string ball(const std::string& name, const std::string& xyz, const std::string& more = "") {
    return fmt::format("<static name='{}' type='sphere'><dimensions radius='1'/>{}{}</static>\n", name, more,
                       transform("world_transform", xyz));
  }

  [[nodiscard]] std::string without_folder(std::string text) const {
    const std::string prefix = scratch.path().string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) {
      text.erase(at, prefix.size());
    }
    return text;
  }

  ScratchFolder scratch;
  std::vector<std::string> said;
};

inline std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const Instance& instance : scene.instances) {
    names.push_back(instance.name);
  }
  return names;
}

/// Bounds of one instance in the world.
inline Box3 bounds_of(const Instance& instance) {
  Scene scene;
  scene.instances = {instance};
  return scene.bounds();
}

}  // namespace insonify
