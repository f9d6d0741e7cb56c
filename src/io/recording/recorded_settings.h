// recorded_settings.h -- reads the settings of a recording from its HDF5 file.

#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "insonify/field.h"
#include "insonify/geometry.h"
#include "insonify/words.h"
#include "io/file/hdf5.h"

namespace insonify {

/// Reads datasets of one file by their path. Each function throws Error with the file's path for a dataset of the wrong
/// type, and returns nothing for a missing one.
class H5Settings {
 public:
  H5Settings(hid_t file, std::filesystem::path path);

  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] std::optional<std::string> text(const std::string& name) const;

  /// Numbers of any type, truth values as 0 and 1; a single number is a vector of one.
  [[nodiscard]] std::optional<std::vector<double>> numbers(const std::string& name) const;

  /// @throws Error: the dataset has the wrong contents.
  [[noreturn]] void fail(const std::string& name, const std::string& what) const;

 private:
  hid_t file_;
  std::filesystem::path path_;
};

/// Sets one member of a configuration of any type; unchanged if the file does not have it.
template <typename Member>
void read_member(const H5Settings& settings, const std::string& name, Member& member) {
  if constexpr (std::is_enum_v<Member>) {
    if (const std::optional<std::string> word = settings.text(name)) {
      for (const auto& [known, value] : words_of<Member>()) {
        if (known == *word) {
          member = value;
          return;
        }
      }
      settings.fail(name, "holds a word that is not known: " + *word);
    }
  } else if constexpr (std::is_same_v<Member, std::string>) {
    member = settings.text(name).value_or(member);
  } else if constexpr (std::is_arithmetic_v<Member>) {
    if (const auto numbers = settings.numbers(name)) {
      if (numbers->size() != 1) {
        settings.fail(name, "must hold one number");
      }
      member = static_cast<Member>(numbers->front());
    }
  } else if constexpr (requires { member.has_value(); }) {
    if (settings.has(name)) {
      read_member(settings, name, member.emplace());
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
  } else if constexpr (requires { member.push_back(0.0); }) {
    member = settings.numbers(name).value_or(member);
  } else {
    static_assert(std::is_same_v<Member, Vec3>);
    if (const auto numbers = settings.numbers(name)) {
      if (numbers->size() != 3) {
        settings.fail(name, "must hold three numbers");
      }
      member = Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
    }
  }
}

/// Reads a configuration from a group of datasets named after its fields.
/// @throws Error if there is no such group.
template <typename Config>
Config read_settings(const H5Settings& settings, const std::string& group) {
  if (!settings.has(group)) {
    settings.fail(group, "is not in the file: it was not recorded by insonify");
  }
  Config config;
  Config::visit_fields(config, [&](const Field& field, auto& member) {
    read_member(settings, group + "/" + std::string(field.name), member);
  });
  return config;
}

}  // namespace insonify
