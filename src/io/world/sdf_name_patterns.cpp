// sdf_name_patterns.cpp -- compares scoped names with patterns.

#include "io/world/sdf_name_patterns.h"

#include <fnmatch.h>

#include <algorithm>

namespace insonify {

bool SdfNamePatterns::match(const std::string& name) {
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

bool SdfNamePatterns::any() const {
  return std::ranges::count(used_, true) > 0;
}

std::vector<std::string> SdfNamePatterns::unused() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < patterns_.size(); ++i) {
    if (!used_[i]) {
      names.push_back(patterns_[i]);
    }
  }
  return names;
}

}  // namespace insonify
