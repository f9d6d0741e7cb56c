// error.h -- the library's only exception type, with the place of its cause in a file.

#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace insonify {

/// A place in a file, or a setting of the command line.
struct Place {
  std::string file = {};     ///< As the user named it; "--set pings=3" for a setting; "" for no place.
  int line = 0, column = 0;  ///< From 1; 0 where unknown.

  /// Prefix of messages: "scene.yaml:3:5: ", "ship.sdf:12: ", "--set pings=3: "; "" for no place.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] bool operator==(const Place&) const = default;
};

/// Places of settings, by the names that messages use: "sonars[0].max_range", "materials.hull".
using Places = std::map<std::string, Place>;

/// Thrown for invalid input: a file, a configuration, a caller's value.
///
/// The message is one line with place, name, value and allowed values: "scene.yaml:3:5: sonars[0].max_range = 2 m must
/// be greater than min_range = 5 m". It is safe to show on a terminal, whatever it quotes (printable.h). Bugs in the
/// library are assert()s, never exceptions.
class Error : public std::runtime_error {
 public:
  /// An error without a setting.
  explicit Error(const std::string& message);

  /// An invalid setting. The message is its name followed by `rest`, such as " = 2 m must be
  /// ...".
  /// @param object   Owner of the setting: "sonars[0]", "water"; "" for the scenario itself.
  /// @param field    Its name as users write it: "max_range", "position[2]"; "" for the object as a whole.
  /// @param related  Other settings that the message depends on, by their full names, the most relevant first.
  Error(std::string_view object, std::string_view field, std::string_view rest, std::vector<std::string> related = {});

  [[nodiscard]] const std::string& object() const { return about_->object; }  ///< "" without a setting.
  [[nodiscard]] const std::string& field() const { return about_->field; }    ///< "" without a setting.
  [[nodiscard]] const std::vector<std::string>& related() const { return about_->related; }
  [[nodiscard]] const Place& place() const { return about_->place; }  ///< Its file is "" if unknown.

  /// The same error with a place at the start of its message. An error that has a place keeps it.
  [[nodiscard]] Error at(const Place& place) const;

  /// The same error with the place of its setting; if that is not listed, being a default, of a related one; else of
  /// the nearest enclosing object, and last that of "", the whole file. An error without a setting or with a place is
  /// unchanged.
  [[nodiscard]] Error located(const Places& places) const;

 private:
  struct About {  // Shared by copies, which must not throw.
    std::string object, field;
    std::vector<std::string> related;
    Place place;
  };
  Error(const std::string& message, About about);

  std::shared_ptr<const About> about_;
};

/// "sonars[0]" and "max_range" give "sonars[0].max_range"; either may be "".
[[nodiscard]] std::string member_name(std::string_view object, std::string_view key);

}  // namespace insonify
