// sdf_console.h -- keeps libsdformat from printing, and what it would have printed.

#pragma once

#include <memory>
#include <string>
#include <vector>

namespace insonify {

/// While one of these lives, what this thread writes to std::cerr is kept instead of shown.
///
/// libsdformat tells its warnings, the reason of many errors and all errors of included files to std::cerr and nowhere
/// else, and urdfdom, which it asks about files that it cannot read, adds lines of its own. Other threads write as
/// ever, but none should at the very moment at which this begins or ends.
class SdfConsole {
 public:
  SdfConsole();
  ~SdfConsole();
  SdfConsole(const SdfConsole&) = delete;
  SdfConsole& operator=(const SdfConsole&) = delete;

  /// What libsdformat itself said, warnings and errors, in order, without repetitions and full stops.
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  class Buffer;
  std::unique_ptr<Buffer> buffer_;
};

}  // namespace insonify
