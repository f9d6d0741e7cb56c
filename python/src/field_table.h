// field_table.h -- the fields of a configuration as a table, so that code for them is compiled once, not for each
// class.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "convert.h"
#include "insonify/field.h"
#include "python_types.h"

namespace insonify::python {

/// What is done with members of one C++ type; `member` points to one.
struct MemberType {
  py::object (*to_python)(const void* member, double scale);
  /// Leaves the member as it is where it throws: Error about `name` for a value of another kind or out of limits.
  void (*set)(py::handle value, const std::string& name, double scale, const Field& field, void* member);
  /// The same without limits.
  void (*restore)(py::handle value, const std::string& name, void* member);
  bool (*equal)(const void* one, const void* other);
  bool is_double;     ///< Else its default is shown as Python shows it.
  std::string words;  ///< Those of an enumeration: "fls, msis".
  PythonType python;  ///< For the type stubs.
};

/// One field of a configuration: where its member lies in the struct, and what that is.
struct FieldEntry {
  Field field;
  std::size_t offset;
  const MemberType* type;

  [[nodiscard]] const void* in(const void* config) const { return static_cast<const std::byte*>(config) + offset; }
  [[nodiscard]] void* in(void* config) const { return static_cast<std::byte*>(config) + offset; }
};

/// What can be done with all configurations; `config` points to the struct that the table was made from.
class FieldTable {
 public:
  explicit FieldTable(std::vector<FieldEntry> entries) : entries_(std::move(entries)) {}

  [[nodiscard]] std::span<const FieldEntry> entries() const { return entries_; }

  /// Sentence on a field for help(): meaning, unit, limits and default.
  [[nodiscard]] static std::string help_of(const FieldEntry& entry, const void* defaults, double scale,
                                           std::string_view unit);
  /// Values in SI units, in order.
  [[nodiscard]] py::list values(const void* config) const;
  void set_values(const py::list& values, void* config) const;
  [[nodiscard]] bool equal(const void* one, const void* other) const;
  /// "name='fls', max_range=20.0": what differs from the defaults.
  [[nodiscard]] std::string changes(const void* config, const void* defaults) const;

 private:
  std::vector<FieldEntry> entries_;
};

template <typename Member>
const MemberType& member_type() {
  const auto words = [] {
    std::string all;
    if constexpr (std::is_enum_v<Member>) {
      for (const auto& [word, meaning] : words_of<Member>()) {
        all += (all.empty() ? "" : ", ") + std::string(word);
      }
    }
    return all;
  };
  static const MemberType type{
      .to_python = [](const void* member,
                      double scale) { return python::to_python(*static_cast<const Member*>(member), scale); },
      .set =
          [](py::handle value, const std::string& name, double scale, const Field& field, void* member) {
            Member found = *static_cast<Member*>(member);
            from_python(value, name, scale, found);
            detail::check_member("", field, found);
            *static_cast<Member*>(member) = std::move(found);
          },
      .restore = [](py::handle value, const std::string& name,
                    void* member) { from_python(value, name, 1, *static_cast<Member*>(member)); },
      .equal = [](const void* one, const void* other) -> bool {
        return *static_cast<const Member*>(one) == *static_cast<const Member*>(other);
      },
      .is_double = std::is_same_v<Member, double>,
      .words = words(),
      .python = field_type<Member>()};
  return type;
}

/// The table of a configuration's visit_fields.
template <typename Config>
const FieldTable& field_table() {
  static const FieldTable table = [] {
    const Config config{};
    std::vector<FieldEntry> entries;
    Config::visit_fields(config, [&]<typename Member>(const Field& field, const Member& member) {
      const auto* place = reinterpret_cast<const std::byte*>(&member);
      entries.push_back({field, static_cast<std::size_t>(place - reinterpret_cast<const std::byte*>(&config)),
                         &member_type<Member>()});
    });
    return FieldTable(std::move(entries));
  }();
  return table;
}

}  // namespace insonify::python
