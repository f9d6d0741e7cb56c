// stonefish_scene.cpp -- adds the shapes of bodies and their parts to a scene, and reports what is missing.

#include "io/stonefish/stonefish_scene.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <utility>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/missing_parts.h"
#include "io/file/name_patterns.h"
#include "io/stonefish/stonefish_bodies.h"
#include "io/stonefish/stonefish_shapes.h"
#include "io/stonefish/stonefish_source.h"

namespace insonify {
namespace {

class StonefishSceneBuilder {
 public:
  StonefishSceneBuilder(const WorldOptions& options, MissingParts& missing, const Log& log)
      : options_(options), missing_(missing), log_(log), ignored_(options.ignore), shapes_(options.parts, log) {}

  void add(const StonefishBody& body) {
    if (is_ignored(body.name)) {
      return;
    }
    if (body.element.type() != "compound") {
      add_shape(body.name, body.element, body.world_from_body);
      return;
    }
    // What is inside a hull is not drawn in Stonefish either.
    for (const pugi::xml_node node : body.element.node.children("external_part")) {
      const StonefishElement part{node, body.element.file, body.element.path};
      const std::string name = body.name + "::" + part.name();
      if (!ignored_.match(name)) {
        add_shape(name, part, body.world_from_body, "compound_transform");
      }
    }
  }

  Scene finish(const std::string& file) {
    if (!missing_.empty() && (options_.strict || !scene_.instances.empty())) {
      missing_.report(file, options_.strict, log_);
    }
    if (scene_.instances.empty()) {
      throw Error(!missing_.empty() ? fmt::format("{}: nothing is left to insonify: {}", file, missing_.whole_text())
                                    : fmt::format("{}: there is no body to insonify{}", file,
                                                  ignored_.any() ? " except what `ignore` removes" : ""));
    }
    ignored_.report_unused(file, log_);
    return std::move(scene_);
  }

 private:
  // Whether a pattern matches a body, or the robot that it is a link of.
  bool is_ignored(const std::string& name) {
    const std::size_t colons = name.find("::");
    const bool robot = colons != std::string::npos && ignored_.match(name.substr(0, colons));
    return robot || ignored_.match(name);
  }

  // Names in a scenario need not be unique.
  std::string unique(const std::string& name) {
    std::string tried = name;
    for (int& copies = copies_[name]; !names_.insert(tried).second;) {
      tried = fmt::format("{}_{}", name, ++copies + 1);
    }
    return tried;
  }

  void add_shape(const std::string& name, const StonefishElement& element, const Pose& world_from_body,
                 const char* transform = nullptr) {
    try {
      const Pose own = transform == nullptr ? Pose{} : stonefish_pose(element, transform);
      const std::vector<StonefishShape> shapes = shapes_.shapes(element, options_.collisions);
      const std::string own_name = shapes.empty() ? name : unique(name);
      for (const StonefishShape& shape : shapes) {
        Instance instance;
        instance.name = shape.part.empty() ? own_name : own_name + "::" + shape.part;
        instance.mesh = shape.mesh;
        instance.world_from_mesh = up_from_down() * world_from_body * own * shape.body_from_mesh;
        check_reach(instance, element.what());
        if (shape.part.empty() || !ignored_.match(instance.name)) {
          scene_.instances.push_back(std::move(instance));
        }
      }
    } catch (const UnreadablePart& unreadable) {
      missing_.add(unreadable);
    }
  }

  const WorldOptions& options_;
  MissingParts& missing_;
  const Log& log_;
  NamePatterns ignored_;
  StonefishShapes shapes_;
  std::set<std::string> names_;
  std::map<std::string, int> copies_;  // By name, how many have got another.
  Scene scene_;
};

}  // namespace

Scene load_stonefish_scene(const std::filesystem::path& path, const WorldOptions& options, const Log& log) {
  MissingParts missing;
  const StonefishSource source(path, options.arguments, missing);
  const StonefishBodies bodies(source, missing);
  StonefishSceneBuilder builder(options, missing, log);
  for (const StonefishBody& body : bodies.bodies()) {
    builder.add(body);
  }
  Scene scene = builder.finish(path.string());
  log_line(log, Severity::kInfo,
           fmt::format("{}: z is down there: x stays, y and z change their signs", path.string()));
  bodies.report_not_read(path.string(), log);
  return scene;
}

}  // namespace insonify
