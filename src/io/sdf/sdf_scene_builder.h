// sdf_scene_builder.h -- walks through worlds, models and links and adds their visuals or collisions to a scene.

#pragma once

#include <set>
#include <string>
#include <vector>

#include "insonify/files.h"
#include "insonify/log.h"
#include "insonify/scene.h"
#include "io/file/missing_parts.h"
#include "io/file/name_patterns.h"
#include "io/sdf/sdf_models.h"
#include "io/world/shape_maker.h"

namespace insonify {

/// Makes one scene from everything added.
class SdfSceneBuilder {
 public:
  /// @param missing  Receives missing and unreadable files of meshes and heightmaps.
  /// All arguments must outlive this object.
  SdfSceneBuilder(const WorldOptions& options, MissingParts& missing, const Log& log)
      : options_(options), missing_(missing), log_(log), ignored_(options.ignore), shapes_(log) {}

  /// Counts the shapes of a model that add_world() or add_model() will add, before the first of them does.
  void expect_shapes(const SdfModel& model);

  /// Adds all models of a world, at the poses of its <state> if there is one.
  /// @throws Error "path:line:column: ..." for faults.
  void add_world(const SdfWorld& world);

  /// Adds a model outside of worlds.
  void add_model(const SdfModel& model);

  /// Returns the scene, and reports to the log what is not in it, or differs from its appearance.
  /// @param file  Its name in messages.
  /// @throws Error if the scene is empty, or, with WorldOptions::strict, parts of it are missing.
  Scene finish(const std::string& file);

 private:
  // A material and the place of the element that names it.
  struct MaterialName {
    std::string name = {};
    Place place = {};
  };

  template <typename Add>
  bool add_or_skip(const Add& add);
  void add_top_model(const SdfModel& model, const std::string& name, const Pose& world_from_model);
  void add_model(const SdfModel& model, const std::string& name, const Pose& world_from_model, MaterialName material);
  void add_link(const SdfLink& link, const std::string& scope, const Pose& world_from_model, MaterialName material);
  void add_part(const SdfPart& part, const char* kind, const std::string& scope, const Pose& world_from_link,
                const MaterialName& material);
  [[nodiscard]] static MaterialName own_or(const MaterialName& inherited, const SdfElement& element,
                                           const std::string& where);
  std::vector<PlacedMesh> make(const SdfPart& part, const std::string& where);
  void add_instance(Instance instance, const SdfPart& part, const MaterialName& material);
  void warn(const std::string& file, const std::string& text, const std::vector<std::string>& names) const;
  [[nodiscard]] std::string nothing_in(const std::string& file) const;

  const WorldOptions& options_;
  MissingParts& missing_;
  const Log& log_;
  NamePatterns ignored_;
  ShapeMaker shapes_;
  bool collisions_ = false;  // Whether the current model uses its collision shapes.
  std::vector<std::string> without_visuals_, unreadable_visuals_, water_, for_eyes_;
  std::set<std::string> names_;
  std::size_t visual_count_ = 0, collision_count_ = 0;
  Scene scene_;
};

}  // namespace insonify
