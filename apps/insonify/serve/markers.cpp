// markers.cpp -- checks, sends and writes the markers of a session.

#include "serve/markers.h"

#include <fmt/format.h>

#include <fstream>

#include "serve/json_messages.h"

namespace insonify {
namespace {

Json checked_marker(const nlohmann::json& given) {
  constexpr std::size_t kLongest = 200;
  if (!given.is_object()) {
    throw FormError("a marker must be an object");
  }
  const std::string name = text_of(given, "name");
  if (name.size() > kLongest) {
    throw Error(fmt::format("the name of a marker has {} bytes; the most are {}", name.size(), kLongest));
  }
  const Eigen::VectorXd at = numbers_of(given, "position", 3);
  return {{"name", name},
          {"position", {at[0], at[1], at[2]}},
          {"time", number_of(given, "time")},
          {"sonar", text_of(given, "sonar")},
          {"ping", number_of(given, "ping")}};
}

}  // namespace

void Markers::set(const nlohmann::json& message) {
  constexpr std::size_t kMost = 1000;
  const nlohmann::json& given = member(message, "markers");
  if (!given.is_array()) {
    throw FormError("\"markers\" must be a list");
  }
  if (given.size() > kMost) {
    throw Error(fmt::format("{} markers are too many; the most are {}", given.size(), kMost));
  }
  Json markers = Json::array();
  for (const nlohmann::json& marker : given) {
    markers.push_back(checked_marker(marker));
  }
  const std::lock_guard lock(mutex_);
  markers_ = std::move(markers);
}

bool Markers::empty() const {
  const std::lock_guard lock(mutex_);
  return markers_.empty();
}

std::string Markers::text() const {
  const std::lock_guard lock(mutex_);
  return dumped({{"op", "markers"}, {"markers", markers_}});
}

std::string Markers::write_beside(const std::filesystem::path& scenario) const {
  Json features = Json::array();
  {
    const std::lock_guard lock(mutex_);
    for (Json properties : markers_) {
      const Json geometry = {{"type", "Point"}, {"coordinates", properties["position"]}};
      properties.erase("position");
      features.push_back({{"type", "Feature"}, {"geometry", geometry}, {"properties", properties}});
    }
  }
  if (features.empty()) {
    return "";
  }
  const std::filesystem::path path = scenario.parent_path() / (scenario.stem().string() + "-markers.geojson");
  std::ofstream file(path, std::ios::binary);
  file << dumped({{"type", "FeatureCollection"},
                  {"note", "metres in the world: x, y, z up; not longitude and latitude"},
                  {"features", features}})
       << '\n';
  file.close();
  const std::string name = path.filename().string();
  return file ? fmt::format("; markers: {}", name) : fmt::format("; markers could not be written to {}", name);
}

}  // namespace insonify
