// dae_text.cpp -- looks up what instances in COLLADA name, and leaves out what has no shape.

#include <fmt/format.h>

#include <map>
#include <set>
#include <sstream>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/xml_file.h"
#include "io/mesh/mesh_checks.h"
#include "io/mesh/node_graph.h"

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

// Triangles or polygons of each geometry and controller, by "#id".
std::map<std::string, double> sizes_of_geometries(const XmlFile& xml) {
  static const std::set<std::string_view> kPrimitives = {"triangles", "trifans", "tristrips", "polylist", "polygons"};
  std::map<std::string, double> sizes;
  each_element(xml.root(), [&](pugi::xml_node geometry) {
    if (geometry.name() == std::string_view("geometry")) {
      double& size = sizes[std::string("#") + geometry.attribute("id").value()];
      each_element(geometry, [&](pugi::xml_node element) {
        size += kPrimitives.contains(element.name()) ? element.attribute("count").as_double() : 0;
      });
    }
  });
  each_element(xml.root(), [&](pugi::xml_node controller) {
    if (controller.name() == std::string_view("controller")) {
      const double size = sizes[controller.child("skin").attribute("source").value()];
      sizes[std::string("#") + controller.attribute("id").value()] = size;
    }
  });
  return sizes;
}

void check_nodes(const XmlFile& xml, const std::filesystem::path& path) {
  std::map<std::string, double> sizes = sizes_of_geometries(xml);
  std::map<pugi::xml_node, std::size_t> indices;
  std::map<std::string, std::size_t> by_id;
  NodeGraph graph;
  each_element(xml.root(), [&](pugi::xml_node element) {
    if (element.name() == std::string_view("node")) {
      const std::string id = element.attribute("id").value();
      indices[element] = by_id["#" + id] = graph.nodes.size();
      graph.nodes.push_back({.name = fmt::format("node '{}'", id)});
    }
  });
  for (const auto& [element, index] : indices) {
    NodeGraph::Node& node = graph.nodes[index];
    for (const pugi::xml_node child : element.children()) {
      const std::string url = child.attribute("url").value();
      if (const auto inner = indices.find(child); inner != indices.end()) {
        node.children.push_back(inner->second);
      } else if (child.name() == std::string_view("instance_node") && by_id.contains(url)) {
        node.children.push_back(by_id[url]);
      } else if (kInstances.contains(child.name())) {
        node.triangles += sizes[url];
      }
    }
  }
  each_element(xml.root(), [&](pugi::xml_node scene) {
    if (scene.name() == std::string_view("visual_scene")) {
      std::vector<std::size_t>& roots = graph.roots.emplace_back();
      for (const pugi::xml_node node : scene.children("node")) {
        roots.push_back(indices.at(node));
      }
    }
  });
  check_node_graph(graph, path);
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
  check_nodes(xml, path);
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
