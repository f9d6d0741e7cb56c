// sdf_portions.cpp -- groups the models of a world, and writes a file for each group.

#include "io/sdf/sdf_portions.h"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace insonify {
namespace {

constexpr std::size_t kMostWeight = 150;

bool is_relative(pugi::xml_node pose) {
  return *pose.attribute("relative_to").value() != '\0' || *pose.attribute("frame").value() != '\0';
}

void add_elements(pugi::xml_node element, std::vector<pugi::xml_node>& elements) {
  elements.push_back(element);
  element.find_node([&](pugi::xml_node node) {
    if (node.type() == pugi::node_element) {
      elements.push_back(node);
    }
    return false;
  });
}

// An element with its attributes only.
pugi::xml_node copy_alone(pugi::xml_node element, pugi::xml_node to, std::vector<pugi::xml_node>& elements) {
  pugi::xml_node copy = to.append_child(element.name());
  for (const pugi::xml_attribute attribute : element.attributes()) {
    copy.append_copy(attribute);
  }
  elements.push_back(element);
  return copy;
}

// Models of the world by portion.
std::vector<std::vector<pugi::xml_node>> groups_of(pugi::xml_node world,
                                                   const std::function<std::size_t(pugi::xml_node)>& weight) {
  std::vector<std::vector<pugi::xml_node>> groups(1);
  std::size_t sum = 0;
  for (const pugi::xml_node child : world.children()) {
    if (!is_sdf_model(child)) {
      continue;
    }
    const std::size_t more = weight(child);
    if (sum + more > kMostWeight && !groups.back().empty()) {
      groups.emplace_back();
      sum = 0;
    }
    sum += more;
    groups.back().push_back(child);
  }
  return groups;
}

// @param first  Whether what is not a model is in it.
SdfPortion portion_of(pugi::xml_node world, const std::vector<pugi::xml_node>& models, bool first) {
  SdfPortion portion;
  pugi::xml_document document;
  const auto copy_whole = [&](pugi::xml_node element, pugi::xml_node to) {
    to.append_copy(element);
    if (element.type() == pugi::node_element) {
      add_elements(element, portion.elements);
    }
  };
  pugi::xml_node root = copy_alone(world.parent(), document, portion.elements);
  for (const pugi::xml_node child : world.parent().children()) {
    if (child == world) {
      pugi::xml_node copy = copy_alone(world, root, portion.elements);
      for (const pugi::xml_node inner : world.children()) {
        if (first && !is_sdf_model(inner)) {
          copy_whole(inner, copy);
        }
      }
      for (const pugi::xml_node model : models) {
        copy_whole(model, copy);
      }
    } else if (first) {
      copy_whole(child, root);
    }
  }
  std::ostringstream text;
  root.print(text, " ", pugi::format_default, pugi::encoding_utf8);
  portion.text = text.str();
  return portion;
}

}  // namespace

bool is_sdf_model(pugi::xml_node node) {
  return node.name() == std::string_view("model") || node.name() == std::string_view("include");
}

pugi::xml_node independent_sdf_world(pugi::xml_node root) {
  const pugi::xml_node world = root.child("world");
  const auto children = world.children();
  const bool refers = std::any_of(children.begin(), children.end(), [](pugi::xml_node node) {
    const std::string_view name = node.name();
    return name == "joint" || name == "frame" ||
           (is_sdf_model(node) &&
            (is_relative(node.child("pose")) || node.attribute("placement_frame") || node.child("placement_frame")));
  });
  return refers || world.next_sibling("world") ? pugi::xml_node() : world;
}

SdfPortion whole_sdf(pugi::xml_node root) {
  SdfPortion portion;
  add_elements(root, portion.elements);
  return portion;
}

std::vector<SdfPortion> sdf_portions(pugi::xml_node root, const std::function<std::size_t(pugi::xml_node)>& weight) {
  const pugi::xml_node world = independent_sdf_world(root);
  const std::vector<std::vector<pugi::xml_node>> groups = groups_of(world, weight);
  if (groups.size() == 1) {
    return {whole_sdf(root)};
  }
  std::vector<SdfPortion> portions;
  for (const std::vector<pugi::xml_node>& models : groups) {
    portions.push_back(portion_of(world, models, portions.empty()));
  }
  return portions;
}

}  // namespace insonify
