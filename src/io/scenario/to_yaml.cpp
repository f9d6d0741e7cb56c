// to_yaml.cpp -- writes a scenario as YAML, using the lists of fields and parts that also read it.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "insonify/files.h"
#include "insonify/words.h"
#include "io/file/input_file.h"
#include "io/scenario/yaml_value.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

YamlValue scalar(std::string text, bool quoted = false) {
  YamlValue value;
  value.kind = Kind::kScalar;
  value.scalar = std::move(text);
  value.quoted = quoted;
  return value;
}

// The shortest number of degrees that is read as these radians, or the nearest: not every number of radians has one, as
// degrees can be the coarser of the two.
double degrees_to_write(double radians) {
  const double nearest = degrees_from_radians(radians);
  if (!std::isfinite(nearest)) {
    return nearest;
  }
  for (const int digits : {3, 6, 9, 12, 15, 16, 17}) {
    const std::string text = fmt::format("{:.{}g}", nearest, digits);
    double rounded = 0;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    if (radians_from_degrees(rounded) == radians) {
      return rounded;
    }
  }
  for (const double towards : {-1e300, 1e300}) {
    const double neighbour = std::nextafter(nearest, towards);
    if (radians_from_degrees(neighbour) == radians) {
      return neighbour;
    }
  }
  return nearest;
}

// One overload for each type of member; kNothing for an absent one.

YamlValue written(const Field& field, double member) {
  return scalar(fmt::format("{}", field.unit == "rad" ? degrees_to_write(member) : member));
}
YamlValue written(const Field& /*field*/, int member) {
  return scalar(fmt::to_string(member));
}
YamlValue written(const Field& /*field*/, std::uint64_t member) {
  return scalar(fmt::to_string(member));
}
YamlValue written(const Field& /*field*/, bool member) {
  return scalar(member ? "true" : "false");
}
YamlValue written(const Field& /*field*/, const std::string& member) {
  return scalar(member, true);
}
YamlValue written(const Field& /*field*/, const std::filesystem::path& member) {
  return member.empty() ? YamlValue() : scalar(member.string(), true);
}
template <typename Enum>
requires std::is_enum_v<Enum> YamlValue written(const Field& /*field*/, const Enum& member) {
  return scalar(std::string(word_of(member)));
}
template <typename List>
requires std::is_same_v<List, Vec3> || std::is_same_v<List, std::vector<double>> ||
    std::is_same_v<List, std::vector<int>>
        YamlValue written(const Field& field, const List& member) {
  YamlValue list;
  list.kind = Kind::kList;
  for (const auto value : member) {
    list.items.push_back(written(field, value));
  }
  return list;
}
YamlValue written(const Field& field, const std::vector<std::string>& member) {
  YamlValue list;
  list.kind = Kind::kList;
  for (const std::string& value : member) {
    list.items.push_back(written(field, value));
  }
  return list;
}
template <typename Number>
YamlValue written(const Field& field, const std::optional<Number>& member) {
  return member ? written(field, *member) : YamlValue();
}

bool same(const YamlValue& a, const YamlValue& b) {
  return a.kind == b.kind && a.scalar == b.scalar && std::ranges::equal(a.items, b.items, same);
}

// Keys that the reader refuses: they follow from others, or have no effect on this type of sonar.
bool is_refused(const SonarConfig& sonar, const Field& field) {
  const std::string_view name = field.name;
  const bool head = name == "step" || name == "sector_center" || name == "sector_width" || name == "mounting";
  return (head && !sonar.scans()) || (name == "azimuth_aperture" && sonar.beam_azimuths.size() > 1);
}
template <typename Config>
bool is_refused(const Config& /*config*/, const Field& /*field*/) {
  return false;
}

YamlValue::Entry entry(const std::string& key, YamlValue value) {
  return {key, std::move(value)};
}

template <typename Config>
YamlValue map_of(ActsIn idle, const Config& config, const Config& defaults = {});

template <typename Member>
YamlValue written_part(ActsIn idle, const Member& member, const Member& defaults) {
  YamlValue part;
  if constexpr (requires { member.has_value(); }) {
    return member ? map_of(idle, *member) : part;
  } else if constexpr (requires { typename Member::mapped_type; }) {
    part.kind = Kind::kMap;
    for (const auto& [key, value] : member) {
      part.entries.push_back(entry(key, map_of(idle, value)));
    }
    return member.empty() ? YamlValue() : part;
  } else if constexpr (requires { member.begin(); }) {
    part.kind = Kind::kList;
    for (const auto& value : member) {
      part.items.push_back(map_of(idle, value));
    }
    return member.empty() ? YamlValue() : part;
  } else {
    part = map_of(idle, member, defaults);
    return part.entries.empty() ? YamlValue() : part;
  }
}

// What differs from the defaults.
// @param idle  The model that the scenario does not use, whose fields are omitted.
template <typename Config>
YamlValue map_of(ActsIn idle, const Config& config, const Config& defaults) {
  YamlValue map;
  map.kind = Kind::kMap;
  std::vector<YamlValue> usual;
  Config::visit_fields(defaults,
                       [&](const Field& field, const auto& member) { usual.push_back(written(field, member)); });
  auto next = usual.begin();
  Config::visit_fields(config, [&](const Field& field, const auto& member) {
    YamlValue value = written(field, member);
    if (!same(value, *next++) && field.acts != idle && !is_refused(config, field)) {
      map.entries.push_back(
          entry(file_name_of(field), value.kind == Kind::kNothing ? scalar("none") : std::move(value)));
    }
  });
  if constexpr (HasParts<Config>) {
    Config::visit_parts(config, [&]<typename Member>(const Part& part, const Member& member) {
      YamlValue value = written_part(idle, member, Member{});
      if (value.kind != Kind::kNothing) {
        map.entries.push_back(entry(std::string(part.name), std::move(value)));
      }
    });
  }
  return map;
}

// Replaces each sonar's own receiver by its differences from the scenario's receiver, from which reading starts.
void write_receivers(ActsIn idle, const Scenario& scenario, YamlValue& map) {
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    if (scenario.sonars[i].receiver) {
      *map.find("sonars")->items[i].find("receiver") = map_of(idle, *scenario.sonars[i].receiver, scenario.receiver);
    }
  }
}

}  // namespace

std::string to_yaml(const Scenario& scenario) {
  Scenario whole = scenario;
  const std::filesystem::path folder = is_stream(scenario.file) ? std::filesystem::path() : scenario.file.parent_path();
  const auto make_absolute = [&](std::filesystem::path& path) {
    path = path.empty() ? path : std::filesystem::absolute(folder / path).lexically_normal();
  };
  make_absolute(whole.world);
  for (auto& [name, changes] : whole.materials.overrides) {
    MaterialOverride::visit_fields(changes, [&]<typename Member>(const Field&, Member& member) {
      if constexpr (std::is_same_v<Member, std::filesystem::path>) {
        make_absolute(member);
      }
    });
  }
  const ActsIn idle = scenario.model == EchoModel::kPaper ? ActsIn::kCalibrated : ActsIn::kPaper;
  YamlValue map = map_of(idle, whole);
  write_receivers(idle, whole, map);
  if (whole.world.empty() && whole.points.empty() && !whole.surface) {
    map.entries.insert(map.entries.begin(), entry("world", scalar("none")));
  }
  return write_yaml(map);
}

}  // namespace insonify
