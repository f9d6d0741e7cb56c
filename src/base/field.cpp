// field.cpp -- formats limits as text, checks values against them, and lists the structs of a part.

#include "insonify/field.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "insonify/error.h"
#include "insonify/settings_table.h"

namespace insonify {
namespace {

// Ten digits: enough to distinguish any two values a user would write, and few enough to hide binary rounding.
std::string number(double value) {
  return fmt::format("{:.10g}", value);
}

std::string with_unit(std::string text, std::string_view unit) {
  return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

}  // namespace

bool Limits::allow(double value) const {
  return std::isfinite(value) && (value > least || (least_allowed && value == least)) &&
         (value < most || (most_allowed && value == most));
}

std::string Limits::text(double scale) const {
  const bool has_least = std::isfinite(least);
  const bool has_most = std::isfinite(most);
  if (has_least && has_most) {
    if (least_allowed && most_allowed) {
      return fmt::format("from {} to {}", number(least * scale), number(most * scale));
    }
    return fmt::format("{} {}, {} {}", least_allowed ? "at least" : "greater than", number(least * scale),
                       most_allowed ? "at most" : "less than", number(most * scale));
  }
  if (has_least) {
    return fmt::format("{} {}", least_allowed ? "at least" : "greater than", number(least * scale));
  }
  if (has_most) {
    return fmt::format("{} {}", most_allowed ? "at most" : "less than", number(most * scale));
  }
  return "any finite number";
}

std::string file_name_of(const Field& field) {
  return field.unit == "rad" ? fmt::format("{}_deg", field.name) : std::string(field.name);
}

double file_scale_of(const Field& field) {
  return field.unit == "rad" ? 180 / std::numbers::pi : 1;
}

std::string_view file_unit_of(const Field& field) {
  return field.unit == "rad" ? "deg" : field.unit;
}

void check_field(std::string_view object, const Field& field, double value, int index) {
  if (field.limits.allow(value)) {
    return;
  }
  const double scale = file_scale_of(field);
  const std::string limits = field.limits.text(scale);
  const std::string must = limits == "any finite number"
                               ? "a finite number"
                               : (std::isinf(value) ? "finite and " : "") + with_unit(limits, file_unit_of(field));
  const std::string name = file_name_of(field) + (index < 0 ? "" : fmt::format("[{}]", index));
  throw Error(object, name,
              fmt::format(" = {} must be {}", with_unit(number(value * scale), file_unit_of(field)), must));
}

bool FieldEntry::equal(const void* config, const void* other) const {
  return get(config, [&]<typename Member>(const Member& member) {
    const void* place = in(other);
    if constexpr (std::is_same_v<Member, EnumWord>) {
      return member.index == words->get(place);
    } else {
      return member == *static_cast<const Member*>(place);
    }
  });
}

void FieldEntry::copy(const void* from, void* to) const {
  change(to, [&]<typename Member>(Member& member) {
    const void* place = in(from);
    if constexpr (std::is_same_v<Member, EnumWord>) {
      member.index = words->get(place);
    } else {
      member = *static_cast<const Member*>(place);
    }
  });
}

std::vector<PartEntry::Entry> PartEntry::entries(const void* config) const {
  std::vector<Entry> all;
  for (const auto& [suffix, place] : list_at(static_cast<const std::byte*>(config) + offset)) {
    all.push_back({suffix, {*table, place}});
  }
  return all;
}

void check_fields(std::string_view object, ConstSettings settings) {
  for (const FieldEntry& field : settings.table->fields) {
    field.get(settings.config, [&](const auto& member) { check_member(object, field, member); });
  }
  for (const PartEntry& part : settings.table->parts) {
    for (const auto& [suffix, entry] : part.entries(settings.config)) {
      check_fields(member_name(object, part.name) + suffix, entry);
    }
  }
}

}  // namespace insonify
