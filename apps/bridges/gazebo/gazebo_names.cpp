// gazebo_names.cpp -- names of types, services and environment variables in Gazebo Fortress and later.

#include "gazebo/gazebo_names.h"

#include <cstdlib>

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

void copy_gz_environment() {
  constexpr const char* kNames[] = {
      "PARTITION", "IP", "RELAY", "DISCOVERY_MULTICAST_IP", "DISCOVERY_MSG_PORT", "VERBOSE", "DISCOVERY_SRV_PORT"};
  for (const std::string name : kNames) {
    if (const char* value = std::getenv(("GZ_" + name).c_str())) {
      setenv(("IGN_" + name).c_str(), value, 0);
    }
  }
}

std::string gazebo_partition() {
  const char* partition = std::getenv("IGN_PARTITION");
  return partition == nullptr ? "" : partition;
}

}  // namespace insonify
