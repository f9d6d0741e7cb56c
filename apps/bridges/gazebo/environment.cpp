// environment.cpp -- copies GZ_... to IGN_...

#include "gazebo/environment.h"

#include <cstdlib>

namespace insonify {

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
