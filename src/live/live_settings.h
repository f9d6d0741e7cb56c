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

/// The text of a scenario file, the settings applied to it and the materials assigned to objects. A value type: a
/// failed change is undone by discarding the copy.
struct LiveSettings {
  std::string text;
  std::filesystem::path path;
  std::vector<std::string> settings = {};             ///< "key=value", in order.
  std::map<std::string, std::string> materials = {};  ///< By the full name of the object.
  bool followed = false;                              ///< LiveOptions::followed.

  /// Adds settings; each replaces an earlier one of the same key. When the model changes, earlier settings become part
  /// of the text: there, unlike in a setting, a key may have no effect in the model.
  void add(std::span<const std::string> changes);

  /// @throws Error as load_scenario().
  [[nodiscard]] Scenario scenario(const Log& log) const;
};

/// Whether two scenarios differ only in what Simulator::set_sonar() can change: settings of sonars of the same
/// names.
[[nodiscard]] bool differ_in_sonars_only(const Scenario& a, const Scenario& b);

}  // namespace insonify
