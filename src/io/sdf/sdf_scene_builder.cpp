// sdf_scene_builder.cpp -- adds models, links, visuals and collisions with their poses and materials.

#include "io/sdf/sdf_scene_builder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/input_file.h"
#include "io/sdf/sdf_material.h"
#include "io/sdf/sdf_poses.h"
#include "io/world/water_shapes.h"

namespace insonify {
namespace {

std::size_t visual_count(const sdf::Model& model) {
  std::size_t count = 0;
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    count += model.LinkByIndex(i)->VisualCount();
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    count += visual_count(*model.ModelByIndex(i));
  }
  return count;
}

// Pose of a model, link, visual or collision in its parent.
template <typename Part>
Pose resolve(const Part& part, const std::string& where) {
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

}  // namespace

Place SdfSceneBuilder::place(sdf::Element& element) const {
  if (!element.LineNumber()) {
    return {source_.shown(element.FilePath())};
  }
  const std::string name = element.HasAttribute("name") ? element.GetAttribute("name")->GetAsString() : "";
  return source_.place(element.FilePath(), *element.LineNumber(), element.GetName(), name);
}

// "path:line:column: visual 'a::b::c'"
std::string SdfSceneBuilder::what(const char* kind, const std::string& name, sdf::Element& element) const {
  return fmt::format("{}{} '{}'", place(element).text(), kind, printable(name, kLongestName));
}

SdfSceneBuilder::MaterialName SdfSceneBuilder::own_or(const MaterialName& inherited, const sdf::ElementPtr& element,
                                                      const std::string& where) const {
  const std::string own = sdf_material(element, where);
  return own.empty() ? inherited : MaterialName{own, place(*element)};
}

// Adds something that is skipped with its fault. Returns whether it could be read.
template <typename Add>
bool SdfSceneBuilder::add_or_skip(const Add& add) {
  try {
    add();
    return true;
  } catch (const UnreadablePart& unreadable) {
    missing_.add(unreadable);
  } catch (const InsonifyElementError&) {
    throw;
  } catch (const Error& error) {
    if (options_.strict) {
      throw;
    }
    missing_.add(error.what(), "");
  }
  return false;
}

// How much of the light behind a visual it stops, from 0 to 1.
double SdfSceneBuilder::opacity(const sdf::Visual& visual) const {
  return (1 - static_cast<double>(visual.Transparency())) * source_.opacity(place(*visual.Element()).text());
}

bool SdfSceneBuilder::is_painted_as_water(const sdf::Visual& visual) const {
  return source_.is_water(place(*visual.Element()).text());
}

template <typename Part>
void SdfSceneBuilder::add_part(const Part& part, const char* kind, const std::string& scope,
                               const Pose& world_from_link, const MaterialName& material) {
  const std::string name = scope + part.Name();
  if (ignored_.match(name)) {
    return;
  }
  const std::string where = what(kind, name, *part.Element());
  const std::optional<PlacedMesh> shape = shapes_.shape(*part.Geom(), where, collisions_);
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
  if (own.name.empty() && !options_.keep_water) {
    constexpr double kClear = 0.5;
    const double opaque = opacity(part);
    if (is_water_name(name) || is_painted_as_water(part) || (opaque < kClear && is_level_sheet(instance))) {
      water_.push_back(printable(name, kLongestName));
      return;
    }
    if (opaque <= 0) {
      for_eyes_.push_back(printable(name, kLongestName));
    }
  }
  instance.user_material = own.name;
  scene_.places[name] = own.place;
  scene_.instances.push_back(std::move(instance));
}

void SdfSceneBuilder::add_link(const sdf::Link& link, const std::string& scope, const Pose& world_from_model,
                               MaterialName material) {
  const std::string name = scope + link.Name();
  if (ignored_.match(name)) {
    return;
  }
  const std::string where = what("link", name, *link.Element());
  const Pose world_from_link = world_from_model * resolve(link, where);
  material = own_or(material, link.Element(), where);
  visual_count_ += link.VisualCount();
  collision_count_ += link.CollisionCount();
  const auto add_collisions = [&] {
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
      add_or_skip([&] { add_part(*link.CollisionByIndex(i), "collision", name + "::", world_from_link, material); });
    }
  };
  if (collisions_) {
    add_collisions();
    return;
  }
  std::uint64_t unreadable = 0;
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    unreadable +=
        add_or_skip([&] { add_part(*link.VisualByIndex(i), "visual", name + "::", world_from_link, material); }) ? 0
                                                                                                                 : 1;
  }
  if (unreadable > 0 && unreadable == link.VisualCount() && link.CollisionCount() > 0) {
    add_collisions();
    unreadable_visuals_.push_back(printable(name, kLongestName));
  }
}

