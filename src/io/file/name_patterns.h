// name_patterns.h -- name patterns of the objects of a world to ignore.

#pragma once

#include <string>
#include <vector>

#include "insonify/log.h"

namespace insonify {

/// Patterns as for file names in a shell: `*` any text, `?` one character, `[ab]` one of these.
class NamePatterns {
 public:
  explicit NamePatterns(std::vector<std::string> patterns)
      : patterns_(std::move(patterns)), used_(patterns_.size(), false) {}

  /// Whether a pattern matches a scoped name, "ship::hull::plate", or its last part.
  [[nodiscard]] bool match(const std::string& name);

  /// Whether any name has matched.
  [[nodiscard]] bool any() const;

  /// Warns of each pattern that no name has matched.
  /// @param file  Name of the world in messages.
  void report_unused(const std::string& file, const Log& log) const;

 private:
  std::vector<std::string> patterns_;
  std::vector<bool> used_;
};

}  // namespace insonify
