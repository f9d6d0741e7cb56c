// budgets.cpp -- reads INSONIFY_LIMITS.

#include "io/file/budgets.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr const char* kSetting = "INSONIFY_LIMITS";
constexpr double kMostMemory = 16e9;  // Or half of the machine's, if that is less [bytes].

struct Entry {
  std::string_view key;
  double value;
};

// In the order of Budget.
constexpr std::array<Entry, 7> kDefaults = {{{"bytes", 4e9},
                                             {"pixels", 1e8},
                                             {"nodes", 2e6},
                                             {"instances", 1e5},
                                             {"triangles", 5e7},
                                             {"memory", kMostMemory},
                                             {"seconds", 60}}};

double default_of(Budget which) {
  const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const double value = kDefaults.at(static_cast<std::size_t>(which)).value;
  return which == Budget::kMemory ? std::min(value, machine / 2) : value;
}

// The number in "KEY=NUMBER" for a key; NaN for another key.
// @throws Error for a word of another form.
double number_in(const std::string& word, std::string_view key) {
  const std::size_t equals = std::min(word.find('='), word.size());
  const bool known =
      std::ranges::any_of(kDefaults, [&](const Entry& entry) { return word.substr(0, equals) == entry.key; });
  char* end = nullptr;
  const double number = equals < word.size() ? std::strtod(&word[equals + 1], &end) : 0;
  if (!known || end == nullptr || *end != '\0' || !(number >= 1 && number <= 1e18)) {
    throw Error(
        fmt::format("{}: {} must be KEY=NUMBER, with a number from 1 to 1e18 and a key of bytes, pixels, nodes, "
                    "instances, triangles, memory, seconds",
                    kSetting, printable(word)));
  }
  return word.substr(0, equals) == key ? number : std::nan("");
}

std::string text_of(double count) {
  return count < 1e15 ? fmt::format("{:.0f}", std::ceil(count)) : fmt::format("{:.3g}", count);
}

}  // namespace

double budget(Budget which) {
  double value = default_of(which);
  const char* setting = std::getenv(kSetting);
  std::istringstream words(setting == nullptr ? "" : setting);
  for (std::string word; words >> word;) {
    const double number = number_in(word, kDefaults.at(static_cast<std::size_t>(which)).key);
    value = std::isnan(number) ? value : number;
  }
  return value;
}

void check_budget(Budget which, double count, std::string_view path) {
  const double most = budget(which);
  if (count > most) {
    const std::string_view key = kDefaults.at(static_cast<std::size_t>(which)).key;
    throw Error(fmt::format("{}: has {} {}, more than {}; for a file that you trust: {}={}={}", path, text_of(count),
                            key, text_of(most), kSetting, key, text_of(count)));
  }
}

}  // namespace insonify
