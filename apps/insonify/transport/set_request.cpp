// set_request.cpp -- splits a message into settings and formats the loop's reply.

#include "transport/set_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "console/console.h"

namespace insonify {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0) {
      lines.emplace_back(text.substr(0, end));
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace

void request_settings(LiveLoop& loop, const std::string& text, std::function<void(const std::string&)> answer) {
  std::vector<std::string> settings = lines_of(text);
  if (settings.empty()) {
    answer("refused: a message holds settings, one a line, such as max_range=20");
    return;
  }
  loop.set(std::move(settings), [answer = std::move(answer), text](const std::string& error) {
    if (!error.empty()) {
      complain(error);
    }
    answer(error.empty() ? fmt::format("done: {}", text) : fmt::format("refused: {}", error));
  });
}

}  // namespace insonify
