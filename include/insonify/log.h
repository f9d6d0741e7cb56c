// log.h -- callback by which the library reports information and warnings; it never prints by itself.

#pragma once

#include <functional>
#include <string>

namespace insonify {

enum class Severity { kInfo, kWarning };

/// Receives each message as one line that is safe to show on a terminal. May be empty: then messages are dropped.
using Log = std::function<void(Severity, const std::string&)>;

}  // namespace insonify
