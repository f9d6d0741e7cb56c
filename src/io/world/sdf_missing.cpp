// sdf_missing.cpp -- one line about all missing parts of a world.

#include "io/world/sdf_missing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/log_line.h"
#include "insonify/error.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr std::size_t kMostListed = 20;  // Parts of one reason.

std::string listed(const std::vector<std::string>& parts) {
  const std::size_t shown = std::min(parts.size(), kMostListed);
  std::string text =
      fmt::format("{}", fmt::join(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return parts.size() == shown ? text : fmt::format("{} and {} more", text, parts.size() - shown);
}

// In single quotes for the shell, as Fuel's names have spaces; a quote itself as '\''.
std::string for_shell(const std::string& uri) {
  std::string text = "'";
  for (const char c : printable(uri)) {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

}  // namespace

void SdfMissing::add(const std::string& what, const std::string& reason) {
  auto known = std::ranges::find(reasons_, reason, &Reason::text);
  if (known == reasons_.end()) {
    known = reasons_.insert(known, Reason{reason, {}});
  }
  if (std::ranges::find(known->parts, what) == known->parts.end()) {
    known->parts.push_back(what);
  }
}

void SdfMissing::add_fuel(const std::string& what, const std::string& reason, const std::string& uri) {
  add(what, reason);
  if (std::ranges::find(fuel_uris_, uri) == fuel_uris_.end()) {
    fuel_uris_.push_back(uri);
  }
}

std::string SdfMissing::text() const {
  std::vector<std::string> texts;
  for (const Reason& reason : reasons_) {
    texts.push_back(listed(reason.parts) + reason.text);
  }
  std::string text = fmt::format("{}", fmt::join(texts, "; "));
  if (!fuel_uris_.empty()) {
    std::vector<std::string> words;
    std::ranges::transform(fuel_uris_, std::back_inserter(words), for_shell);
    text += fmt::format("; to fetch {}: for u in {}; do gz fuel download -u \"$u\"; done",
                        fuel_uris_.size() == 1 ? "it" : "them", fmt::join(words, " "));
  }
  return text;
}

void SdfMissing::report(const std::string& file, bool strict, const Log& log) const {
  if (empty()) {
    return;
  }
  if (strict) {
    throw Error(text());
  }
  std::size_t count = 0;
  for (const Reason& reason : reasons_) {
    count += reason.parts.size();
  }
  log_line(log, Severity::kWarning,
           fmt::format("{}: {} part{} of the world {} left out (an error with strict: true): {}", file, count,
                       count == 1 ? "" : "s", count == 1 ? "is" : "are", text()));
}

}  // namespace insonify
