// name_patterns.cpp -- compares scoped names with patterns.

#include "io/file/name_patterns.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>

#include "base/log_line.h"
#include "insonify/printable.h"

namespace insonify {

bool NamePatterns::match(const std::string& name) {
  const std::size_t colons = name.rfind("::");
  const std::string last = colons == std::string::npos ? name : name.substr(colons + 2);
  bool found = false;
  for (std::size_t i = 0; i < patterns_.size(); ++i) {
    const char* pattern = patterns_[i].c_str();
    if (fnmatch(pattern, name.c_str(), FNM_NOESCAPE) == 0 || fnmatch(pattern, last.c_str(), FNM_NOESCAPE) == 0) {
      used_[i] = true;
      found = true;
    }
  }
  return found;
}

bool NamePatterns::any() const {
  return std::ranges::count(used_, true) > 0;
}

void NamePatterns::report_unused(const std::string& file, const Log& log) const {
  for (std::size_t i = 0; i < patterns_.size(); ++i) {
    if (!used_[i]) {
      log_line(log, Severity::kWarning,
               fmt::format("{}: ignore: '{}' is the name of nothing in the world", file, printable(patterns_[i])));
    }
  }
}

}  // namespace insonify
