// gazebo_names.cpp -- names of types and services in Gazebo Fortress and later.

#include "gazebo/gazebo_names.h"

namespace insonify {

std::string ignition_type_name(std::string_view gz_type) {
  constexpr std::string_view kNew = "gz.";
  return gz_type.starts_with(kNew) ? "ignition." + std::string(gz_type.substr(kNew.size())) : std::string(gz_type);
}

std::optional<std::string> world_of_service(std::string_view service) {
  constexpr std::string_view kBefore = "/world/", kAfter = "/scene/info";
  if (service.size() <= kBefore.size() + kAfter.size() || !service.starts_with(kBefore) || !service.ends_with(kAfter)) {
    return std::nullopt;
  }
  service.remove_prefix(kBefore.size());
  service.remove_suffix(kAfter.size());
  return std::string(service);
}

}  // namespace insonify
