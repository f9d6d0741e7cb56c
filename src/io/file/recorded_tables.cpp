// recorded_tables.cpp -- finds tables by name, and reads configurations from the settings.

#include "io/file/recorded_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

}  // namespace

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
