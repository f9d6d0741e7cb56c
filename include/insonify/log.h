// log.h -- how the library tells its caller what it noticed; it never prints by itself.

#pragma once

#include <functional>
#include <string>

namespace insonify {

enum class Severity { kInfo, kWarning };

/// Receives each message as one line without a line break. May be empty: then nothing is told.
using Log = std::function<void(Severity, const std::string&)>;

}  // namespace insonify
