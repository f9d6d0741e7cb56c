// put_settings.cpp -- writes settings from the configurations' lists of fields and parts; absent ones are omitted.

#include "io/recording/put_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <type_traits>

#include "insonify/words.h"

namespace insonify {
namespace {

H5Note note_of(const Field& field) {
  return {field.unit.empty() ? "1" : field.unit, field.help};
}

// A value for a dataset: words and paths as text, whole numbers in 64 bits.
template <typename Member>
auto stored(const Member& member) {
  if constexpr (std::is_enum_v<Member>) {
    return std::string(word_of(member));
  } else if constexpr (std::is_same_v<Member, std::filesystem::path>) {
    return member.string();
  } else if constexpr (std::is_same_v<Member, int>) {
    return std::int64_t{member};
  } else {
    return member;
  }
}

template <typename Member>
void put_member(const H5Writer& writer, const std::string& name, const Field& field, const Member& member) {
  if constexpr (requires { member.has_value(); }) {
    if (member.has_value()) {
      put_member(writer, name, field, *member);
    }
  } else if constexpr (std::is_same_v<Member, Vec3> || std::is_same_v<Member, std::vector<double>>) {
    if (member.size() > 0) {
      writer.put(name, std::span<const double>(member.data(), static_cast<std::size_t>(member.size())), note_of(field));
    }
  } else if constexpr (std::is_same_v<Member, std::vector<int>>) {
    put_member(writer, name, field, std::vector<double>(member.begin(), member.end()));
  } else if constexpr (std::is_same_v<Member, std::vector<std::string>>) {
    if (!member.empty()) {
      writer.put(name, member, {"", field.help});
    }
  } else {
    const auto value = stored(member);
    const bool words = std::is_same_v<decltype(value), const std::string> || std::is_same_v<Member, bool>;
    writer.put(name, value, words ? H5Note{"", field.help} : note_of(field));
  }
}

// One field of several configurations of one type, a row for each: numbers, whole numbers or texts.
struct Column {
  std::vector<double> numbers = {};  // Three in a row for a vector.
  std::vector<std::uint64_t> whole = {};
  std::vector<std::string> texts = {};

  // @param absent  Stands for a number that is not given.
  template <typename Member>
  void add(const Member& member, double absent) {
    if constexpr (std::is_same_v<Member, Vec3>) {
      numbers.insert(numbers.end(), member.begin(), member.end());
    } else if constexpr (std::is_same_v<Member, double>) {
      numbers.push_back(member);
    } else if constexpr (std::is_same_v<Member, std::optional<double>>) {
      numbers.push_back(member.value_or(absent));
    } else if constexpr (std::is_same_v<Member, std::uint64_t>) {
      whole.push_back(member);
    } else {
      texts.push_back(stored(member));
    }
  }
};

template <typename Config>
void put_columns(const H5Writer& writer, const std::string& group, const std::vector<Config>& configs, double absent) {
  std::vector<Column> columns;
  for (const Config& config : configs) {
    std::size_t next = 0;
    Config::visit_fields(config, [&](const Field&, const auto& member) {
      columns.resize(std::max(columns.size(), next + 1));
      columns[next++].add(member, absent);
    });
  }
  auto next = columns.begin();
  const Config any{};
  Config::visit_fields(any, [&](const Field& field, const auto&) {
    if (next == columns.end()) {
      return;  // There are no entries.
    }
    const std::string name = fmt::format("{}/{}", group, field.name);
    const Column& column = *next++;
    if (!column.texts.empty()) {
      writer.put(name, column.texts, {"", field.help});
    } else if (!column.whole.empty()) {
      writer.put(name, column.whole, note_of(field));
    } else if (column.numbers.size() > configs.size()) {
      writer.put_rows(name, column.numbers, column.numbers.size() / configs.size(), note_of(field));
    } else {
      writer.put(name, column.numbers, note_of(field));
    }
  });
}

constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

template <typename Config>
void put_config(const H5Writer& writer, const std::string& group, const Config& config);

// A part by what it is: a struct, an optional one, a list or a map of them.
template <typename Member>
void put_part(const H5Writer& writer, const std::string& group, const Member& member) {
  if constexpr (requires { typename Member::mapped_type; }) {
    std::vector<std::string> names;
    std::vector<typename Member::mapped_type> entries;
    for (const auto& [name, entry] : member) {
      names.push_back(name);
      entries.push_back(entry);
    }
    if (!names.empty()) {
      writer.put(group + "/name", names, {"", "What the row is for."});
    }
    put_columns(writer, group, entries, kNotGiven);
  } else if constexpr (requires { member.has_value(); }) {
    if (member.has_value()) {
      put_config(writer, group, *member);
    }
  } else if constexpr (requires { member.begin(); }) {
    if constexpr (HasParts<typename Member::value_type>) {
      for (std::size_t i = 0; i < member.size(); ++i) {
        put_config(writer, fmt::format("{}/{}", group, i), member[i]);
      }
    } else {
      put_columns(writer, group, member, kNotGiven);
    }
  } else {
    put_config(writer, group, member);
  }
}

template <typename Config>
void put_config(const H5Writer& writer, const std::string& group, const Config& config) {
  Config::visit_fields(config, [&](const Field& field, const auto& member) {
    put_member(writer, fmt::format("{}/{}", group, field.name), field, member);
  });
  if constexpr (HasParts<Config>) {
    Config::visit_parts(config, [&](const Part& part, const auto& member) {
      put_part(writer, fmt::format("{}/{}", group, part.name), member);
    });
  }
}

// The materials in use, with what follows from their other properties filled in. A number that is absent is written as
// infinity: a solid without thickness, no clutter, unlimited scatterers.
void put_materials(const H5Writer& writer, const Scene& scene, double frequency) {
  std::vector<Material> materials = scene.materials;
  for (Material& material : materials) {
    material.reflectivity = material.effective_reflectivity();
    material.reflection = material.reflection_at(frequency);
    material.transmission = material.transmission_at(frequency);
  }
  put_columns(writer, "settings/materials", materials, std::numeric_limits<double>::infinity());
}

}  // namespace

void put_settings(const H5Writer& writer, const Scenario& scenario, const Scene& scene, const SonarConfig& sonar) {
  Scenario run = scenario;
  run.water = scenario.water_at(sonar);
  run.receiver = scenario.receiver_of(sonar);
  Scenario::visit_fields(run, [&](const Field& field, const auto& member) {
    put_member(writer, fmt::format("settings/{}", field.name), field, member);
  });
  Scenario::visit_parts(run, [&](const Part& part, const auto& member) {
    if (part.name == "materials") {
      put_part(writer, "settings/material_rules", member);
    } else if (part.name != "sonars") {
      put_part(writer, fmt::format("settings/{}", part.name), member);
    }
  });
  SonarConfig own = sonar;
  own.receiver.reset();
  put_config(writer, "settings/sonar", own);
  put_materials(writer, scene, sonar.frequency);
}

}  // namespace insonify
