// stonefish_element.h -- an element of a Stonefish scenario, and its attributes as numbers, vectors and poses.

#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "insonify/error.h"
#include "insonify/geometry.h"
#include "io/file/missing_parts.h"
#include "io/file/xml_file.h"

namespace insonify {

/// An element, which keeps the tree of its file alive.
struct StonefishElement {
  pugi::xml_node node;
  std::shared_ptr<const XmlFile> file;
  std::filesystem::path path;  ///< The file, absolute; other files are looked for from its folder.

  explicit operator bool() const { return static_cast<bool>(node); }
  /// The first child of this name; false if there is none.
  [[nodiscard]] StonefishElement child(const char* name) const { return {node.child(name), file, path}; }
  [[nodiscard]] std::string name() const { return node.attribute("name").value(); }
  [[nodiscard]] std::string type() const { return node.attribute("type").value(); }
  /// Prefix of messages: "pool.scn:3:5: static 'wall'".
  [[nodiscard]] std::string what() const;
};

// Attributes of an element's child, <dimensions radius="2"/> of a body; of the element itself if `child` is "". Each
// throws Error if the child or the attribute is missing or malformed, and UnreadablePart if its value is a
// $(param ...), a $(find ...) or a $(arg ...) without a value, or a formula in ${...}.

[[nodiscard]] std::string stonefish_text(const StonefishElement& element, const char* child, const char* attribute);

/// A finite number.
[[nodiscard]] double stonefish_number(const StonefishElement& element, const char* child, const char* attribute);
[[nodiscard]] double stonefish_number_or(const StonefishElement& element, const char* child, const char* attribute,
                                         double otherwise);
/// A length > 0 [m].
[[nodiscard]] double stonefish_length(const StonefishElement& element, const char* child, const char* attribute);

/// Three finite numbers.
[[nodiscard]] Vec3 stonefish_vector(const StonefishElement& element, const char* child, const char* attribute);

/// A pose of attributes xyz [m] and rpy [rad]: roll about x, then pitch about y, then yaw about z, fixed axes.
/// @throws Error also for coordinates out of the limits of coordinate().
[[nodiscard]] Pose stonefish_pose(const StonefishElement& element, const char* child);

/// Turns Stonefish's axes (x north or forward, y east or to starboard, z down) into ours (y to port, z up), and back:
/// half a turn about x.
[[nodiscard]] Pose up_from_down();

}  // namespace insonify
