// settings_table.h -- the fields and parts of any configuration struct as one table, read in ordinary loops.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "insonify/field.h"
#include "insonify/geometry.h"
#include "insonify/words.h"

namespace insonify {

/// The words of an enumeration, and how a member holds one of them.
struct WordList {
  std::vector<std::string_view> words;
  std::size_t (*get)(const void* member);  ///< Index of its word; the number of words for a value without one.
  void (*set)(void* member, std::size_t index);
};

/// The value of a member that is an enumeration.
struct EnumWord {
  const WordList* list;
  std::size_t index;

  [[nodiscard]] std::string_view text() const { return index < list->words.size() ? list->words[index] : ""; }
  [[nodiscard]] bool operator==(const EnumWord&) const = default;
};

/// The types that members have; null pointers, which stand for their types.
using MemberType =
    std::variant<bool*, int*, std::uint64_t*, double*, std::string*, std::filesystem::path*, Vec3*, std::optional<int>*,
                 std::optional<double>*, std::vector<double>*, std::vector<int>*, std::vector<std::string>*, EnumWord*>;

/// One field of a configuration, and where the struct has it.
struct FieldEntry : Field {
  MemberType type;
  std::size_t offset;               ///< In the struct [bytes].
  const WordList* words = nullptr;  ///< The words of an enumeration; null for other types.

  [[nodiscard]] const void* in(const void* config) const { return static_cast<const std::byte*>(config) + offset; }
  [[nodiscard]] void* in(void* config) const { return static_cast<std::byte*>(config) + offset; }

  /// Returns visit(member), with `const Type&` for a Type of MemberType.
  template <typename Visit>
  auto get(const void* config, Visit&& visit) const {
    const void* place = in(config);
    return std::visit(
        [&]<typename Member>(Member*) {
          if constexpr (std::is_same_v<Member, EnumWord>) {
            return visit(EnumWord{words, words->get(place)});
          } else {
            return visit(*static_cast<const Member*>(place));
          }
        },
        type);
  }

  /// Calls visit(member) with a `Type&`, which it may change.
  template <typename Visit>
  void change(void* config, Visit&& visit) const {
    void* place = in(config);
    std::visit(
        [&]<typename Member>(Member*) {
          if constexpr (std::is_same_v<Member, EnumWord>) {
            EnumWord word{words, words->get(place)};
            visit(word);
            words->set(place, word.index);
          } else {
            visit(*static_cast<Member*>(place));
          }
        },
        type);
  }

  /// Whether two configurations have the same value.
  [[nodiscard]] bool equal(const void* config, const void* other) const;
  /// Gives a configuration the value of another.
  void copy(const void* from, void* to) const;
};

struct SettingsTable;
struct Settings;

/// The table of a configuration, made at its first use from its visit_fields and visit_parts.
template <typename Config>
const SettingsTable& table_of();

/// A configuration of any type, to read.
struct ConstSettings {
  const SettingsTable* table;
  const void* config;

  ConstSettings(const SettingsTable& its_table, const void* its_config) : table(&its_table), config(its_config) {}
  template <typename Config>
  requires(!std::is_same_v<Config, Settings> && !std::is_same_v<Config, ConstSettings>) ConstSettings(const Config& any)
      : table(&table_of<Config>()), config(&any) {}  // NOLINT: any configuration is one.
};

/// A configuration of any type, to change.
struct Settings {
  const SettingsTable* table;
  void* config;

  Settings(const SettingsTable& its_table, void* its_config) : table(&its_table), config(its_config) {}
  template <typename Config>
  requires(!std::is_same_v<Config, Settings> && !std::is_const_v<Config>) Settings(Config& any)
      : table(&table_of<Config>()), config(&any) {}            // NOLINT: as above.
  operator ConstSettings() const { return {*table, config}; }  // NOLINT: what can be changed can be read.
};

/// What a part is.
enum class PartShape { kStruct, kOptional, kList, kMap };

/// One part of a configuration: a struct, an optional one, a list or a map of structs.
struct PartEntry : Part {
  PartShape shape;
  const SettingsTable* table;  ///< The table of each of its structs.
  std::size_t offset;          ///< In the configuration [bytes].

  /// One of its structs; `suffix` follows the name of the part: "", "[0]", ".hull".
  struct Entry {
    std::string suffix;
    ConstSettings settings;
  };
  [[nodiscard]] std::vector<Entry> entries(const void* config) const;

  /// Empties an optional, a list or a map.
  void clear(void* config) const { clear_at(static_cast<std::byte*>(config) + offset); }
  /// The struct; that of the optional, which is made where it is absent; a new one of the list; that of the map's key.
  [[nodiscard]] Settings add(void* config, const std::string& key = {}) const {
    return {*table, add_at(static_cast<std::byte*>(config) + offset, key)};
  }

