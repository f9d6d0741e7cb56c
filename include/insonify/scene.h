// scene.h -- the scene to insonify: instances of meshes, with poses and materials.

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/error.h"
#include "insonify/log.h"
#include "insonify/material.h"
#include "insonify/mesh.h"
#include "insonify/settings_table.h"

namespace insonify {

/// One mesh at one pose, with its materials.
struct Instance {
  std::string name = {};                  ///< Scoped as in SDF: "ship::hull::visual"; the file's stem for a bare mesh.
  std::shared_ptr<const Mesh> mesh = {};  ///< Not null.
  Pose world_from_mesh = {};
  std::string user_material = {};  ///< Set by the user for the whole instance, "": not set; must resolve.
  bool names_resolve = false;      ///< Whether the user wrote the mesh's material names: each but "" must be known.
  std::vector<std::uint16_t> materials = {};  ///< Index into Scene::materials for each of the mesh's slots.
  std::vector<std::shared_ptr<const Relief>> reliefs = {};  ///< Relief of each slot, null for none; empty: none at all.
  bool moving = false;   ///< Whether its pose may change between pings; engines keep it separate from static instances.
  bool present = true;   ///< False after removal: engines ignore it, and its index is free.
  bool endless = false;  ///< Whether it is unbounded, as the sea surface: bounds() ignores it.
};

/// Checks that all vertices of an instance are within the limits of coordinate() in the world.
/// @param what  Name of the instance in the message, with the place in the file.
/// @throws Error "PATH:LINE:COLUMN: visual 'buoy' reaches x = 1e+18 m, must be from -10000000 to 10000000 m".
void check_reach(const Instance& instance, std::string_view what);

/// Changes of one material in a scenario: a library material to start from, changed properties, or both.
struct MaterialOverride {
  std::string like = {};  ///< Name of a library material to start from; "" for the one of this name, else the default.
  std::optional<double> density = {};            ///< [kg/m^3]
  std::optional<double> sound_speed = {};        ///< [m/s]
  std::optional<double> shear_speed = {};        ///< [m/s]
  std::optional<double> loss = {};               ///< 0..1
  std::optional<double> reflectivity = {};       ///< 0..1
  std::optional<double> lambert_db = {};         ///< [dB]
  std::optional<double> reflection = {};         ///< 0..1
  std::optional<double> thickness = {};          ///< [m]
  std::optional<double> transmission = {};       ///< 0..1
  std::optional<double> open_share = {};         ///< 0..1
  std::optional<double> rms_slope = {};          ///< 0.005..1
  std::optional<double> rms_height = {};         ///< [m]
  std::optional<double> clutter_shape = {};      ///< 0.1..1000
  std::optional<double> clutter_length = {};     ///< [m]
  std::optional<double> scatterer_density = {};  ///< [1/m^2]
  ReliefConfig relief_config = {};               ///< Description from which load_scene() makes `relief`.
  std::shared_ptr<const Relief> relief = {};

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"like", "", {}, "Library material to start from; the one of this name when absent."}, self.like);
    visit_material_fields(self, visit);
    ReliefConfig::visit_fields(self.relief_config, visit);
  }
};

/// Rules by which assign_materials() chooses the material of each surface. Keys of `overrides` match the name of a
/// visual, a link or a model (in full, or its last part) or else a material's name.
struct MaterialRules {
  std::map<std::string, MaterialOverride> overrides = {};
  std::string default_material = "sand";  ///< For material names in meshes that match nothing.
  bool for_more = false;  ///< Whether the scene is only part of the rules' world: keys may match nothing.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"default_material", "", {}, "Material of surfaces whose own material name matches nothing."},
          self.default_material);
  }
};

/// An axis-aligned box.
struct Box3 {
  Vec3 low, high;  ///< [m]; low > high when empty.
};

/// Instances and the materials they use.
struct Scene {
  std::vector<Material> materials;  ///< The materials in use. At most 65535.
  std::vector<Instance> instances;  ///< At most 65535.
  Places places = {};               ///< Places of user_material in the file, by instance name; for messages.

  [[nodiscard]] std::size_t triangle_count() const;
  [[nodiscard]] Box3 bounds() const;

  /// Middle of the bounds, or the origin if they are empty. Engines store positions relative to it.
  [[nodiscard]] Vec3 middle() const;

  /// Indices of the present instances that enclose a point as a solid does: their surface is seen from within in nine
  /// tenths of all directions, minus those seen from outside.
  [[nodiscard]] std::vector<int> solids_around(const Vec3& point) const;

  /// Index of the instance with this full name, or of the only one whose name starts with `name::`; -1 if there is
  /// none.
  [[nodiscard]] int find_instance(std::string_view name) const;
};

/// Assigns a material to every slot of every instance, the first of: an override with the object's name, unless it also
/// is the name of some slots; the instance's user_material; an override with the slot's name; the library's of that
/// name; the default. user_material and the default may name an override too. Each override becomes a material, named
/// by its key. Slot names that got the default are reported to `log`. The relief of a slot is that of its material, or
/// else of its mesh.
/// @throws Error for a name written by the user (an override's key or `like`, a user_material, a name of an
///         instance with names_resolve, the default) that matches nothing, and for a property out of its limits.
void assign_materials(Scene& scene, const MaterialRules& rules, const Log& log = {});

}  // namespace insonify