// `material` applies to all parts that name none themselves.
void SdfSceneBuilder::add_model(const sdf::Model& model, const std::string& name, const Pose& world_from_model,
                                MaterialName material) {
  if (ignored_.match(name)) {
    return;
  }
  material = own_or(material, model.Element(), what("model", name, *model.Element()));
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    add_or_skip([&] { add_link(*model.LinkByIndex(i), name + "::", world_from_model, material); });
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    add_or_skip([&] {
      const sdf::Model& inner = *model.ModelByIndex(i);
      const Pose model_from_inner = resolve(inner, what("model", name + "::" + inner.Name(), *inner.Element()));
      add_model(inner, name + "::" + inner.Name(), world_from_model * model_from_inner, material);
    });
  }
}

// A model without a visual has its collision shapes insonified, or a scene would lack it in silence.
void SdfSceneBuilder::add_top_model(const sdf::Model& model, const std::string& name, const Pose& world_from_model) {
  collisions_ = options_.collisions || visual_count(model) == 0;
  const std::size_t before = scene_.instances.size();
  add_model(model, name, world_from_model, {});
  if (!options_.collisions && collisions_ && scene_.instances.size() > before) {
    without_visuals_.push_back(printable(name, kLongestName));
  }
}

// In the order of the file: the twins that stand before each model, then the model.
void SdfSceneBuilder::add_world(const sdf::World& world) {
  const std::map<std::string, Pose> saved = sdf_saved_poses(world);
  const auto add = [&](const sdf::Model& model, const std::string& name, const Pose& own) {
    const auto found = saved.find(name);
    add_top_model(model, name, found == saved.end() ? own : found->second);
  };
  const std::vector<SdfTwin>& twins = source_.twins().twins;
  auto twin = twins.begin();
  for (std::uint64_t i = 0; i <= world.ModelCount(); ++i) {
    for (; twin != twins.end() && twin->before == i; ++twin) {
      add_or_skip([&] { add(*world.ModelByIndex(twin->first), twin->name, twin->pose); });
    }
    if (i < world.ModelCount()) {
      const sdf::Model& model = *world.ModelByIndex(i);
      add_or_skip([&] { add(model, model.Name(), resolve(model, what("model", model.Name(), *model.Element()))); });
    }
  }
}

void SdfSceneBuilder::add_model(const sdf::Model& model) {
  add_or_skip(
      [&] { add_top_model(model, model.Name(), resolve(model, what("model", model.Name(), *model.Element()))); });
}

void SdfSceneBuilder::warn(const std::string& file, const std::string& text,
                           const std::vector<std::string>& names) const {
  if (!names.empty()) {
    log_line(log_, Severity::kWarning, fmt::format("{}: {}: {}", file, text, fmt::join(names, ", ")));
  }
}

std::string SdfSceneBuilder::nothing_in(const std::string& file) const {
  const std::size_t left_out = options_.collisions ? collision_count_ : visual_count_;
  const std::size_t others = options_.collisions ? visual_count_ : collision_count_;
  const char* other = options_.collisions ? "visual" : "collision shape";
  std::string text =
      fmt::format("{}: there is no {} to insonify", file, options_.collisions ? "collision shape" : "visual");
  if (ignored_.any()) {
    return text + " except what `ignore` removes";
  }
  if (!water_.empty()) {
    return text + fmt::format(" except water (keep_water: true keeps it): {}", fmt::join(water_, ", "));
  }
  if (left_out > 0) {
    text += fmt::format(", {} left out", left_out);
  }
  if (others > 0) {
    return text +
           fmt::format(", but {} {}{} (collisions: {})", others, other, others == 1 ? "" : "s", !options_.collisions);
  }
  return text + fmt::format(", and no {}", other);
}

Scene SdfSceneBuilder::finish(const std::string& file) {
  if (!missing_.empty() && (options_.strict || !scene_.instances.empty())) {
    missing_.report(file, options_.strict, log_);
  }
  if (scene_.instances.empty()) {
    throw Error(missing_.empty() ? nothing_in(file)
                                 : fmt::format("{}: nothing is left to insonify: {}", file, missing_.whole_text()));
  }
  warn(file, "of models without visuals the collision shapes are insonified (ignore removes them)", without_visuals_);
  warn(file, "of links whose visuals cannot be read the collision shapes are insonified (ignore removes it)",
       unreadable_visuals_);
  warn(file, "left out as water (keep_water: true keeps it)", water_);
  warn(file, "what is invisible to cameras echoes as a solid surface (ignore removes it)", for_eyes_);
  ignored_.report_unused(file, log_);
  return std::move(scene_);
}

}  // namespace insonify
