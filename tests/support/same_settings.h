// same_settings.h -- expects two configurations to have the same values, by their lists of fields and parts.

#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "insonify/field.h"
#include "insonify/geometry.h"

namespace insonify {

/// Every value of a configuration as text, by its name: "sonars[0].max_range = 30 0x1.ep+4". Floating point exactly.
/// @param idle  Model whose own fields are left out.
template <typename Config>
std::vector<std::string> settings_of(const std::string& object, const Config& config,
                                     ActsIn idle = ActsIn::kEveryModel) {
  std::vector<std::string> list;
  const std::string prefix = object.empty() ? "" : object + ".";
  Config::visit_fields(config, [&](const Field& field, const auto& member) {
    if (field.acts == idle && idle != ActsIn::kEveryModel) {
      return;
    }
    list.push_back(prefix + std::string(field.name) + " = " + testing::PrintToString(member));
    const auto add = [&](double value) {
      char text[32];
      (void)std::snprintf(text, sizeof text, " %a", value);
      list.back() += text;
    };
    using Member = std::remove_cvref_t<decltype(member)>;
    if constexpr (std::is_same_v<Member, double>) {
      add(member);
    } else if constexpr (std::is_same_v<Member, std::optional<double>>) {
      add(member.value_or(0));
    } else if constexpr (std::is_same_v<Member, Vec3> || std::is_same_v<Member, std::vector<double>>) {
      for (const double value : member) {
        add(value);
      }
    }
  });
  if constexpr (HasParts<Config>) {
    Config::visit_parts(config, [&](const Part& part, const auto& member) {
      visit_entries(prefix + std::string(part.name), member, [&](const std::string& name, const auto& entry) {
        list.push_back(name);
        const std::vector<std::string> more = settings_of(name, entry, idle);
        list.insert(list.end(), more.begin(), more.end());
      });
    });
  }
  return list;
}

}  // namespace insonify
