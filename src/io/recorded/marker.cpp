// marker.cpp -- markers as JSON texts and back.

#include "insonify/marker.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "insonify/error.h"

namespace insonify {

std::string marker_text(const Marker& marker) {
  const Vec3& at = marker.position;
  nlohmann::ordered_json json = {{"name", marker.name},
                                 {"position", {at.x(), at.y(), at.z()}},
                                 {"time", marker.time},
                                 {"sonar", marker.sonar},
                                 {"ping", marker.ping}};
  if (marker.range) {
    json["range"] = *marker.range;
  }
  if (!marker.side.empty()) {
    json["side"] = marker.side;
  }
  constexpr bool kAscii = false;
  return json.dump(-1, ' ', kAscii, nlohmann::ordered_json::error_handler_t::replace);
}

Marker marker_from_text(std::string_view text) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    Marker marker;
    json.at("name").get_to(marker.name);
    const auto& at = json.at("position");
    marker.position = {at.at(0).get<double>(), at.at(1).get<double>(), at.at(2).get<double>()};
    json.at("time").get_to(marker.time);
    json.at("sonar").get_to(marker.sonar);
    json.at("ping").get_to(marker.ping);
    if (json.contains("range")) {
      marker.range = json.at("range").get<double>();
    }
    marker.side = json.value("side", "");
    return marker;
  } catch (const nlohmann::json::exception&) {
    throw Error("a marker must be a JSON object with name, position, time, sonar and ping");
  }
}

std::vector<std::string> marker_texts(const std::vector<Marker>& markers) {
  std::vector<std::string> texts;
  std::ranges::transform(markers, std::back_inserter(texts), marker_text);
  return texts;
}

std::vector<Marker> markers_from_texts(const std::vector<std::string>& texts) {
  std::vector<Marker> markers;
  std::ranges::transform(texts, std::back_inserter(markers), [](const auto& text) { return marker_from_text(text); });
  return markers;
}

}  // namespace insonify
