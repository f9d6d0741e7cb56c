// read_material.cpp -- reads "steel" as {like: steel}.

#include "io/scenario/read_material.h"

#include <fmt/format.h>

namespace insonify {

std::string material_name(const YamlValue& value, std::string_view object) {
  if (value.scalar.empty()) {
    throw Error(fmt::format("{}{} must name a material", value.where, object));
  }
  return value.scalar;
}

void read_section(const YamlValue& value, std::string_view object, MaterialOverride& changes, Places& places) {
  changes.where = value.where;
  if (value.kind == YamlValue::Kind::kScalar) {
    places[std::string(object)] = value.where;
    changes.like = material_name(value, object);
    return;
  }
  read_section<MaterialOverride>(value, object, changes, places);
  if (const YamlValue* like = value.find("like")) {
    changes.like = material_name(*like, member_name(object, "like"));
    changes.like_where = like->where;
  }
}

}  // namespace insonify
