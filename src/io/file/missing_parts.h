// missing_parts.h -- parts of a world that are missing or unreadable: an error, or left out with one warning.

#pragma once

#include <string>
#include <vector>

#include "insonify/log.h"

namespace insonify {

/// Collects the parts of a world that had to be left out.
class MissingParts {
 public:
  /// @param what    "path:line:column: include 'model://ship'".
  /// @param reason  Follows `what`: " does not exist".
  void add(const std::string& what, const std::string& reason);

  /// As add(), for a model or a file of the Fuel server that none of its caches has.
  void add_fuel(const std::string& what, const std::string& reason, const std::string& uri);

  [[nodiscard]] bool empty() const { return reasons_.empty(); }

  /// All parts in one line, those with the same reason together; of very many the first.
  [[nodiscard]] std::string text() const;

  /// The same with the first of commands(), for an Error.
  [[nodiscard]] std::string whole_text() const;

  /// Commands for a shell that fetch what is missing of Fuel: one, or several where it would be too long for a message.
  [[nodiscard]] std::vector<std::string> commands() const;

  /// Reports the parts, if there are any: as one warning, and one for each of commands(), or as an Error where
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
