// yaml_value.h -- a YAML text as a tree of values with their places.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "insonify/error.h"

namespace insonify {

/// One value of a YAML text.
struct YamlValue {
  enum class Kind { kNothing, kScalar, kList, kMap };
  struct Entry;

  Kind kind = Kind::kNothing;
  Place place = {};         ///< For messages: of the key in a map, else of the value itself.
  std::string scalar = {};  ///< Text of a scalar.
  bool quoted = false;      ///< Whether the scalar was in quotes, and so is text even if it looks like a number.
  std::vector<YamlValue> items = {};  ///< Items of a list.
  std::vector<Entry> entries = {};    ///< Entries of a map, in order; keys differ.

  /// The value of a key, or null.
  [[nodiscard]] const YamlValue* find(std::string_view key) const;
  [[nodiscard]] YamlValue* find(std::string_view key);

  /// The value as messages show it, on one line and not too long: 3, "three", [1, 2], {...}.
  [[nodiscard]] std::string shown() const;
};

struct YamlValue::Entry {
  std::string key;
  YamlValue value;
};

/// A scalar without a place.
[[nodiscard]] YamlValue scalar(std::string text, bool quoted = false);

/// Reads one YAML document, merge keys (`<<: *name`) included.
/// @param path  The file's name in messages.
/// @throws Error "path:line:column: ..." for text that is not YAML, a key given twice, or more than one document.
[[nodiscard]] YamlValue parse_yaml(const std::string& text, const std::string& path);

/// Reads a value given on the command line, with `place` as its place.
[[nodiscard]] YamlValue parse_yaml_setting(const std::string& text, const Place& place);

/// Writes a tree as YAML again.
[[nodiscard]] std::string write_yaml(const YamlValue& value);

/// Text in double quotes, for messages.
[[nodiscard]] std::string quoted_text(std::string_view text);

}  // namespace insonify
