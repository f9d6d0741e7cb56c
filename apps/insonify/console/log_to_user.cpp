// log_to_user.cpp -- warnings go to the standard error stream, all else to the standard output.

#include "console/log_to_user.h"

#include <string>

#include "console/console.h"

namespace insonify {

Log log_to_user(bool quiet) {
  return [quiet](Severity severity, const std::string& message) {
    if (severity == Severity::kWarning) {
      complain("warning: " + message);
    } else if (!quiet) {
      say("{}\n", message);
    }
  };
}

}  // namespace insonify
