// sdf_scene.cpp -- walks through worlds, models and links and adds their visuals or collisions to a scene.

#include "io/world/sdf_scene.h"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <sdf/Collision.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>
#include <set>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/world/sdf_console.h"
#include "io/world/sdf_material.h"
#include "io/world/sdf_math.h"
#include "io/world/sdf_root.h"
#include "io/world/sdf_shape.h"

namespace insonify {
namespace {

// A material and the place of the element that names it.
struct MaterialName {
  std::string name = {};
  Place place = {};
};

Pose pose_of(const sdf_math::Pose3d& pose) {
  const auto& p = pose.Pos();
  const auto& q = pose.Rot();
  return {{p.X(), p.Y(), p.Z()}, Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized()};
}

// Poses of models in the world at the time when Gazebo saved it, by name. The first of several states is used, as in
// Gazebo.
std::map<std::string, Pose> saved_poses(const sdf::World& world) {
  std::map<std::string, Pose> poses;
  if (!world.Element()->HasElement("state")) {
    return poses;
  }
  const sdf::ElementPtr state = world.Element()->GetElement("state");
  if (state->Get<std::string>("world_name") != world.Name()) {
    return poses;
  }
  for (sdf::ElementPtr model = state->HasElement("model") ? state->GetElement("model") : nullptr; model != nullptr;
       model = model->GetNextElement("model")) {
    if (model->HasElement("pose")) {
      poses[model->Get<std::string>("name")] = pose_of(model->Get<sdf_math::Pose3d>("pose"));
    }
  }
  return poses;
}

class SceneBuilder {
 public:
  SceneBuilder(const SdfSource& source, bool collisions, const Log& log)
      : source_(source), collisions_(collisions), log_(log), shapes_(source, log) {}

  void add_world(const sdf::World& world) {
    const std::map<std::string, Pose> saved = saved_poses(world);
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      const Pose own = resolve(model, what("model", model.Name(), *model.Element()));
      const auto found = saved.find(model.Name());
      add_model(model, "", found == saved.end() ? own : found->second, {});
    }
  }

  void add_model(const sdf::Model& model) {
    add_model(model, "", resolve(model, what("model", model.Name(), *model.Element())), {});
  }

  // Returns the scene. Throws if it is empty.
  Scene finish(const std::string& file) {
    if (scene_.instances.empty()) {
      throw Error(nothing_in(file));
    }
    return std::move(scene_);
  }

 private:
  // `material` applies to all parts that name none themselves.
  void add_model(const sdf::Model& model, const std::string& scope, const Pose& world_from_model,
                 MaterialName material) {
    const std::string name = scope + model.Name();
    material = own_or(material, model.Element(), what("model", name, *model.Element()));
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      add_link(*model.LinkByIndex(i), name + "::", world_from_model, material);
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const sdf::Model& inner = *model.ModelByIndex(i);
      const Pose model_from_inner = resolve(inner, what("model", name + "::" + inner.Name(), *inner.Element()));
      add_model(inner, name + "::", world_from_model * model_from_inner, material);
    }
  }

  [[nodiscard]] Place place(sdf::Element& element) const {
    if (!element.LineNumber()) {
      return {source_.shown(element.FilePath())};
    }
    const std::string name = element.HasAttribute("name") ? element.GetAttribute("name")->GetAsString() : "";
    return source_.place(element.FilePath(), *element.LineNumber(), element.GetName(), name);
  }

  // "path:line:column: visual 'a::b::c'"
  [[nodiscard]] std::string what(const char* kind, const std::string& name, sdf::Element& element) const {
    return fmt::format("{}{} '{}'", place(element).text(), kind, printable(name, kLongestName));
  }

