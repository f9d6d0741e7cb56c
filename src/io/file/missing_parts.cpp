// missing_parts.cpp -- one line about all missing parts of a world.

#include "io/file/missing_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/log_line.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// Most bytes of the parts in one message, and of a command: a message ends at kLongestMessage.
constexpr std::size_t kListSpace = 1000, kCommandSpace = 1500;

// The first parts that fit into `space` bytes, at least one, and the number of the others.
std::string listed(const std::vector<std::string>& parts, std::size_t space) {
  std::string text = parts.front();
  std::size_t shown = 1;
  while (shown < parts.size() && text.size() + parts[shown].size() <= space) {
    text += ", " + parts[shown++];
  }
  return parts.size() == shown ? text : fmt::format("{} and {} more", text, parts.size() - shown);
}

// In single quotes for the shell, as Fuel's names have spaces; a quote itself as '\''.
std::string for_shell(const std::string& uri) {
  std::string text = "'";
  for (const char c : printable(uri, kCommandSpace)) {
    text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return text + "'";
}

}  // namespace

void MissingParts::add(const std::string& what, const std::string& reason) {
  auto known = std::ranges::find(reasons_, reason, &Reason::text);
  if (known == reasons_.end()) {
    known = reasons_.insert(known, Reason{reason, {}});
  }
  if (std::ranges::find(known->parts, what) == known->parts.end()) {
    known->parts.push_back(what);
  }
}

void MissingParts::add(const UnreadablePart& unreadable) {
  add(unreadable.part, unreadable.reason);
  if (!unreadable.fuel_uri.empty() && std::ranges::find(fuel_uris_, unreadable.fuel_uri) == fuel_uris_.end()) {
    fuel_uris_.push_back(unreadable.fuel_uri);
  }
}

std::string MissingParts::text() const {
  std::vector<std::string> texts;
  for (const Reason& reason : reasons_) {
    texts.push_back(listed(reason.parts, kListSpace / reasons_.size()) + reason.text);
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string MissingParts::whole_text() const {
  return text() + (fuel_uris_.empty() ? "" : "; to fetch from Fuel: " + commands().front());
}

std::vector<std::string> MissingParts::commands() const {
  std::vector<std::string> lists;
  for (const std::string& uri : fuel_uris_) {
    const std::string word = " " + for_shell(uri);
    if (lists.empty() || lists.back().size() + word.size() > kCommandSpace) {
      lists.emplace_back();
    }
    lists.back() += word;
  }
  for (std::string& list : lists) {
    list = fmt::format("for u in{}; do gz fuel download -u \"$u\"; done", list);
  }
  return lists;
}

void MissingParts::report(const std::string& file, bool strict, const Log& log) const {
  if (empty()) {
    return;
  }
  if (strict) {
    throw Error(whole_text());
  }
  std::size_t count = 0;
  for (const Reason& reason : reasons_) {
    count += reason.parts.size();
  }
  log_line(log, Severity::kWarning,
           fmt::format("{}: {} part{} of the world {} skipped (an error with strict: true): {}", file, count,
                       count == 1 ? "" : "s", count == 1 ? "is" : "are", text()));
  for (const std::string& command : commands()) {
    log_line(log, Severity::kWarning, fmt::format("{}: to download missing Fuel models: {}", file, command));
  }
}

}  // namespace insonify
