// yaml_read.cpp -- converts YAML to members, with messages for values of another type.

#include "io/scenario/yaml_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/names.h"
#include "base/utf8.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

using Kind = YamlValue::Kind;

std::string name_of(std::string_view object, const Field& field, int index = -1) {
  return member_name(object, file_name_of(field)) + (index < 0 ? "" : fmt::format("[{}]", index));
}

// The message for a value of the wrong kind.
[[noreturn]] void refuse(const YamlValue& value, const std::string& name, std::string_view expected) {
  if (value.kind == Kind::kNothing) {
    throw Error("", name, fmt::format(" has no value; it must be {}", expected)).at(value.place);
  }
  throw Error("", name, fmt::format(" = {} must be {}", value.shown(), expected)).at(value.place);
}

std::string number_wanted(const Field& field, std::string_view kind) {
  const std::string limits = field.limits.text(file_scale_of(field));
  const std::string_view unit = file_unit_of(field);
  if (limits == "any finite number") {
    return unit.empty() ? std::string(kind) : fmt::format("{} [{}]", kind, unit);
  }
  return unit.empty() ? fmt::format("{}, {}", kind, limits) : fmt::format("{}, {} {}", kind, limits, unit);
}

template <typename Number>
std::optional<Number> whole_text_as(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    return std::numeric_limits<Number>::has_infinity ? std::optional(std::numeric_limits<Number>::infinity())
                                                     : std::nullopt;
  }
  return number;
}

// Parses a YAML number. Infinities and NaN are parsed too, so that the message gives the limits of the field.
std::optional<double> number_in(const YamlValue& value) {
  if (value.kind != Kind::kScalar || value.quoted) {
    return std::nullopt;
  }
  std::string_view text = value.scalar;
  if (text == ".nan" || text == ".NaN" || text == ".NAN" || text == ".inf" || text == ".Inf" || text == "-.inf") {
    return text.back() == 'f' ? std::numeric_limits<double>::infinity() * (text.front() == '-' ? -1 : 1)
                              : std::numeric_limits<double>::quiet_NaN();
  }
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') {
    text.remove_prefix(1);
  }
  return whole_text_as<double>(text);
}

double stored_number(const YamlValue& value, std::string_view object, const Field& field, int index = -1) {
  const std::optional<double> written = number_in(value);
  if (!written) {
    refuse(value, name_of(object, field, index), number_wanted(field, "a number"));
  }
  const double stored = field.unit == "rad" ? radians_from_degrees(*written) : *written;
  with_place(value.place, [&] { check_field(object, field, stored, index); });
  return stored;
}

int stored_whole_number(const YamlValue& value, std::string_view object, const Field& field, int index = -1) {
  const std::optional<double> written = number_in(value);
  if (written && std::isfinite(*written) && *written == std::floor(*written)) {
    with_place(value.place, [&] { check_field(object, field, *written, index); });
    if (std::abs(*written) <= std::numeric_limits<int>::max()) {
      return static_cast<int>(*written);
    }
  }
  refuse(value, name_of(object, field, index), number_wanted(field, "a whole number"));
}

std::string listed(std::span<const std::string_view> words) {
  std::string text(words.front());
  for (std::size_t i = 1; i < words.size(); ++i) {
    text += fmt::format("{}{}", i + 1 < words.size() ? ", " : " or ", words[i]);
  }
  return text;
}

// The right name of an angle that was written without `_deg`, or as `_rad`.
std::optional<std::string> misspelt_angle(std::string_view key, std::span<const std::string> known) {
  const std::string_view stem = key.ends_with("_rad") ? key.substr(0, key.size() - 4) : key;
  const std::string in_degrees = std::string(stem) + "_deg";
  return std::ranges::find(known, in_degrees) == known.end() ? std::nullopt : std::optional(in_degrees);
}

}  // namespace

void require_map(const YamlValue& value, std::string_view object, std::string_view expected) {
  if (value.kind != Kind::kMap) {
    refuse(value, std::string(object), expected);
  }
}

void require_list(const YamlValue& value, std::string_view object, std::string_view expected) {
  if (value.kind != Kind::kList) {
    refuse(value, std::string(object), expected);
  }
}

std::string key_suggestion(std::string_view key, std::span<const std::string> known,
                           std::span<const std::string> elsewhere) {
  const auto path = std::ranges::find_if(
      elsewhere, [&](std::string_view candidate) { return candidate.substr(candidate.rfind('.') + 1) == key; });
  return path == elsewhere.end() ? suggestion(key, known) : "; did you mean " + *path + "?";
}

