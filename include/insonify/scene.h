// scene.h -- what there is to insonify: meshes placed in the world, each made of something.

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/field.h"
#include "insonify/log.h"
#include "insonify/material.h"
#include "insonify/mesh.h"

namespace insonify {

/// One mesh at one place.
struct Instance {
  std::string name = {};                  ///< Scoped as in SDF: "ship::hull::visual"; the file's stem for a bare mesh.
  std::shared_ptr<const Mesh> mesh = {};  ///< Never null.
  Pose world_from_mesh = {};
  std::string user_material = {};  ///< Set by the user for the whole instance, "" when not; must resolve.
  std::string where = {};          ///< "path:line:column: " of what set user_material, for messages; may be "".
  std::vector<std::uint16_t> materials = {};  ///< Index into Scene::materials for each of the mesh's slots.
  std::vector<std::shared_ptr<const Relief>> reliefs = {};  ///< Of each slot, null for none; empty: none at all.
  bool moving = false;  ///< Its pose may change between pings; engines keep it apart from what stands still.
};

/// Checks that every vertex of an instance is at a coordinate() of the world.
/// @param what  How the message calls it, place included.
/// @throws Error "PATH:LINE:COLUMN: visual 'buoy' reaches x = 1e+18 m, must be from -10000000 to 10000000 m".
void check_reach(const Instance& instance, std::string_view what);

/// What a scenario says of one material: a library name, changed properties, or both.
struct MaterialOverride {
  std::string like = {};  ///< Name of a library material to start from; "" for the one of this name, else the default.
  std::optional<double> density = {};            ///< [kg/m^3]
  std::optional<double> sound_speed = {};        ///< [m/s]
  std::optional<double> reflectivity = {};       ///< 0..1
  std::optional<double> lambert_db = {};         ///< [dB]
  std::optional<double> reflection = {};         ///< 0..1
  std::optional<double> thickness = {};          ///< [m]
  std::optional<double> rms_slope = {};          ///< 0.005..1
  std::optional<double> clutter_shape = {};      ///< 0.1..1000
  std::optional<double> scatterer_density = {};  ///< [1/m^2]
  ReliefConfig relief_config = {};               ///< What `relief` is to be made from, see load_scene().
  std::shared_ptr<const Relief> relief = {};
  std::string where = {};       ///< "path:line:column: " of the entry for messages, may be "".
  std::string like_where = {};  ///< Of `like`, where that has a place of its own.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"like", "", {}, "Material of the library to start from; the one of this name when absent."}, self.like);
    visit_material_fields(self, visit);
    ReliefConfig::visit_fields(self.relief_config, visit);
  }
};

/// Which material each surface is made of. Keys match a visual's name (whole or its last part), else a material's name.
struct MaterialRules {
  std::map<std::string, MaterialOverride> overrides = {};
  std::string default_material = "sand";  ///< For a mesh's own names that match nothing.
  std::string default_where = {};         ///< "path:line:column: " of it for messages, may be "".

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"default_material", "", {}, "What a surface is made of whose own material name matches nothing."},
          self.default_material);
  }
};

struct Box3 {
  Vec3 low, high;  ///< [m]; low > high when empty.
};

struct Scene {
  std::vector<Material> materials;  ///< Those in use. At most 65535.
  std::vector<Instance> instances;  ///< At most 65535.

  [[nodiscard]] std::size_t triangle_count() const;
  [[nodiscard]] Box3 bounds() const;

  /// Index of the instance of that whole name, or of the only one whose name starts with `name::`; -1 when there is
  /// none.
  [[nodiscard]] int find_instance(std::string_view name) const;
};

/// Gives every slot of every instance its material, in this order: an override of the visual's name; the instance's
/// user_material; an override of the slot's own name; the library's material of that name; the default. A user_material
/// and the default may name an override too. Each override is a material of its own, called by its key. Names of meshes
/// that took the default are told to `log` in one line. A slot's relief is its material's, else its mesh's own.
/// @throws Error for a name the user wrote (an override's key or `like`, a user_material, the default) that matches
/// nothing, and for a property out of its limits.
void assign_materials(Scene& scene, const MaterialRules& rules, const Log& log = {});

}  // namespace insonify
