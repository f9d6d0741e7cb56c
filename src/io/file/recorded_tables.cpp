// recorded_tables.cpp -- finds tables by name, and reads configurations from the settings.

#include "io/file/recorded_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <type_traits>

#include "insonify/error.h"
#include "insonify/geometry.h"
#include "insonify/printable.h"
#include "insonify/words.h"

namespace insonify {
namespace {

// JSON has no infinite numbers: they are texts.
std::optional<double> number_of_json(const nlohmann::json& value) {
  if (value.is_boolean()) {
    return value.get<bool>() ? 1 : 0;
  }
  if (value == "nan" || value == "inf" || value == "-inf") {
    return std::strtod(value.get_ref<const std::string&>().c_str(), nullptr);
  }
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

// The settings of one recording by their path: "settings/sonar/max_range".
class RecordedSettings {
 public:
  RecordedSettings(const nlohmann::json& settings, const std::filesystem::path& path)
      : all_(nlohmann::json::object({{"settings", settings}})), path_(path) {}

  // Null if there is none.
  [[nodiscard]] const nlohmann::json* find(const std::string& name) const {
    const nlohmann::json::json_pointer place("/" + name);
    return all_.contains(place) ? &all_[place] : nullptr;
  }

  [[nodiscard]] std::optional<std::string> text(const std::string& name) const {
    const nlohmann::json* value = find(name);
    if (value != nullptr && !value->is_string()) {
      fail(name, "must hold one text");
    }
    return value == nullptr ? std::nullopt : std::optional(value->get<std::string>());
  }

  // Truth values as 0 and 1; a single number is a vector of one.
  [[nodiscard]] std::optional<std::vector<double>> numbers(const std::string& name) const {
    const nlohmann::json* value = find(name);
    if (value == nullptr) {
      return {};
    }
    std::vector<double> numbers;
    for (const nlohmann::json& each : value->is_array() ? *value : nlohmann::json::array({*value})) {
      const std::optional<double> number = number_of_json(each);
      if (!number) {
        fail(name, "must hold numbers");
      }
      numbers.push_back(*number);
    }
    return numbers;
  }

  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw Error(fmt::format("{}: {} {}", path_.string(), name, what));
  }

 private:
  nlohmann::json all_;
  const std::filesystem::path& path_;
};

// Sets one member of a configuration of any type; unchanged if the file does not have it.
template <typename Member>
void read_recorded(const RecordedSettings& settings, const std::string& name, Member& member) {
  if constexpr (std::is_same_v<Member, EnumWord>) {
    if (const std::optional<std::string> word = settings.text(name)) {
      const auto known = std::ranges::find(member.list->words, *word);
      if (known == member.list->words.end()) {
        settings.fail(name, "holds a word that is not known: " + *word);
      }
      member.index = static_cast<std::size_t>(known - member.list->words.begin());
    }
  } else if constexpr (std::is_same_v<Member, std::string> || std::is_same_v<Member, std::filesystem::path>) {
    member = settings.text(name).value_or(member);
  } else if constexpr (std::is_arithmetic_v<Member>) {
    if (const auto numbers = settings.numbers(name)) {
      if (numbers->size() != 1) {
        settings.fail(name, "must hold one number");
      }
      member = static_cast<Member>(numbers->front());
    }
  } else if constexpr (requires { member.has_value(); }) {
    if (settings.find(name) != nullptr) {
      read_recorded(settings, name, member.emplace());
    }
  } else if constexpr (std::is_same_v<Member, std::vector<int>>) {
    if (const auto numbers = settings.numbers(name)) {
      member.clear();
      for (const double number : *numbers) {
        if (!(std::abs(number) <= std::numeric_limits<int>::max()) || number != std::floor(number)) {
          settings.fail(name, "must hold whole numbers");
        }
        member.push_back(static_cast<int>(number));
      }
    }
  } else if constexpr (std::is_same_v<Member, std::vector<double>>) {
    member = settings.numbers(name).value_or(member);
  } else if constexpr (std::is_same_v<Member, Vec3>) {
    if (const auto numbers = settings.numbers(name)) {
      if (numbers->size() != 3) {
        settings.fail(name, "must hold three numbers");
      }
      member = Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    }
  }
}

// Reads a configuration from a group of settings named after its fields.
// @throws Error if there is no such group.
template <typename Config>
Config read_settings(const RecordedSettings& settings, const std::string& group) {
  if (settings.find(group) == nullptr) {
    settings.fail(group, "is not in the file: it was not recorded by insonify");
  }
  Config config;
  for (const FieldEntry& field : table_of<Config>().fields) {
    field.change(&config,
                 [&](auto& member) { read_recorded(settings, group + "/" + std::string(field.name), member); });
  }
  return config;
}

// A member of a configuration as JSON, as in recordings: words as texts, angles in radians; null if there is none.
template <typename Member>
nlohmann::json json_of_member(const Member& member) {
  if constexpr (std::is_same_v<Member, EnumWord>) {
    return member.text();
  } else if constexpr (requires { member.has_value(); }) {
    return member ? nlohmann::json(*member) : nlohmann::json();
  } else if constexpr (std::is_same_v<Member, Vec3>) {
    return std::vector<double>(member.begin(), member.end());
  } else if constexpr (std::is_same_v<Member, std::vector<int>> || std::is_same_v<Member, std::vector<double>>) {
    return member.empty() ? nlohmann::json() : nlohmann::json(std::vector<double>(member.begin(), member.end()));
  } else if constexpr (std::is_same_v<Member, std::filesystem::path>) {
    return member.string();
  } else {
    return member;
  }
}

// Appends the selected slice of a row-major block.
void take_block(std::span<const std::byte> block, std::size_t value_bytes, std::span<const std::uint64_t> shape,
                std::span<const TableSlice> slices, std::byte*& into) {
  if (shape.empty()) {
    std::memcpy(into, block.data(), value_bytes);
    into += value_bytes;
    return;
  }
  const std::size_t each = block.size() / shape.front();
  for (std::uint64_t i = 0; i < slices.front().count; ++i) {
    const std::uint64_t at = slices.front().start + i * slices.front().step;
    take_block(block.subspan(at * each, each), value_bytes, shape.subspan(1), slices.subspan(1), into);
  }
}

}  // namespace

nlohmann::json settings_json(ConstSettings settings) {
  nlohmann::json object = nlohmann::json::object();
  for (const FieldEntry& field : settings.table->fields) {
    nlohmann::json value = field.get(settings.config, [](const auto& member) { return json_of_member(member); });
    if (!value.is_null()) {
      object[std::string(field.name)] = std::move(value);
    }
  }
  for (const PartEntry& part : settings.table->parts) {
    for (const auto& [suffix, entry] : part.entries(settings.config)) {
      object[std::string(part.name)] = settings_json(entry);
    }
  }
  return object;
}

const RecordedTable* RecordedTables::find(const std::string& name) const {
  const auto found = std::ranges::find(tables_, name, &RecordedTable::name);
  return found == tables_.end() ? nullptr : &*found;
}

const RecordedTable& RecordedTables::table(const std::string& name) const {
  if (const RecordedTable* found = find(name)) {
    return *found;
  }
  throw Error(fmt::format("{}: has no table {}", path_.string(), printable(name)));
}

nlohmann::json RecordedTables::summary() const {
  return {{"tables", tables_},
          {"names", names_},
          {"ping_count", ping_count_},
          {"attributes", attributes_},
          {"state", state_ ? nlohmann::json(*state_) : nlohmann::json()}};
}

void RecordedTables::read_by_rows(const RecordedTable& table, std::span<const TableSlice> slices,
                                  std::span<std::byte> bytes) const {
  std::byte* into = bytes.data();
  if (!table.by_ping) {
    take_block(row(table, 0), table.value_bytes, table.row, slices, into);
    return;
  }
  for (std::uint64_t i = 0; i < slices.front().count; ++i) {
    take_block(row(table, slices.front().start + i * slices.front().step), table.value_bytes, table.row,
               slices.subspan(1), into);
  }
}

SonarConfig RecordedTables::sonar_config() const {
  auto sonar = read_settings<SonarConfig>({settings(), path_}, "settings/sonar");
  try {
    sonar.validate();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path_.string(), error.what()));
  }
  const RecordedTable* intensity = find("intensity");
  const auto length = [&](std::size_t axis) {
    return intensity != nullptr && axis < intensity->row.size() ? intensity->row[axis] : 0;
  };
  if (static_cast<std::uint64_t>(sonar.bin_count) != length(0) ||
      static_cast<std::uint64_t>(sonar.beam_count) != length(1)) {
    throw Error(fmt::format("{}: intensity has {} x {}, settings/sonar {} x {}", path_.string(),
                            counted(length(0), "bin"), counted(length(1), "beam"), sonar.bin_count, sonar.beam_count));
  }
  return sonar;
}

ReceiverConfig RecordedTables::receiver_config() const {
  return read_settings<ReceiverConfig>({settings(), path_}, "settings/receiver");
}

}  // namespace insonify
