// sdf_scene.cpp -- walks through worlds, models and links and adds their visuals or collisions to a scene.

#include "io/world/sdf_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <mutex>
#include <sdf/Collision.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>
#include <set>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/world/sdf_console.h"
#include "io/world/sdf_material.h"
#include "io/world/sdf_math.h"
#include "io/world/sdf_missing.h"
#include "io/world/sdf_name_patterns.h"
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
  SceneBuilder(const SdfSource& source, const WorldOptions& options, SdfMissing& missing, const Log& log)
      : source_(source),
        options_(options),
        missing_(missing),
        log_(log),
        ignored_(options.ignore),
        shapes_(source, log) {}

  void add_world(const sdf::World& world) {
    const std::map<std::string, Pose> saved = saved_poses(world);
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      const sdf::Model& model = *world.ModelByIndex(i);
      const Pose own = resolve(model, what("model", model.Name(), *model.Element()));
      const auto found = saved.find(model.Name());
      add_top_model(model, found == saved.end() ? own : found->second);
    }
  }

  void add_model(const sdf::Model& model) {
    add_top_model(model, resolve(model, what("model", model.Name(), *model.Element())));
  }

  // Returns the scene and reports what is not in it. Throws if it is empty.
  Scene finish(const std::string& file) {
    if (!missing_.empty() && (options_.strict || !scene_.instances.empty())) {
      missing_.report(file, options_.strict, log_);
    }
    if (scene_.instances.empty()) {
      throw Error(missing_.empty() ? nothing_in(file)
                                   : fmt::format("{}: nothing is left to insonify: {}", file, missing_.whole_text()));
    }
    if (!without_visuals_.empty()) {
      log_line(
          log_, Severity::kWarning,
          fmt::format("{}: of models without visuals the collision shapes are insonified (ignore leaves them out): {}",
                      file, fmt::join(without_visuals_, ", ")));
    }
    if (!for_eyes_.empty()) {
      log_line(
          log_, Severity::kWarning,
          fmt::format("{}: what is water or invisible to cameras echoes as a solid surface (ignore leaves it out): {}",
                      file, fmt::join(for_eyes_, ", ")));
    }
    for (const std::string& pattern : ignored_.unused()) {
      log_line(log_, Severity::kWarning,
               fmt::format("{}: ignore: '{}' is the name of nothing in the world", file, printable(pattern)));
    }
    return std::move(scene_);
  }

 private:
  static std::size_t visual_count(const sdf::Model& model) {
    std::size_t count = 0;
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      count += model.LinkByIndex(i)->VisualCount();
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      count += visual_count(*model.ModelByIndex(i));
    }
    return count;
  }

  // A model without a visual has its collision shapes insonified, or a scene would lack it in silence.
  void add_top_model(const sdf::Model& model, const Pose& world_from_model) {
    collisions_ = options_.collisions || visual_count(model) == 0;
    const std::size_t before = scene_.instances.size();
    add_model(model, "", world_from_model, {});
    if (!options_.collisions && collisions_ && scene_.instances.size() > before) {
      without_visuals_.push_back(printable(model.Name(), kLongestName));
    }
  }

  // `material` applies to all parts that name none themselves.
  void add_model(const sdf::Model& model, const std::string& scope, const Pose& world_from_model,
                 MaterialName material) {
    const std::string name = scope + model.Name();
    if (ignored_.match(name)) {
      return;
    }
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
    if (ignored_.match(name)) {
      return;
    }
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

  std::optional<SdfShape> shape_or_none(const sdf::Geometry& geometry, const std::string& where) {
    try {
      return shapes_.shape(geometry, where, collisions_);
    } catch (const SdfUnreadable& file) {
      if (file.fuel_uri.empty()) {
        missing_.add(file.part, file.reason);
      } else {
        missing_.add_fuel(file.part, file.reason, file.fuel_uri);
      }
      return std::nullopt;
    }
  }

  // Whether a visual is water or invisible: not meant to stop anything.
  [[nodiscard]] bool is_for_eyes_only(const sdf::Visual& visual) const {
    return visual.Transparency() >= 1 || source_.is_water(place(*visual.Element()).text());
  }
  [[nodiscard]] static bool is_for_eyes_only(const sdf::Collision& /*collision*/) { return false; }

  template <typename Part>
  void add_part(const Part& part, const char* kind, const std::string& scope, const Pose& world_from_link,
                const MaterialName& material) {
    const std::string name = scope + part.Name();
    if (ignored_.match(name)) {
      return;
    }
    const std::string where = what(kind, name, *part.Element());
    const std::optional<SdfShape> shape = shape_or_none(*part.Geom(), where);
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
    if (own.name.empty() && is_for_eyes_only(part)) {
      for_eyes_.push_back(printable(name, kLongestName));
    }
    instance.user_material = own.name;
    scene_.places[name] = own.place;
    scene_.instances.push_back(std::move(instance));
  }

  [[nodiscard]] std::string nothing_in(const std::string& file) const {
    const std::size_t left_out = options_.collisions ? collision_count_ : visual_count_;
    const std::size_t others = options_.collisions ? visual_count_ : collision_count_;
    const char* other = options_.collisions ? "visual" : "collision shape";
    std::string text =
        fmt::format("{}: there is no {} to insonify", file, options_.collisions ? "collision shape" : "visual");
    if (ignored_.any()) {
      return text + " but what `ignore` leaves out";
    }
    if (left_out > 0) {
      text += fmt::format(", {} left out", left_out);
    }
    if (others > 0) {
      text +=
          fmt::format(", but {} {}{} (collisions: {})", others, other, others == 1 ? "" : "s", !options_.collisions);
    } else {
      text += fmt::format(", and no {}", other);
    }
    return text;
  }

  const SdfSource& source_;
  const WorldOptions& options_;
  SdfMissing& missing_;
  const Log& log_;
  SdfNamePatterns ignored_;
  SdfShapes shapes_;
  bool collisions_ = false;  // Whether the model at hand is made of its collision shapes.
  std::vector<std::string> without_visuals_, for_eyes_;
  std::set<std::string> names_;
  std::size_t visual_count_ = 0, collision_count_ = 0;
  Scene scene_;
};

