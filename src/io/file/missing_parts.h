// missing_parts.h -- missing or unreadable parts of a world: an error, or skipped with one warning.

#pragma once

#include <string>
#include <vector>

#include "insonify/error.h"
#include "insonify/log.h"

namespace insonify {

/// A part of a world that cannot be read on this machine: a file that is missing or wrong, or a value that only a
/// launch file knows.
class UnreadablePart : public Error {
 public:
  /// @param the_part    "path:line:column: visual 'a::b': 'x.dae'"
  /// @param the_reason  The rest of the message: " does not exist".
  /// @param model_uri   URI of the Fuel model to download; "" for other files.
  UnreadablePart(const std::string& the_part, const std::string& the_reason, const std::string& model_uri = "")
      : Error(the_part + the_reason), part(the_part), reason(the_reason), fuel_uri(model_uri) {}
  std::string part, reason, fuel_uri;
};

/// Collects the skipped parts of a world.
class MissingParts {
 public:
  /// @param what    "path:line:column: include 'model://ship'".
  /// @param reason  Follows `what`: " does not exist".
  void add(const std::string& what, const std::string& reason);

  /// The same of a part; the model of a Fuel URI is one to download.
  void add(const UnreadablePart& unreadable);

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
