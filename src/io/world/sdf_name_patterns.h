// sdf_name_patterns.h -- patterns of the names of what to leave out of a world.

#pragma once

#include <string>
#include <vector>

namespace insonify {

/// Patterns as of file names in a shell: `*` any text, `?` one character, `[ab]` one of these.
class SdfNamePatterns {
 public:
  explicit SdfNamePatterns(std::vector<std::string> patterns)
      : patterns_(std::move(patterns)), used_(patterns_.size(), false) {}

  /// Whether a pattern stands for a scoped name, "ship::hull::plate", or for its last part.
  [[nodiscard]] bool match(const std::string& name);

  /// Whether any name has matched.
  [[nodiscard]] bool any() const;

  /// Patterns that no name has matched.
  [[nodiscard]] std::vector<std::string> unused() const;

 private:
  std::vector<std::string> patterns_;
  std::vector<bool> used_;
};

}  // namespace insonify