// The files of a world, and what libsdformat makes of them.
struct Parsed {
  std::unique_ptr<SdfSource> source;
  sdf::Root root;
};

Parsed parse(const std::filesystem::path& path, bool joints, bool strict, SdfMissing& missing, const Log& log) {
  Parsed parsed;
  parsed.source = std::make_unique<SdfSource>(path, joints, missing, log);
  if (strict) {
    missing.report(path.string(), strict, log);
  }
  try {
    parsed.root = read_sdf_root(*parsed.source, log);
  } catch (const Error& error) {
    throw missing.empty()
        ? error
        : Error(fmt::format("{}; what is missing may be the cause: {}", error.what(), missing.text()));
  }
  return parsed;
}

// Faults of joints, which have no shape, do no harm: where the file cannot be read it is tried again without them.
Parsed parse_with_or_without_joints(const std::filesystem::path& path, bool strict, SdfMissing& missing,
                                    const Log& log) {
  std::vector<std::pair<Severity, std::string>> said;
  const Log keep = [&](Severity severity, const std::string& line) { said.emplace_back(severity, line); };
  const auto tell = [&] {
    for (const auto& [severity, line] : said) {
      log_line(log, severity, line);
    }
  };
  Parsed parsed;
  SdfMissing found;
  try {
    parsed = parse(path, true, strict, found, keep);
  } catch (const Error& fault) {
    if (strict) {
      tell();
      throw;
    }
    said.clear();
    found = {};
    parsed = parse(path, false, strict, found, keep);
    found.add("the joints, which have no shapes,", fmt::format(" for a fault: {}", fault.what()));
  }
  tell();
  missing = found;
  return parsed;
}

}  // namespace

Scene load_sdf_scene(const std::filesystem::path& path, const WorldOptions& options, const Log& log) {
  static std::mutex one_at_a_time;  // libsdformat's settings and std::cerr are global.
  const std::lock_guard lock(one_at_a_time);
  SdfMissing missing;
  const Parsed parsed = parse_with_or_without_joints(path, options.strict, missing, log);

  SceneBuilder builder(*parsed.source, options, missing, log);
  for (std::uint64_t w = 0; w < parsed.root.WorldCount(); ++w) {
    builder.add_world(*parsed.root.WorldByIndex(w));
  }
  if (parsed.root.Model() != nullptr) {
    builder.add_model(*parsed.root.Model());
  }
  return builder.finish(path.string());
}

}  // namespace insonify
