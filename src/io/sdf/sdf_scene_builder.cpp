// sdf_scene_builder.cpp -- adds models, links, visuals and collisions with their poses and materials.

#include "io/sdf/sdf_scene_builder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/sdf/sdf_material.h"
#include "io/world/water_shapes.h"

namespace insonify {
namespace {

// "path:line:column: visual 'a::b::c'"
std::string what(const char* kind, const std::string& name, const SdfElement& element) {
  return fmt::format("{}{} '{}'", element.place.text(), kind, printable(name, kLongestName));
}

// Pose of an element in its parent.
Pose resolve(const SdfElement& element, const std::string& where) {
  if (!element.pose_fault.empty()) {
    throw Error(where + element.pose_fault);
  }
  const Vec3& position = element.pose.position;
  for (const double value : position) {
    if (!coordinate().allow(value)) {
      throw Error(fmt::format("{}: <pose> = {} {} {} m must be {} m in each direction", where, position.x(),
                              position.y(), position.z(), coordinate().text()));
    }
  }
  return element.pose;
}

}  // namespace

SdfSceneBuilder::MaterialName SdfSceneBuilder::own_or(const MaterialName& inherited, const SdfElement& element,
                                                      const std::string& where) {
  if (!element.material_fault.empty()) {
    throw InsonifyElementError(where + element.material_fault);
  }
  return element.material.empty() ? inherited : MaterialName{element.material, element.place};
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

// The meshes of a visual: several if each part of its file is an instance, none for a shape that insonify lacks.
std::vector<PlacedMesh> SdfSceneBuilder::make(const SdfPart& part, const std::string& where) {
  const bool is_submesh = part.shape && !part.shape->submesh.empty();  // A part already.
  if (part.shape && part.shape->kind == ShapeKind::kMesh && options_.parts && !is_submesh) {
    return shapes_.make_parts(*part.shape, part.file, where);
  }
  if (part.shape) {
    return {shapes_.make(*part.shape, part.file, where)};
  }
  const std::string& name = part.unknown_shape;
  log_line(log_, Severity::kWarning,
           where + " is skipped: " +
               (name.empty() ? "it has no shape" : fmt::format("insonify has no shape <{}>", printable(name))));
  return {};
}

void SdfSceneBuilder::add_part(const SdfPart& part, const char* kind, const std::string& scope,
                               const Pose& world_from_link, const MaterialName& material) {
  const std::string name = scope + part.name;
  if (ignored_.match(name)) {
    return;
  }
  const std::string where = what(kind, name, part);
  const std::vector<PlacedMesh> shapes = make(part, where);
  if (shapes.empty()) {
    return;
  }
  if (!names_.insert(name).second) {
    throw Error(where + " has the name of another one");
  }
  const MaterialName own = own_or(material, part, where);
  for (const PlacedMesh& shape : shapes) {
    Instance instance;
    instance.name = shape.part.empty() ? name : name + "::" + shape.part;
    instance.mesh = shape.mesh;
    instance.world_from_mesh = world_from_link * resolve(part, where) * Pose{shape.offset};
    check_reach(instance, where);
    if (shape.part.empty() || !ignored_.match(instance.name)) {
      add_instance(std::move(instance), part, own);
    }
  }
}

// Unless it is water.
void SdfSceneBuilder::add_instance(Instance instance, const SdfPart& part, const MaterialName& material) {
  const std::string& name = instance.name;
  if (material.name.empty() && !options_.keep_water) {
    constexpr double kClear = 0.5;
    if (is_water_name(name) || part.is_painted_as_water || (part.opacity < kClear && is_level_sheet(instance))) {
      water_.push_back(printable(name, kLongestName));
      return;
    }
    if (part.opacity <= 0) {
      for_eyes_.push_back(printable(name, kLongestName));
    }
  }
  instance.user_material = material.name;
  scene_.places[name] = material.place;
  scene_.instances.push_back(std::move(instance));
}

void SdfSceneBuilder::add_link(const SdfLink& link, const std::string& scope, const Pose& world_from_model,
                               MaterialName material) {
  const std::string name = scope + link.name;
  if (ignored_.match(name)) {
    return;
  }
  const std::string where = what("link", name, link);
  const Pose world_from_link = world_from_model * resolve(link, where);
  material = own_or(material, link, where);
  visual_count_ += link.visuals.size();
  collision_count_ += link.collisions.size();
  const auto add_collisions = [&] {
    for (const SdfPart& collision : link.collisions) {
      add_or_skip([&] { add_part(collision, "collision", name + "::", world_from_link, material); });
    }
  };
  if (collisions_) {
    add_collisions();
    return;
  }
  std::size_t unreadable = 0;
  for (const SdfPart& visual : link.visuals) {
    unreadable += add_or_skip([&] { add_part(visual, "visual", name + "::", world_from_link, material); }) ? 0 : 1;
  }
  if (unreadable > 0 && unreadable == link.visuals.size() && !link.collisions.empty()) {
    add_collisions();
    unreadable_visuals_.push_back(printable(name, kLongestName));
  }
}

// `material` applies to all parts that name none themselves.
void SdfSceneBuilder::add_model(const SdfModel& model, const std::string& name, const Pose& world_from_model,
                                MaterialName material) {
  if (ignored_.match(name)) {
    return;
  }
  material = own_or(material, model, what("model", name, model));
  for (const SdfLink& link : model.links) {
    add_or_skip([&] { add_link(link, name + "::", world_from_model, material); });
  }
  for (const SdfModel& inner : model.models) {
    add_or_skip([&] {
      const std::string inner_name = name + "::" + inner.name;
      const Pose model_from_inner = resolve(inner, what("model", inner_name, inner));
      add_model(inner, inner_name, world_from_model * model_from_inner, material);
    });
  }
}

// A model without a visual has its collision shapes insonified, or a scene would lack it in silence.
void SdfSceneBuilder::add_top_model(const SdfModel& model, const std::string& name, const Pose& world_from_model) {
  collisions_ = options_.collisions || model.visual_count() == 0;
  const std::size_t before = scene_.instances.size();
  add_model(model, name, world_from_model, {});
  if (!options_.collisions && collisions_ && scene_.instances.size() > before) {
    without_visuals_.push_back(printable(name, kLongestName));
  }
}

void SdfSceneBuilder::expect_shapes(const SdfModel& model) {
  for (const SdfLink& link : model.links) {
    for (const auto* parts : {&link.visuals, &link.collisions}) {
      for (const SdfPart& part : *parts) {
        if (part.shape && (parts == &link.collisions) == (options_.collisions || link.visuals.empty())) {
          shapes_.expect(*part.shape);
        }
      }
    }
  }
  std::ranges::for_each(model.models, [&](const SdfModel& inner) { expect_shapes(inner); });
}

void SdfSceneBuilder::add_world(const SdfWorld& world) {
  for (const SdfModel& model : world.models) {
    add_or_skip([&] {
      const auto saved = world.saved_poses.find(model.name);
      const Pose own = resolve(model, what("model", model.name, model));
      add_top_model(model, model.name, saved == world.saved_poses.end() ? own : saved->second);
    });
  }
}

void SdfSceneBuilder::add_model(const SdfModel& model) {
  add_or_skip([&] { add_top_model(model, model.name, resolve(model, what("model", model.name, model))); });
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
  shapes_.report_coarse(file);
  warn(file, "of models without visuals the collision shapes are insonified (ignore removes them)", without_visuals_);
  warn(file, "of links whose visuals cannot be read the collision shapes are insonified (ignore removes it)",
       unreadable_visuals_);
  warn(file, "left out as water (keep_water: true keeps it)", water_);
  warn(file, "what is invisible to cameras echoes as a solid surface (ignore removes it)", for_eyes_);
  ignored_.report_unused(file, log_);
  return std::move(scene_);
}

}  // namespace insonify
