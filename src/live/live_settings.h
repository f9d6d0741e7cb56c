// live_settings.h -- the text of a scenario and the changes made to it so far.

#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "insonify/scenario.h"

namespace insonify {

/// A scenario file as read once, the settings applied to it and the materials given to objects. A value: a change that
/// turns out to be wrong is undone by dropping the copy it was made in.
struct LiveSettings {
  std::string text;
  std::filesystem::path path;
  std::vector<std::string> settings = {};             ///< "key=value", in order.
  std::map<std::string, std::string> materials = {};  ///< By the full name of the object.
  bool followed = false;                              ///< LiveOptions::followed.

  /// Adds settings; each takes the place of an earlier one of the same key. With a change of the model, those of before
  /// become part of the text: there, unlike in a setting, a key may have no effect in the model.
  void add(std::span<const std::string> changes);

  /// @throws Error as load_scenario().
  [[nodiscard]] Scenario scenario(const Log& log) const;
};

/// Whether two scenarios differ in nothing but the settings of sonars, with the same names: what
/// Simulator::set_sonar() can change.
[[nodiscard]] bool differ_in_sonars_only(const Scenario& a, const Scenario& b);

}  // namespace insonify
