// canonical_name.cpp -- maps spellings of a name that mean the same to one spelling.

#include "base/canonical_name.h"

#include <cctype>

namespace insonify {

std::string canonical_name(std::string_view name) {
  std::string canonical(name);
  for (char& letter : canonical) {
    const bool gap = letter == '-' || letter == ' ';
    letter = gap ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return canonical;
}

}  // namespace insonify
