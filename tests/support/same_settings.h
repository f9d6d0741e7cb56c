// same_settings.h -- expects two configurations to have the same values, by their tables of fields and parts.

#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "insonify/error.h"
#include "insonify/settings_table.h"

namespace insonify {

/// Every value of a configuration as text, by its name: "sonars[0].max_range = 30 0x1.ep+4". Floating point exactly.
/// @param idle  Model whose own fields are left out.
inline std::vector<std::string> settings_of(const std::string& object, ConstSettings settings,
                                            ActsIn idle = ActsIn::kEveryModel) {
  std::vector<std::string> list;
  for (const FieldEntry& field : settings.table->fields) {
    if (field.acts == idle && idle != ActsIn::kEveryModel) {
      continue;
    }
    std::string& text = list.emplace_back(member_name(object, field.name) + " = ");
    const auto add = [&](double value) {
      char exactly[32];
      (void)std::snprintf(exactly, sizeof exactly, " %a", value);
      text += exactly;
    };
    field.get(settings.config, [&]<typename Member>(const Member& member) {
      if constexpr (std::is_same_v<Member, EnumWord>) {
        text += member.text();
      } else {
        text += testing::PrintToString(member);
      }
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
  }
  for (const PartEntry& part : settings.table->parts) {
    for (const auto& [suffix, entry] : part.entries(settings.config)) {
      const std::string name = member_name(object, part.name) + suffix;
      list.push_back(name);
      const std::vector<std::string> more = settings_of(name, entry, idle);
      list.insert(list.end(), more.begin(), more.end());
    }
  }
  return list;
}

}  // namespace insonify
