// error.h -- the one exception type that leaves the library.

#pragma once

#include <stdexcept>
#include <string>

namespace insonify {

/// Thrown when something that came from outside is wrong: a file, a configuration, a caller's value.
///
/// The message is one line that is safe to show on a terminal, whatever it quotes (printable.h). It names the object,
/// the value found and the values allowed, and for files `path:line:column:` first. A broken promise inside the library
/// is an assert(), never an exception.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message);
};

}  // namespace insonify