  // Pose of a model, link, visual or collision in its parent.
  template <typename Part>
  static Pose resolve(const Part& part, const std::string& where) {
    sdf_math::Pose3d pose;
    const sdf::Errors errors = part.SemanticPose().Resolve(pose);
    if (!errors.empty()) {
      throw Error(where + ": its pose cannot be worked out: " + foreign_reason(errors.front().Message()));
    }
    const sdf_math::Vector3d& position = pose.Pos();
    for (const double value : {position.X(), position.Y(), position.Z()}) {
      if (!coordinate().allow(value)) {
        throw Error(fmt::format("{}: <pose> = {} {} {} m must be {} m in each direction", where, position.X(),
                                position.Y(), position.Z(), coordinate().text()));
      }
    }
    return pose_of(pose);
  }

  [[nodiscard]] MaterialName own_or(const MaterialName& inherited, const sdf::ElementPtr& element,
                                    const std::string& where) const {
    const std::string own = sdf_material(element, where);
    return own.empty() ? inherited : MaterialName{own, place(*element)};
  }

  void add_link(const sdf::Link& link, const std::string& scope, const Pose& world_from_model, MaterialName material) {
    const std::string name = scope + link.Name();
    const std::string where = what("link", name, *link.Element());
    const Pose world_from_link = world_from_model * resolve(link, where);
    material = own_or(material, link.Element(), where);
    visual_count_ += link.VisualCount();
    collision_count_ += link.CollisionCount();
    for (std::uint64_t i = 0; !collisions_ && i < link.VisualCount(); ++i) {
      add_part(*link.VisualByIndex(i), "visual", name + "::", world_from_link, material);
    }
    for (std::uint64_t i = 0; collisions_ && i < link.CollisionCount(); ++i) {
      add_part(*link.CollisionByIndex(i), "collision", name + "::", world_from_link, material);
    }
  }

  template <typename Part>
  void add_part(const Part& part, const char* kind, const std::string& scope, const Pose& world_from_link,
                const MaterialName& material) {
    const std::string name = scope + part.Name();
    const std::string where = what(kind, name, *part.Element());
    const std::optional<SdfShape> shape = shapes_.shape(*part.Geom(), where, collisions_);
    if (!shape) {
      return;
    }
    if (!names_.insert(name).second) {
      throw Error(where + " has the name of another one");
    }
    Instance instance;
    instance.name = name;
    instance.mesh = shape->mesh;
    instance.world_from_mesh = world_from_link * resolve(part, where) * Pose{shape->offset};
    check_reach(instance, where);
    const MaterialName own = own_or(material, part.Element(), where);
    instance.user_material = own.name;
    scene_.places[name] = own.place;
    scene_.instances.push_back(std::move(instance));
  }

  [[nodiscard]] std::string nothing_in(const std::string& file) const {
    const std::size_t left_out = collisions_ ? collision_count_ : visual_count_;
    const std::size_t others = collisions_ ? visual_count_ : collision_count_;
    const char* other = collisions_ ? "visual" : "collision shape";
    std::string text = fmt::format("{}: there is no {} to insonify", file, collisions_ ? "collision shape" : "visual");
    if (left_out > 0) {
      text += fmt::format(", {} left out", left_out);
    }
    if (others > 0) {
      text += fmt::format(", but {} {}{} (collisions: {})", others, other, others == 1 ? "" : "s", !collisions_);
    } else {
      text += fmt::format(", and no {}", other);
    }
    return text;
  }

  const SdfSource& source_;
  bool collisions_;
  const Log& log_;
  SdfShapes shapes_;
  std::set<std::string> names_;
  std::size_t visual_count_ = 0, collision_count_ = 0;
  Scene scene_;
};

}  // namespace

Scene load_sdf_scene(const std::filesystem::path& path, bool collisions, const Log& log) {
  static std::mutex one_at_a_time;  // libsdformat's settings and std::cerr are global.
  const std::lock_guard lock(one_at_a_time);
  const SdfSource source(path, log);
  const sdf::Root root = read_sdf_root(source, log);

  SceneBuilder builder(source, collisions, log);
  for (std::uint64_t w = 0; w < root.WorldCount(); ++w) {
    builder.add_world(*root.WorldByIndex(w));
  }
  if (root.Model() != nullptr) {
    builder.add_model(*root.Model());
  }
  return builder.finish(path.string());
}

}  // namespace insonify
