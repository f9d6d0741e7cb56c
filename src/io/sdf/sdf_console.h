// sdf_console.h -- captures what libsdformat prints.

#pragma once

#include <memory>
#include <string>
#include <vector>

namespace insonify {

/// Captures what this thread writes to std::cerr during the life of this object.
///
/// libsdformat writes its warnings, the reason of many errors and all errors of included files to std::cerr and nowhere
/// else, and urdfdom, which it tries on files that it cannot read, adds lines of its own. Output of other threads is
/// not affected, but none may write while this object is created or destroyed.
class SdfConsole {
 public:
  SdfConsole();
  ~SdfConsole();
  SdfConsole(const SdfConsole&) = delete;
  SdfConsole& operator=(const SdfConsole&) = delete;

  /// The warnings and errors of libsdformat itself, in order, without repetitions and full stops.
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  class Buffer;
  std::unique_ptr<Buffer> buffer_;
};

}  // namespace insonify
