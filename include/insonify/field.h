// field.h -- name, unit, limits and help text of a configuration's fields, from which reader, checks and manual are
// made.

#pragma once

#include <concepts>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

namespace insonify {

/// The values a number may take. NaN is never allowed; infinity only where no limit is given.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_allowed = true;  ///< False: the value must be greater than `least`.
  bool most_allowed = true;   ///< False: the value must be less than `most`.

  [[nodiscard]] bool allow(double value) const;

  /// In words: "greater than 0", "at least 1", "from 7.7 to 8.3", "any finite number".
  /// `scale` multiplies the limits, for a field displayed in a unit other than its own.
  [[nodiscard]] std::string text(double scale = 1) const;
};

constexpr Limits any_number() {
  return {};
}
constexpr Limits at_least(double least) {
  return {.least = least};
}
constexpr Limits greater_than(double least) {
  return {.least = least, .least_allowed = false};
}
constexpr Limits from_to(double least, double most) {
  return {.least = least, .most = most};
}
constexpr Limits above_to(double least, double most) {
  return {.least = least, .most = most, .least_allowed = false};
}

/// Limits of a coordinate in the world [m]: wide enough for eastings and northings of any map, and small enough that
/// squares do not overflow.
constexpr Limits coordinate() {
  return from_to(-1e7, 1e7);
}
/// Limits of an angle that is not wrapped, such as a heading over many turns [rad]: +-1e6 degrees.
constexpr Limits turn() {
  return from_to(-1e6 * std::numbers::pi / 180, 1e6 * std::numbers::pi / 180);
}

/// Models of the echo in which a field has an effect.
enum class ActsIn { kEveryModel, kCalibrated, kPaper };

/// One field of a configuration, as file readers, command line and manual need it.
///
/// Every configuration struct has `template <class Self, class Visit> static void visit_fields(Self&, Visit&&)` that
/// calls `visit(Field, member)` on each member in order. table_of() makes a table of that list, from which the YAML
/// reader, `--set`, `insonify describe`, validate(), recordings and Python are made: a field added there appears
/// everywhere.
struct Field {
  std::string_view name;  ///< As in code. In files a field in "rad" is written in degrees, as `<name>_deg`.
  std::string_view unit;  ///< "m", "Hz", "rad", "s", "" (a count, a ratio or a word) ...
  Limits limits;          ///< Limits of a number, or of each element of a list; ignored for words.
  std::string_view help;  ///< One sentence, from a capital letter to a full stop.
  ActsIn acts = ActsIn::kEveryModel;
  std::string_view instead = {};  ///< Corresponding setting of the other model, for messages; may be "".
};

/// A member of a configuration that has fields of its own: a struct, an optional struct, a list or a map of structs.
///
/// A configuration with such members has, beside visit_fields, `visit_parts(Self&, Visit&&)`, which calls
/// `visit(Part, member)` on each. Reading, checking, describing, recording and writing follow the two lists, so that a
/// setting or a whole section is named once.
struct Part {
  std::string_view name;  ///< Key in files; often that of the member.
  std::string_view kind;  ///< What a file holds there: "map", "list of waypoints" ...
  std::string_view help;  ///< One sentence for the list of the configuration's keys.
  std::string_view
      about;  ///< One or two sentences above the list of the part's own keys; "" where another part has it.
};

/// Configurations that have parts.
template <typename Config>
concept HasParts = requires(const Config& config) {
  Config::visit_parts(config, [](const Part&, const auto&) {});
};

/// Name of the field as users write it: `azimuth_aperture_deg` for an angle, the plain name otherwise.
[[nodiscard]] std::string file_name_of(const Field& field);

/// Factor from the unit in code to the unit in files: 180/pi for an angle, else 1.
[[nodiscard]] double file_scale_of(const Field& field);

/// Unit as users read it: "deg" for an angle, else the field's own.
[[nodiscard]] std::string_view file_unit_of(const Field& field);

/// Checks one number.
/// @param object  What the field belongs to, as the user knows it: "sonars[0]", "water"; "" for the scenario itself.
/// @param index   Place in a list, negative for a single number.
/// @throws Error "sonars[0].max_range = -2 m must be greater than 0 m"
void check_field(std::string_view object, const Field& field, double value, int index = -1);

}  // namespace insonify
