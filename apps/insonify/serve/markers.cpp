// markers.cpp -- checks, sends and writes the markers of a session.

#include "serve/markers.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "serve/json_messages.h"

namespace insonify {
namespace {

// The side of a side-scan sonar on which a marker lies; empty for other sonars.
std::string side_of(const nlohmann::json& given) {
  const std::string side = given.contains("side") ? text_of(given, "side") : "";
  if (!side.empty() && side != "port" && side != "starboard") {
    throw Error("the side of a marker must be port or starboard");
  }
  return side;
}

Marker checked_marker(const nlohmann::json& given) {
  constexpr std::size_t kLongest = 200;
  if (!given.is_object()) {
    throw FormError("a marker must be an object");
  }
  const std::string name = text_of(given, "name");
  if (name.size() > kLongest) {
    throw Error(fmt::format("the name of a marker has {} bytes; the most are {}", name.size(), kLongest));
  }
  constexpr double kMostPings = 1e15;
  return {.name = name,
          .position = numbers_of(given, "position", 3),
          .time = number_of(given, "time"),
          .sonar = text_of(given, "sonar"),
          .ping = static_cast<std::uint64_t>(std::clamp(number_of(given, "ping"), 0.0, kMostPings)),
          .range = given.contains("range") ? std::optional(number_of(given, "range")) : std::nullopt,
          .side = side_of(given)};
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
  std::vector<Marker> markers;
  for (const nlohmann::json& marker : given) {
    markers.push_back(checked_marker(marker));
  }
  const std::lock_guard lock(mutex_);
  markers_ = std::move(markers);
}

std::vector<Marker> Markers::all() const {
  const std::lock_guard lock(mutex_);
  return markers_;
}

std::string Markers::text() const {
  Json markers = Json::array();
  for (const Marker& marker : all()) {
    markers.push_back(Json::parse(marker_text(marker)));
  }
  return dumped({{"op", "markers"}, {"markers", markers}});
}

std::string Markers::write_beside(const std::filesystem::path& scenario) const {
  Json features = Json::array();
  for (const Marker& marker : all()) {
    Json properties = Json::parse(marker_text(marker));
    const Json geometry = {{"type", "Point"}, {"coordinates", properties["position"]}};
    properties.erase("position");
    features.push_back({{"type", "Feature"}, {"geometry", geometry}, {"properties", properties}});
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
