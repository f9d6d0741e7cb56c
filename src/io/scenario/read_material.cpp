// read_material.cpp -- reads "steel" as {like: steel}.

#include "io/scenario/read_material.h"

namespace insonify {

std::string material_name(const YamlValue& value, std::string_view object) {
  if (value.scalar.empty()) {
    throw Error("", object, " must name a material").at(value.place);
  }
  return value.scalar;
}

void read_section(const YamlValue& value, std::string_view object, MaterialOverride& changes, Places& places) {
  if (value.kind == YamlValue::Kind::kScalar) {
    places[std::string(object)] = value.place;
    changes.like = material_name(value, object);
    return;
  }
  read_section<MaterialOverride>(value, object, changes, places);
  if (const YamlValue* like = value.find("like")) {
    changes.like = material_name(*like, member_name(object, "like"));
  }
}

}  // namespace insonify
