// to_yaml.cpp -- writes a scenario as YAML, by the tables of fields and parts that also read it.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "insonify/files.h"
#include "io/file/input_file.h"
#include "io/scenario/yaml_value.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

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
YamlValue written(const Field& /*field*/, const EnumWord& member) {
  return scalar(std::string(member.text()));
}
template <typename List>
requires requires(const List& list) {
  list.begin();
}
YamlValue written(const Field& field, const List& member) {
  YamlValue list{.kind = Kind::kList};
  for (const auto& value : member) {
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
bool is_refused(ConstSettings settings, const Field& field) {
  if (settings.table != &table_of<SonarConfig>()) {
    return false;
  }
  const auto& sonar = *static_cast<const SonarConfig*>(settings.config);
  const std::string_view name = field.name;
  return SonarConfig::only_type(name).value_or(sonar.type) != sonar.type ||
         (name == "azimuth_aperture" && sonar.beam_azimuths.size() > 1);
}

YamlValue written_part(ActsIn idle, const PartEntry& part, const void* config);

// What differs from the defaults.
// @param idle  The model that the scenario does not use, whose fields are omitted.
YamlValue map_of(ActsIn idle, ConstSettings settings, const void* defaults) {
  YamlValue map{.kind = Kind::kMap};
  for (const FieldEntry& field : settings.table->fields) {
    const auto write = [&](const auto& member) { return written(field, member); };
    YamlValue value = field.get(settings.config, write);
    if (!same(value, field.get(defaults, write)) && field.acts != idle && !is_refused(settings, field)) {
      map.entries.push_back({file_name_of(field), value.kind == Kind::kNothing ? scalar("none") : std::move(value)});
    }
  }
  for (const PartEntry& part : settings.table->parts) {
    YamlValue value = written_part(idle, part, settings.config);
    if (value.kind != Kind::kNothing) {
      map.entries.push_back({std::string(part.name), std::move(value)});
    }
  }
  return map;
}

YamlValue written_part(ActsIn idle, const PartEntry& part, const void* config) {
  YamlValue list{.kind = part.shape == PartShape::kMap ? Kind::kMap : Kind::kList};
  for (const auto& [suffix, settings] : part.entries(config)) {
    YamlValue map = map_of(idle, settings, part.table->defaults);
    if (part.shape == PartShape::kMap) {
      list.entries.push_back({suffix.substr(1), std::move(map)});
    } else if (part.shape == PartShape::kList) {
      list.items.push_back(std::move(map));
    } else {
      return part.shape == PartShape::kStruct && map.entries.empty() ? YamlValue() : map;
    }
  }
  return list.entries.empty() && list.items.empty() ? YamlValue() : list;
}

// Replaces each sonar's own receiver by its differences from the scenario's receiver, from which reading starts.
void write_receivers(ActsIn idle, const Scenario& scenario, YamlValue& map) {
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    if (scenario.sonars[i].receiver) {
      *map.find("sonars")->items[i].find("receiver") = map_of(idle, *scenario.sonars[i].receiver, &scenario.receiver);
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
    for (const FieldEntry& field : table_of<MaterialOverride>().fields) {
      field.change(&changes, [&]<typename Member>(Member& member) {
        if constexpr (std::is_same_v<Member, std::filesystem::path>) {
          make_absolute(member);
        }
      });
    }
  }
  const ActsIn idle = scenario.model == EchoModel::kPaper ? ActsIn::kCalibrated : ActsIn::kPaper;
  YamlValue map = map_of(idle, whole, table_of<Scenario>().defaults);
  write_receivers(idle, whole, map);
  if (whole.world.empty() && whole.points.empty() && !whole.surface) {
    map.entries.insert(map.entries.begin(), {"world", scalar("none")});
  }
  return write_yaml(map);
}

}  // namespace insonify
