// sonar_description.cpp -- beams, bins, levels and labels as a JSON object.

#include "io/message/sonar_description.h"

#include <nlohmann/json.hpp>

#include "io/message/message_display.h"

namespace insonify {

using Json = nlohmann::ordered_json;

std::string sonar_description(const MessageSource& source, const MessageOptions& options, const std::string& frame) {
  const SonarConfig& sonar = source.sonar;
  const BearingGrid beams = sonar.bearings();
  Json azimuths = Json::array(), widths = Json::array();
  for (int beam = 0; beam < beams.count(); ++beam) {
    azimuths.push_back(sonar.beam_azimuth(beam));
    widths.push_back(sonar.azimuth_resolution.value_or(beams.width(beam)));
  }
  const MessageLevels levels = message_levels(source, options);
  Json json = {{"name", sonar.name},
               {"type", word_of(sonar.type)},
               {"frame", frame},
               {"frequency", sonar.frequency},
               {"sound_speed", sonar.assumed_sound_speed.value_or(0)},
               {"ping_period", sonar.ping_period.value_or(0)},
               {"azimuths", azimuths},
               {"receive_widths", widths},
               {"azimuth_aperture", sonar.azimuth_aperture},
               {"elevation_aperture", sonar.elevation_aperture},
               {"elevation_center", sonar.elevation_center},
               {"min_range", sonar.min_range},
               {"max_range", sonar.max_range},
               {"bin_count", sonar.bin_count},
               {"levels",
                {{"scale", levels.decibels ? "db" : "linear"},
                 {"low_db", levels.low_db},
                 {"high_db", levels.high_db},
                 {"gain_per_decade", levels.gain_per_decade},
                 {"bits", options.bits}}},
               {"labels", source.labels}};
  if (sonar.scans()) {
    json["head"] = {{"step", sonar.head.step},
                    {"sector_center", sonar.head.sector_center},
                    {"sector_width", sonar.head.sector_width}};
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace insonify
