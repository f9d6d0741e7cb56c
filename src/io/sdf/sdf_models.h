// sdf_models.h -- what is used of a file's models, without libsdformat's trees, which take a megabyte an element.

#pragma once

#include <map>
#include <optional>
#include <sdf/Root.hh>
#include <string>
#include <utility>
#include <vector>

#include "insonify/error.h"
#include "insonify/geometry.h"
#include "insonify/world_parts.h"
#include "io/sdf/sdf_source.h"

namespace insonify {

/// What a model, a link, a visual and a collision have in common. A fault is the end of a message that begins with the
/// element's place and name; "" where there is none.
struct SdfElement {
  std::string name;
  Place place;
  Pose pose;  ///< In its parent.
  std::string pose_fault;
  std::string material;  ///< Named by <insonify:material> in it; "" where there is none.
  std::string material_fault;
};

/// A visual or a collision.
struct SdfPart : SdfElement {
  std::optional<Shape> shape;  ///< Absent for one that insonify does not have.
  std::string unknown_shape;   ///< Name of its element; "" for a part without a shape.
  std::string file;            ///< The file that the shape's URI is relative to.
  double opacity = 1;          ///< From 0 to 1; of collisions 1.
  bool is_painted_as_water = false;
};

/// One of insonify's <sonar>.
struct SdfSonarElement {
  std::string name;
  Place place;
  std::vector<std::pair<std::string, std::string>> children;  ///< Names without the prefix, and texts.
};

struct SdfLink : SdfElement {
  std::vector<SdfPart> visuals, collisions;
  std::vector<SdfSonarElement> sonars;
};

struct SdfModel : SdfElement {
  std::vector<SdfLink> links;
  std::vector<SdfSonarElement> sonars;
  std::vector<SdfModel> models;

  [[nodiscard]] std::size_t visual_count() const;
};

struct SdfWorld {
  std::vector<SdfModel> models;
  std::map<std::string, Pose> saved_poses;  ///< See sdf_saved_poses().
};

/// The models of a file.
struct SdfModels {
  std::vector<SdfWorld> worlds;
  std::optional<SdfModel> model;  ///< Outside of worlds.

  /// Adds what a portion of the file has.
  void add(const SdfSource& source, const sdf::Root& root);

  /// Puts twins where they were taken out. Returns whether the models are those among which they were counted: an
  /// include may be any number of models.
  bool add_twins(const SdfTwins& twins);
};

}  // namespace insonify
