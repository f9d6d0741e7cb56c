// sdf_twins.cpp -- compares the texts of models without their names and poses.

#include "io/sdf/sdf_twins.h"

#include <charconv>
#include <map>
#include <optional>
#include <sstream>

#include "io/file/xml_file.h"
#include "io/sdf/sdf_portions.h"

namespace insonify {
namespace {

// The six numbers of a pose; the identity if there is none, nothing for other texts.
std::optional<Pose> plain_pose(pugi::xml_node element) {
  if (element.attribute("degrees").as_bool() || element.attribute("rotation_format")) {
    return std::nullopt;
  }
  const std::string text = element ? xml_text(element) : "0 0 0 0 0 0";
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    double number = 0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (failure != std::errc() || end != word.data() + word.size()) {
      return std::nullopt;
    }
    numbers.push_back(number);
  }
  if (numbers.size() != 6) {
    return std::nullopt;
  }
  return Pose{Vec3(numbers[0], numbers[1], numbers[2]), orientation_from_rpy(numbers[3], numbers[4], numbers[5])};
}

// The name of a model; that of an include only if it gives one.
std::string name_of_model(pugi::xml_node model) {
  return model.name() == std::string_view("model") ? model.attribute("name").value() : xml_text(model.child("name"));
}

// The text of a model without its name and pose.
std::string text_without_place(pugi::xml_node model) {
  pugi::xml_document copy;
  pugi::xml_node node = copy.append_copy(model);
  node.remove_attribute("name");
  node.remove_child("pose");
  if (node.name() == std::string_view("include")) {
    node.remove_child("name");
  }
  std::ostringstream text;
  node.print(text, "", pugi::format_raw, pugi::encoding_utf8);
  return text.str();
}

}  // namespace

SdfTwins take_out_sdf_twins(pugi::xml_node root) {
  SdfTwins found;
  pugi::xml_node world = independent_sdf_world(root);
  std::map<std::string, std::size_t> firsts;  // Index among those that are left, by text.
  for (pugi::xml_node child = world.first_child(), next; child; child = next) {
    next = child.next_sibling();
    if (!is_sdf_model(child)) {
      continue;
    }
    const std::string name = name_of_model(child);
    const std::optional<Pose> pose = name.empty() ? std::nullopt : plain_pose(child.child("pose"));
    const auto [first, is_new] =
        pose ? firsts.try_emplace(text_without_place(child), found.left) : std::pair(firsts.end(), true);
    if (is_new) {
      ++found.left;
    } else {
      found.twins.push_back({name, *pose, first->second, found.left});
      world.remove_child(child);
    }
  }
  return found;
}

}  // namespace insonify
