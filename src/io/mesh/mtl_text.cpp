// mtl_text.cpp -- selects the lines of a material library.

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <string>

#include "base/names.h"
#include "io/mesh/mesh_checks.h"

namespace insonify {
namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view next_mtl_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(kBlanks));
  rest.remove_prefix(word.size());
  return word;
}

bool is_mtl_number(std::string_view word) {
  double ignored = 0;
  const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), ignored);
  return failure == std::errc() && end == word.data() + word.size();
}

// Numbers of values of options before a file's name. Of three, y and z may be missing.
const std::map<std::string_view, int> kMtlOptions = {
    {"-bm", 1},     {"-mm", 2},   {"-clamp", 1}, {"-blendu", 1}, {"-blendv", 1}, {"-cc", 1}, {"-imfchan", 1},
    {"-texres", 1}, {"-type", 1}, {"-boost", 1}, {"-o", 3},      {"-s", 3},      {"-t", 3}};

// "-bm 0.02 map.png": the height and the file; "" without a file.
std::string height_and_file(std::string_view rest) {
  std::string height;
  for (;;) {
    std::string_view after = rest;
    const auto option = kMtlOptions.find(next_mtl_word(after));
    if (option == kMtlOptions.end()) {
      break;
    }
    for (int i = 0; i < option->second; ++i) {
      std::string_view behind = after;
      const std::string_view value = next_mtl_word(behind);
      if (option->second == 3 && i > 0 && !is_mtl_number(value)) {
        break;
      }
      height = option->first == "-bm" && is_mtl_number(value) ? "-bm " + std::string(value) + " " : height;
      after = behind;
    }
    rest = after;
  }
  rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
  const std::string_view file = rest.substr(0, rest.find_last_not_of(kBlanks) + 1);
  return file.empty() ? "" : height + std::string(file);
}

}  // namespace

std::string mend_mtl(std::string_view text) {
  std::string mended = "# names and bumps\n";  // assimp refuses a library of less than 8 bytes.
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view key = next_mtl_word(rest);
    const std::string lower = lower_case(key);
    if (lower == "newmtl" && rest.find_first_not_of(kBlanks) != std::string_view::npos) {
      mended.append("newmtl").append(rest).append("\n");
    } else if (lower == "bump" || lower == "map_bump" || lower == "norm" || lower == "map_kn") {
      const std::string map = height_and_file(rest);
      mended += map.empty() ? "" : std::string(key) + " " + map + "\n";
    }
  }
  return mended;
}

}  // namespace insonify
