// sdf_material.cpp -- looks through elements for insonify's own.

#include "io/sdf/sdf_material.h"

#include <fmt/format.h>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/xml_file.h"

namespace insonify {
namespace {

constexpr std::string_view kInsonifyPrefix = "insonify:";

}  // namespace

std::string without_sdf_prefix(const std::string& name) {
  return name.starts_with(kInsonifyPrefix) ? name.substr(kInsonifyPrefix.size()) : name;
}

std::string sdf_text(const sdf::ElementPtr& element) {
  return element->GetValue() == nullptr ? "" : without_outer_space(element->GetValue()->GetAsString());
}

std::vector<InsonifyElement> insonify_elements(const sdf::ElementPtr& holder) {
  std::vector<InsonifyElement> found;
  for (sdf::ElementPtr child = holder->GetFirstElement(); child; child = child->GetNextElement()) {
    if (child->GetName().starts_with(kInsonifyPrefix)) {
      found.push_back({child, without_sdf_prefix(child->GetName())});
    } else if (child->GetName() == "plugin" && child->HasAttribute("name") &&
               child->GetAttribute("name")->GetAsString() == "insonify") {
      for (sdf::ElementPtr inner = child->GetFirstElement(); inner; inner = inner->GetNextElement()) {
        found.push_back({inner, without_sdf_prefix(inner->GetName())});
      }
    }
  }
  return found;
}

std::string sdf_material(const sdf::ElementPtr& element, const std::string& what) {
  std::string material;
  const bool may_carry_sonar = element->GetName() == "link" || element->GetName() == "model";
  for (const auto& [child, name] : insonify_elements(element)) {
    if (name == "sonar" && may_carry_sonar) {  // load_sdf_sonars() reads it.
      continue;
    }
    const std::string shown = printable(child->GetName());
    if (name != "material") {
      throw InsonifyElementError(fmt::format("{}: <{}> is unknown, insonify knows <material>", what, shown));
    }
    const std::string text = sdf_text(child);
    if (text.empty()) {
      throw InsonifyElementError(fmt::format("{}: <{}> is empty", what, shown));
    }
    if (!material.empty() && material != text) {
      throw InsonifyElementError(
          fmt::format("{} has two materials, '{}' and '{}'", what, printable(material), printable(text)));
    }
    material = text;
  }
  return material;
}

}  // namespace insonify
