// sdf_elements.cpp -- selects the SDF elements that matter to a scene, and changes those that libsdformat would refuse.

#include "io/sdf/sdf_elements.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <locale>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "base/names.h"

namespace insonify {

bool is_irrelevant_sdf(pugi::xml_node element) {
  static const std::map<std::string_view, std::set<std::string_view>> kLeftOut = {
      {"visual", {"material", "cast_shadows", "laser_retro", "visibility_flags", "meta"}},
      {"collision", {"surface", "max_contacts", "laser_retro"}},
      {"link",
       {"inertial", "sensor", "light", "particle_emitter", "gravity", "enable_wind", "self_collide", "kinematic",
        "must_be_base_link", "velocity_decay", "audio_sink", "audio_source", "battery", "projector"}},
      {"model", {"self_collide", "allow_auto_disable", "enable_wind", "gripper"}},
      {"joint", {"sensor"}},
      {"world",
       {"light", "physics", "gui", "scene", "actor", "spherical_coordinates", "gravity", "magnetic_field", "wind",
        "atmosphere", "audio", "population"}},
      {"state", {"light", "insertions", "deletions"}},
      {"sdf", {"light", "actor"}}};
  if (element.name() == std::string_view("plugin")) {
    return element.attribute("name").value() != std::string_view("insonify");
  }
  const auto found = kLeftOut.find(element.parent().name());
  return found != kLeftOut.end() && found->second.contains(element.name());
}

bool is_sdf_include(pugi::xml_node element) {
  static const std::set<std::string_view> kParents = {"sdf", "world", "model"};
  return element.name() == std::string_view("include") && kParents.contains(element.parent().name());
}

bool holds_only_sdf_lights(pugi::xml_node root) {
  const auto elements = root.children();
  const auto is_one = [](pugi::xml_node node) {
    return node.type() != pugi::node_element || node.name() == std::string_view("light") ||
           node.name() == std::string_view("actor");
  };
  return (root.child("light") || root.child("actor")) && std::all_of(elements.begin(), elements.end(), is_one);
}

bool is_sdf_frame_of_another(pugi::xml_node root, std::string_view name) {
  const auto names_it = [&](std::string_view text) {
    const std::size_t colons = text.rfind("::");
    return (colons == std::string_view::npos ? text : text.substr(colons + 2)) == name;
  };
  const pugi::xml_node found = root.find_node([&](pugi::xml_node node) {
    for (const char* attribute : {"relative_to", "attached_to", "placement_frame", "frame"}) {
      if (names_it(node.attribute(attribute).value())) {
        return true;
      }
    }
    return node.name() == std::string_view("placement_frame") && names_it(xml_text(node));
  });
  return found;
}

bool paints_sdf_water(pugi::xml_node element) {
  const std::string name = lower_case(xml_text(element.child("script").child("name")));
  return element.name() == std::string_view("material") && element.parent().name() == std::string_view("visual") &&
         name.find("water") != std::string::npos;
}

double sdf_opacity(pugi::xml_node element) {
  std::istringstream numbers(xml_text(element.child("diffuse")));
  numbers.imbue(std::locale::classic());
  double red = 0, green = 0, blue = 0, alpha = 1;
  return element.name() == std::string_view("material") && numbers >> red >> green >> blue >> alpha ? alpha : 1;
}

void keep_empty_sdf_model_readable(pugi::xml_node parent) {
  if (parent.name() == std::string_view("model") && !parent.child("link") && !parent.child("model") &&
      !parent.child("include")) {
    parent.remove_child("static");
    parent.append_child("static").text() = "true";
  }
}

bool put_world_around_sdf_models(pugi::xml_node root) {
  const auto count = [&](const char* name) {
    const auto children = root.children(name);
    return std::distance(children.begin(), children.end());
  };
  if (count("model") + count("include") < 2 || count("world") > 0) {
    return false;
  }
  pugi::xml_node world = root.append_child("world");
  world.append_attribute("name") = "world_of_models";
  while (root.first_child() != world) {
    world.append_move(root.first_child());
  }
  return true;
}

}  // namespace insonify
