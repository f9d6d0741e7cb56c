// sdf_models.cpp -- copies models from libsdformat.

#include "io/sdf/sdf_models.h"

#include <algorithm>
#include <sdf/Collision.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>

#include "io/file/input_file.h"
#include "io/sdf/sdf_material.h"
#include "io/sdf/sdf_poses.h"
#include "io/sdf/sdf_shape.h"

namespace insonify {
namespace {

Place place_of(sdf::Element& element, const std::string& name, const SdfSource& source) {
  return element.LineNumber() ? source.place(element.FilePath(), *element.LineNumber(), element.GetName(), name)
                              : Place{source.shown(element.FilePath())};
}

template <typename From>
void copy_element(const From& from, const SdfSource& source, SdfElement& to) {
  to.name = from.Name();
  to.place = place_of(*from.Element(), to.name, source);
  sdf_math::Pose3d pose;
  if (const sdf::Errors errors = from.SemanticPose().Resolve(pose); errors.empty()) {
    to.pose = pose_of(pose);
  } else {
    to.pose_fault = ": its pose cannot be worked out: " + foreign_reason(errors.front().Message());
  }
  try {
    to.material = sdf_material(from.Element(), "");
  } catch (const InsonifyElementError& error) {
    to.material_fault = error.what();
  }
}

std::vector<SdfSonarElement> sonars_of(const sdf::ElementPtr& holder, const Place& place, const SdfSource& source) {
  const auto name_of = [](const sdf::ElementPtr& element) {
    return element->HasAttribute("name") ? element->GetAttribute("name")->GetAsString() : "";
  };
  std::vector<SdfSonarElement> sonars;
  for (const auto& [element, name] : insonify_elements(holder)) {
    if (name != "sonar") {
      continue;
    }
    SdfSonarElement& sonar = sonars.emplace_back();
    sonar.name = name_of(element);
    sonar.place = holder->LineNumber()
                      ? source.place_within(holder->FilePath(), *holder->LineNumber(), holder->GetName(),
                                            name_of(holder), element->GetName(), sonar.name)
                      : place;
    for (sdf::ElementPtr child = element->GetFirstElement(); child; child = child->GetNextElement()) {
      sonar.children.emplace_back(without_sdf_prefix(child->GetName()), sdf_text(child));
    }
  }
  return sonars;
}

template <typename From>
SdfPart part_of(const From& from, const SdfSource& source, bool collision) {
  SdfPart part;
  copy_element(from, source, part);
  part.shape = sdf_shape(*from.Geom(), collision);
  part.unknown_shape = part.shape ? "" : sdf_shape_name(*from.Geom());
  part.file = source.original(sdf_shape_file(*from.Geom()));
  return part;
}

SdfLink link_of(const sdf::Link& from, const SdfSource& source) {
  SdfLink link;
  copy_element(from, source, link);
  for (std::uint64_t i = 0; i < from.VisualCount(); ++i) {
    const sdf::Visual& visual = *from.VisualByIndex(i);
    SdfPart& part = link.visuals.emplace_back(part_of(visual, source, false));
    part.opacity = (1 - static_cast<double>(visual.Transparency())) * source.opacity(part.place.text());
    part.is_painted_as_water = source.is_water(part.place.text());
  }
  for (std::uint64_t i = 0; i < from.CollisionCount(); ++i) {
    link.collisions.push_back(part_of(*from.CollisionByIndex(i), source, true));
  }
  link.sonars = sonars_of(from.Element(), link.place, source);
  return link;
}

SdfModel model_of(const sdf::Model& from, const SdfSource& source) {
  SdfModel model;
  copy_element(from, source, model);
  for (std::uint64_t i = 0; i < from.LinkCount(); ++i) {
    model.links.push_back(link_of(*from.LinkByIndex(i), source));
  }
  for (std::uint64_t i = 0; i < from.ModelCount(); ++i) {
    model.models.push_back(model_of(*from.ModelByIndex(i), source));
  }
  model.sonars = sonars_of(from.Element(), model.place, source);
  return model;
}

}  // namespace

std::size_t SdfModel::visual_count() const {
  std::size_t count = 0;
  for (const SdfLink& link : links) {
    count += link.visuals.size();
  }
  for (const SdfModel& model : models) {
    count += model.visual_count();
  }
  return count;
}

void SdfModels::add(const SdfSource& source, const sdf::Root& root) {
  worlds.resize(std::max<std::size_t>(worlds.size(), root.WorldCount()));
  for (std::uint64_t w = 0; w < root.WorldCount(); ++w) {
    const sdf::World& world = *root.WorldByIndex(w);
    worlds[w].saved_poses.merge(sdf_saved_poses(world));
    for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
      worlds[w].models.push_back(model_of(*world.ModelByIndex(i), source));
    }
  }
  if (root.Model() != nullptr) {
    model = model_of(*root.Model(), source);
  }
}

bool SdfModels::add_twins(const SdfTwins& found) {
  if (found.twins.empty()) {
    return true;
  }
  if (worlds.size() != 1 || worlds[0].models.size() != found.left) {
    return false;
  }
  std::vector<SdfModel> all;
  auto twin = found.twins.begin();
  for (std::size_t i = 0; i <= found.left; ++i) {
    for (; twin != found.twins.end() && twin->before == i; ++twin) {
      SdfModel& model = all.emplace_back(worlds[0].models[twin->first]);
      model.name = twin->name;
      model.pose = twin->pose;
    }
    if (i < found.left) {
      all.push_back(worlds[0].models[i]);
    }
  }
  worlds[0].models = std::move(all);
  return true;
}

}  // namespace insonify
