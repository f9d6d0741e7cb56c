// sdf_material.cpp -- reads insonify's elements in SDF, which libsdformat passes on unchanged.

#include "io/sdf/sdf_material.h"

#include <fmt/format.h>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/xml_file.h"

namespace insonify {
namespace {

constexpr std::string_view kPrefix = "insonify:";
constexpr std::string_view kPlugin = "insonify";

std::string text_of(const sdf::ElementPtr& element) {
  return element->GetValue() == nullptr ? "" : without_outer_space(element->GetValue()->GetAsString());
}

// Whether an element may carry a sonar: load_sdf_sonars() reads it.
bool may_carry_sonar(const sdf::ElementPtr& element) {
  return element->GetName() == "link" || element->GetName() == "model";
}

// Reads one of insonify's elements; `name` is without prefix.
void take(const sdf::ElementPtr& element, const std::string& name, const std::string& what, std::string& material) {
  if (name != "material") {
    throw Error(fmt::format("{}: <{}> is unknown, insonify knows <material>", what, printable(element->GetName())));
  }
  const std::string text = text_of(element);
  if (text.empty()) {
    throw Error(fmt::format("{}: <{}> is empty", what, printable(element->GetName())));
  }
  if (!material.empty() && material != text) {
    throw Error(fmt::format("{} has two materials, '{}' and '{}'", what, printable(material), printable(text)));
  }
  material = text;
}

}  // namespace

std::string sdf_material(const sdf::ElementPtr& element, const std::string& what) {
  std::string material;
  const auto is_sonar = [&](const std::string& name) { return name == "sonar" && may_carry_sonar(element); };
  for (sdf::ElementPtr child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    const std::string& name = child->GetName();
    if (name.starts_with(kPrefix) && is_sonar(name.substr(kPrefix.size()))) {
      continue;
    }
    if (name.starts_with(kPrefix)) {
      take(child, name.substr(kPrefix.size()), what, material);
    } else if (name == "plugin" && child->HasAttribute("name") &&
               child->GetAttribute("name")->GetAsString() == kPlugin) {
      for (sdf::ElementPtr inner = child->GetFirstElement(); inner; inner = inner->GetNextElement()) {
        if (!is_sonar(inner->GetName())) {
          take(inner, inner->GetName(), what, material);
        }
      }
    }
  }
  return material;
}

}  // namespace insonify