void check_keys(const YamlValue& map, std::string_view object, std::span<const std::string> known,
                std::span<const std::string> elsewhere) {
  for (const auto& [key, value] : map.entries) {
    if (std::ranges::find(known, key) != known.end()) {
      continue;
    }
    const std::string name = member_name(object, printable(key));
    if (const auto in_degrees = misspelt_angle(key, known)) {
      throw Error("", name, fmt::format(" must be written {}, in degrees", *in_degrees)).at(value.place);
    }
    throw Error("", name, fmt::format(" is not a known key{}", key_suggestion(key, known, elsewhere))).at(value.place);
  }
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, double& member) {
  member = stored_number(value, object, field);
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, int& member) {
  member = stored_whole_number(value, object, field);
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, std::uint64_t& member) {
  const bool plain = value.kind == Kind::kScalar && !value.quoted;
  const auto number = plain ? whole_text_as<std::uint64_t>(value.scalar) : std::nullopt;
  if (!number) {
    refuse(value, name_of(object, field),
           fmt::format("a whole number, from 0 to {}", std::numeric_limits<std::uint64_t>::max()));
  }
  member = *number;
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, bool& member) {
  if (value.kind != Kind::kScalar || (value.scalar != "true" && value.scalar != "false")) {
    refuse(value, name_of(object, field), "true or false");
  }
  member = value.scalar == "true";
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, std::string& member) {
  if (value.kind != Kind::kScalar) {
    refuse(value, name_of(object, field), "a text");
  }
  member = as_utf8(value.scalar);
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, std::filesystem::path& member) {
  if (value.kind != Kind::kScalar || value.scalar.empty()) {
    refuse(value, name_of(object, field), "a file");
  }
  member = value.scalar;
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, Vec3& member) {
  if (value.kind != Kind::kList || value.items.size() != 3) {
    refuse(value, name_of(object, field), "a list of three numbers");
  }
  for (int i = 0; i < 3; ++i) {
    member[i] = stored_number(value.items[i], object, field, i);
  }
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, std::vector<double>& member) {
  require_list(value, name_of(object, field), "a list of numbers");
  member.clear();
  for (const YamlValue& item : value.items) {
    member.push_back(stored_number(item, object, field, static_cast<int>(member.size())));
  }
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, std::vector<int>& member) {
  require_list(value, name_of(object, field), "a list of whole numbers");
  member.clear();
  for (const YamlValue& item : value.items) {
    member.push_back(stored_whole_number(item, object, field, static_cast<int>(member.size())));
  }
}

void read_member(const YamlValue& value, std::string_view object, const Field& field,
                 std::vector<std::string>& member) {
  require_list(value, name_of(object, field), "a list of texts");
  member.clear();
  for (const YamlValue& item : value.items) {
    if (item.kind != Kind::kScalar || item.scalar.empty()) {
      refuse(item, fmt::format("{}[{}]", name_of(object, field), member.size()), "a text");
    }
    member.push_back(as_utf8(item.scalar));
  }
}

void read_member(const YamlValue& value, std::string_view object, const Field& field, EnumWord& member) {
  const std::vector<std::string_view>& words = member.list->words;
  const auto word = value.kind == Kind::kScalar ? std::ranges::find(words, value.scalar) : words.end();
  if (word == words.end()) {
    refuse(value, name_of(object, field), listed(words));
  }
  member.index = static_cast<std::size_t>(word - words.begin());
}

void read_quaternion(const YamlValue& value, std::string_view object, const Field& field, bool twice, Vec3& rpy) {
  const std::string key = quaternion_name_of(field);
  if (twice) {
    throw Error(object, key, fmt::format(" cannot go with {}: one orientation", file_name_of(field))).at(value.place);
  }
  if (value.kind != Kind::kList || value.items.size() != 4) {
    refuse(value, member_name(object, key), "a list of four numbers, w x y z");
  }
  std::vector<double> numbers;
  read_member(value, object, Field{key, "", from_to(-2, 2), ""}, numbers);
  const Eigen::Quaterniond quaternion(numbers[0], numbers[1], numbers[2], numbers[3]);
  constexpr double kTolerance = 0.01;  // Tolerance for values written with few digits.
  if (!(std::abs(quaternion.norm() - 1) <= kTolerance)) {
    throw Error(object, key, fmt::format(" = {} must have a norm of 1, not {:.4g}", value.shown(), quaternion.norm()))
        .at(value.place);
  }
  rpy = rpy_from_orientation(quaternion.normalized());
}

}  // namespace insonify
