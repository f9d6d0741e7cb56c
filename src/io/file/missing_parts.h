// missing_parts.h -- missing or unreadable parts of a world: an error, or skipped with one warning.

#pragma once

#include <string>
#include <vector>

#include "insonify/log.h"

namespace insonify {

/// Collects the skipped parts of a world.
class MissingParts {
 public:
  /// @param what    "path:line:column: include 'model://ship'".
  /// @param reason  Follows `what`: " does not exist".
  void add(const std::string& what, const std::string& reason);

  /// As add(), for a model or a file of the Fuel server that is in none of its caches.
  void add_fuel(const std::string& what, const std::string& reason, const std::string& uri);

  [[nodiscard]] bool empty() const { return reasons_.empty(); }

  /// All parts in one line, grouped by reason; only the first of very many.
  [[nodiscard]] std::string text() const;

  /// The same with the first of commands(), for an Error.
  [[nodiscard]] std::string whole_text() const;

  /// Shell commands that download missing Fuel models: one, or several if it would be too long for a message.
  [[nodiscard]] std::vector<std::string> commands() const;

  /// Reports the parts, if any: as one warning, and one for each of commands(), or as an Error with
  /// `strict`.
  void report(const std::string& file, bool strict, const Log& log) const;

 private:
  struct Reason {
    std::string text;
    std::vector<std::string> parts;
  };
  std::vector<Reason> reasons_;
  std::vector<std::string> fuel_uris_;
};

}  // namespace insonify
