// names.cpp -- spellings of a name that mean the same, and the least edit distance from a mistyped one.

#include "base/names.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace insonify {
namespace {

char lower(char letter) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

bool alike(char a, char b) {
  return lower(a) == lower(b);
}

// Optimal string alignment distance, by dynamic programming: row i of the table holds the distances of a's first i
// letters to every prefix of b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = last;
    last = row;
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = alike(a[i - 1], b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && alike(a[i - 1], b[j - 2]) && alike(a[i - 2], b[j - 1])) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), lower);
  return result;
}

std::string canonical_name(std::string_view name) {
  std::string canonical = lower_case(name);
  std::ranges::replace(canonical, '-', '_');
  std::ranges::replace(canonical, ' ', '_');
  return canonical;
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  // At most 2 slips, or a third of the letters of a long name; fewer than half of the letters of a short one.
  const std::size_t most_slips =
      std::min(std::max<std::size_t>(2, name.size() / 3), (name.size() - (name.empty() ? 0 : 1)) / 2);
  const auto slips = [&](const std::string& candidate) {
    // The difference in length is a lower bound, which spares the table of a name of megabytes.
    const std::size_t at_least = std::max(name.size(), candidate.size()) - std::min(name.size(), candidate.size());
    return at_least > most_slips ? at_least : edit_distance(name, candidate);
  };
  const auto nearest = std::ranges::min_element(candidates, {}, slips);
  return nearest == candidates.end() || slips(*nearest) > most_slips ? "" : *nearest;
}

std::string suggestion(std::string_view name, std::span<const std::string> candidates) {
  const std::string nearest = nearest_name(name, candidates);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace insonify