  using Named = std::pair<std::string, const void*>;
  std::vector<Named> (*list_at)(const void* part);  ///< Suffixes and places of its structs.
  void (*clear_at)(void* part);
  void* (*add_at)(void* part, const std::string& key);
};

struct SettingsTable {
  std::vector<FieldEntry> fields;
  std::vector<PartEntry> parts;
  const void* defaults;  ///< A configuration with the defaults.
};

/// Checks all members that are numbers, optional numbers or lists of numbers, in order, then those of its parts; words
/// are not checked.
void check_fields(std::string_view object, ConstSettings settings);

/// Checks one member. Words and texts have no limits.
template <typename Member>
void check_member(std::string_view object, const Field& field, const Member& member) {
  if constexpr (std::is_same_v<Member, bool>) {
    return;
  } else if constexpr (std::is_arithmetic_v<Member>) {
    check_field(object, field, static_cast<double>(member));
  } else if constexpr (requires { member.has_value(); }) {
    if (member.has_value()) {
      check_member(object, field, *member);
    }
  } else if constexpr (requires { requires std::is_arithmetic_v<std::remove_cvref_t<decltype(*member.begin())>>; } &&
                       !std::is_same_v<Member, std::string>) {
    int index = 0;
    for (const auto value : member) {
      check_field(object, field, static_cast<double>(value), index++);
    }
  }
}

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

template <typename Enum>
const WordList* word_list() {
  static const WordList kList = [] {
    WordList made{
        {},
        [](const void* member) {
          const std::string_view word = word_of(*static_cast<const Enum*>(member));
          std::size_t index = 0;
          while (index < words_of<Enum>().size() && words_of<Enum>()[index].first != word) {
            ++index;
          }
          return index;
        },
        [](void* member, std::size_t index) { *static_cast<Enum*>(member) = words_of<Enum>()[index].second; }};
    for (const auto& [word, meaning] : words_of<Enum>()) {
      made.words.push_back(word);
    }
    return made;
  }();
  return &kList;
}

template <typename Member>
FieldEntry field_entry(const Field& field, const Member& /*member*/, std::size_t offset) {
  if constexpr (std::is_enum_v<Member>) {
    return {field, static_cast<EnumWord*>(nullptr), offset, word_list<Member>()};
  } else {
    return {field, static_cast<Member*>(nullptr), offset};
  }
}

template <typename Member>
PartEntry part_entry(const Part& part, const Member& /*member*/, std::size_t offset) {
  using Named = PartEntry::Named;
  if constexpr (requires(Member m) { m.has_value(); }) {
    return {part,
            PartShape::kOptional,
            &table_of<typename Member::value_type>(),
            offset,
            [](const void* at) {
              const auto& optional = *static_cast<const Member*>(at);
              return optional ? std::vector<Named>{{"", &*optional}} : std::vector<Named>();
            },
            [](void* at) { static_cast<Member*>(at)->reset(); },
            [](void* at, const std::string&) -> void* {
              auto& optional = *static_cast<Member*>(at);
              return optional ? &*optional : &optional.emplace();
            }};
  } else if constexpr (requires { typename Member::mapped_type; }) {
    return {part,
            PartShape::kMap,
            &table_of<typename Member::mapped_type>(),
            offset,
            [](const void* at) {
              std::vector<Named> named;
              for (const auto& [key, entry] : *static_cast<const Member*>(at)) {
                named.emplace_back("." + key, &entry);
              }
              return named;
            },
            [](void* at) { static_cast<Member*>(at)->clear(); },
            [](void* at, const std::string& key) -> void* { return &(*static_cast<Member*>(at))[key]; }};
  } else if constexpr (requires { typename Member::value_type; }) {
    return {part,
            PartShape::kList,
            &table_of<typename Member::value_type>(),
            offset,
            [](const void* at) {
              std::vector<Named> named;
              for (const auto& entry : *static_cast<const Member*>(at)) {
                named.emplace_back(std::string("[").append(std::to_string(named.size())).append("]"), &entry);
              }
              return named;
            },
            [](void* at) { static_cast<Member*>(at)->clear(); },
            [](void* at, const std::string&) -> void* { return &static_cast<Member*>(at)->emplace_back(); }};
  } else {
    return {part,
            PartShape::kStruct,
            &table_of<Member>(),
            offset,
            [](const void* at) {
              return std::vector<Named>{{"", at}};
            },
            [](void*) {},
            [](void* at, const std::string&) { return at; }};
  }
}

}  // namespace detail

template <typename Config>
const SettingsTable& table_of() {
  static const Config kDefaults{};
  static const SettingsTable kTable = [] {
    SettingsTable made{.fields = {}, .parts = {}, .defaults = &kDefaults};
    const auto offset_of = [](const auto& member) {
      return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&member) -
                                      reinterpret_cast<const std::byte*>(&kDefaults));
    };
    Config::visit_fields(kDefaults, [&](const Field& field, const auto& member) {
      made.fields.push_back(detail::field_entry(field, member, offset_of(member)));
    });
    if constexpr (HasParts<Config>) {
      Config::visit_parts(kDefaults, [&](const Part& part, const auto& member) {
        made.parts.push_back(detail::part_entry(part, member, offset_of(member)));
      });
    }
    return made;
  }();
  return kTable;
}

}  // namespace insonify
