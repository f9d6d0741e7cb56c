// dae_text.cpp -- looks up what instances in COLLADA name, and leaves out what has no shape.

#include <fmt/format.h>

#include <map>
#include <set>
#include <sstream>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/xml_file.h"
#include "io/mesh/mesh_checks.h"

namespace insonify {
namespace {

// The kinds of elements that an <instance_...> may name.
const std::map<std::string, std::set<std::string>> kInstances = {{"instance_geometry", {"geometry"}},
                                                                 {"instance_controller", {"controller", "geometry"}},
                                                                 {"instance_node", {"node"}}};

// Calls visit(element) for all elements.
template <typename Visit>
void each_element(pugi::xml_node root, const Visit& visit) {
  root.find_node([&](pugi::xml_node node) {
    visit(node);
    return false;
  });
}

void check_instances(const XmlFile& xml) {
  std::set<std::string> named;  // By kind and reference: "node #ship".
  each_element(xml.root(), [&](pugi::xml_node element) {
    if (const pugi::xml_attribute id = element.attribute("id")) {
      named.insert(fmt::format("{} #{}", element.name(), id.value()));
    }
  });
  each_element(xml.root(), [&](pugi::xml_node element) {
    const auto kinds = kInstances.find(element.name());
    const std::string url = element.attribute("url").value();
    if (kinds == kInstances.end() || !url.starts_with('#')) {
      return;  // assimp refuses other references.
    }
    if (std::ranges::none_of(kinds->second,
                             [&](const std::string& kind) { return named.contains(kind + " " + url); })) {
      throw Error(fmt::format("{}<{}> names {}, which is not in this file", xml.where(element), element.name(),
                              printable(url)));
    }
  });
}

// Whether an element below <library_effects> leads to a map of small normals or is one.
bool belongs_to_bump(pugi::xml_node element) {
  static const std::set<std::string_view> kKept = {"effect",         "profile_COMMON", "technique", "newparam",
                                                   "surface",        "sampler2D",      "init_from", "source",
                                                   "instance_image", "bump",           "texture"};
  const std::string_view name = element.name(), parent = element.parent().name();
  return name == "extra" ? parent == "technique" || parent == "effect" : kKept.contains(name) && parent != "texture";
}

// Elements that name the kind of a look, which assimp asks for.
bool is_kind_of_look(pugi::xml_node element) {
  static const std::set<std::string_view> kKinds = {"phong", "blinn", "lambert", "constant"};
  return element.parent().name() == std::string_view("technique") && kKinds.contains(element.name());
}

void keep_only_bump(pugi::xml_node parent) {
  for (pugi::xml_node child = parent.first_child(), next; child; child = next) {
    next = child.next_sibling();
    if (is_kind_of_look(child)) {
      child.remove_children();
    } else if (child.type() == pugi::node_element && !belongs_to_bump(child)) {
      parent.remove_child(child);
    } else {
      keep_only_bump(child);
    }
  }
}

// assimp ends on an image without a file.
void keep_only_files(pugi::xml_node images) {
  for (pugi::xml_node image = images.first_child(), next; image; image = next) {
    next = image.next_sibling();
    const pugi::xml_node from = image.child("init_from");
    if (!image.attribute("id") || (xml_text(from).empty() && xml_text(from.child("ref")).empty())) {
      images.remove_child(image);
    }
  }
}

// What to write instead of an element at the root.
std::string replacement(pugi::xml_node element) {
  const std::string_view name = element.name();
  if (name == "library_images") {
    keep_only_files(element);
  } else if (name == "library_effects") {
    keep_only_bump(element);
  } else {
    return "";
  }
  std::ostringstream text;
  element.print(text, "", pugi::format_raw, pugi::encoding_utf8);
  return text.str();
}

bool has_no_shape(pugi::xml_node element) {
  static const std::set<std::string_view> kOthers = {
      "library_animations",     "library_animation_clips", "library_cameras", "library_effects",
      "library_force_fields",   "library_images",          "library_lights",  "library_physics_materials",
      "library_physics_models", "library_physics_scenes"};
  return kOthers.contains(element.name());
}

}  // namespace

std::string mend_dae(std::string text, const std::filesystem::path& path) {
  text = xml_in_utf8(std::move(text));
  const XmlFile xml(text, path.string());
  check_instances(xml);
  std::string mended;
  std::size_t done = 0;
  for (const pugi::xml_node element : xml.root().children()) {
    if (!has_no_shape(element)) {
      continue;
    }
    const pugi::xml_node next = element.next_sibling();
    const std::size_t begin = static_cast<std::size_t>(element.offset_debug()) - 1;  // '<' comes before the name.
    const std::size_t end = next ? static_cast<std::size_t>(next.offset_debug()) - 1 : text.rfind("</");
    mended.append(text, done, begin - done).append(replacement(element));
    done = end;
  }
  return mended.append(text, done);
}

}  // namespace insonify
