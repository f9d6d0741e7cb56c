// put_settings.cpp -- writes settings from the tables of the configurations; absent ones are omitted.

#include "io/recording/put_settings.h"

#include <fmt/format.h>

#include <cassert>
#include <limits>
#include <type_traits>

namespace insonify {
namespace {

H5Note note_of(const Field& field) {
  return {field.unit.empty() ? "1" : field.unit, field.help};
}

// A value for a dataset: words and paths as text, whole numbers in 64 bits.
template <typename Member>
auto stored(const Member& member) {
  if constexpr (std::is_same_v<Member, EnumWord>) {
    return std::string(member.text());
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

void put_fields(const H5Writer& writer, const std::string& group, ConstSettings settings) {
  for (const FieldEntry& field : settings.table->fields) {
    field.get(settings.config,
              [&](const auto& member) { put_member(writer, fmt::format("{}/{}", group, field.name), field, member); });
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
    } else if constexpr (std::is_convertible_v<decltype(stored(member)), std::string>) {
      texts.push_back(stored(member));
    } else {
      assert(false && "lists and switches have no columns");
    }
  }
};

void put_columns(const H5Writer& writer, const std::string& group, std::span<const ConstSettings> rows, double absent) {
  if (rows.empty()) {
    return;
  }
  for (const FieldEntry& field : rows.front().table->fields) {
    Column column;
    for (const ConstSettings& row : rows) {
      field.get(row.config, [&](const auto& member) { column.add(member, absent); });
    }
    const std::string name = fmt::format("{}/{}", group, field.name);
    if (!column.texts.empty()) {
      writer.put(name, column.texts, {"", field.help});
    } else if (!column.whole.empty()) {
      writer.put(name, column.whole, note_of(field));
    } else if (column.numbers.size() > rows.size()) {
      writer.put_rows(name, column.numbers, column.numbers.size() / rows.size(), note_of(field));
    } else {
      writer.put(name, column.numbers, note_of(field));
    }
  }
}

void put_config(const H5Writer& writer, const std::string& group, ConstSettings settings);

// A part by what it is: a struct, an optional one, a list or a map of them.
void put_part(const H5Writer& writer, const std::string& group, const PartEntry& part, const void* config) {
  std::vector<ConstSettings> rows;
  std::vector<std::string> names;
  for (const auto& [suffix, settings] : part.entries(config)) {
    if (part.shape == PartShape::kStruct || part.shape == PartShape::kOptional) {
      put_config(writer, group, settings);
    } else if (part.shape == PartShape::kList && !part.table->parts.empty()) {
      put_config(writer, fmt::format("{}/{}", group, suffix.substr(1, suffix.size() - 2)), settings);
    } else {
      rows.push_back(settings);
      names.push_back(suffix.substr(1));
    }
  }
  if (part.shape == PartShape::kMap && !names.empty()) {
    writer.put(group + "/name", names, {"", "What the row is for."});
  }
  put_columns(writer, group, rows, std::numeric_limits<double>::quiet_NaN());
}

void put_config(const H5Writer& writer, const std::string& group, ConstSettings settings) {
  put_fields(writer, group, settings);
  for (const PartEntry& part : settings.table->parts) {
    put_part(writer, fmt::format("{}/{}", group, part.name), part, settings.config);
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
  const std::vector<ConstSettings> rows(materials.begin(), materials.end());
  put_columns(writer, "settings/materials", rows, std::numeric_limits<double>::infinity());
}

}  // namespace

void put_settings(const H5Writer& writer, const Scenario& scenario, const Scene& scene, const SonarConfig& sonar) {
  Scenario run = scenario;
  run.water = scenario.water_at(sonar);
  run.receiver = scenario.receiver_of(sonar);
  put_fields(writer, "settings", run);
  for (const PartEntry& part : table_of<Scenario>().parts) {
    if (part.name != "sonars") {
      const std::string_view name = part.name == "materials" ? "material_rules" : part.name;
      put_part(writer, fmt::format("settings/{}", name), part, &run);
    }
  }
  SonarConfig own = sonar;
  own.receiver.reset();
  put_config(writer, "settings/sonar", own);
  put_materials(writer, scene, sonar.frequency);
}

}  // namespace insonify
