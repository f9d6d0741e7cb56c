// bridge.cpp -- reports what a live sender does to the user, and passes settings to its loop.

#include "transport/bridge.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "console/console.h"
#include "console/outcome.h"

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

Bridge::Bridge(const BridgeOptions& options, Transport& transport, MessageForm form) : quiet_(options.quiet) {
  checked_input([&] {
    sender_ = std::make_unique<LiveSender>(
        options.scenario, options.settings,
        LiveSenderOptions{
            .live = options.live,
            .messages = options.messages,
            .form = form,
            .at_once = options.at_once,
            .lossless = options.lossless,
            .on_note = complain,
            .on_idle = [this] { when_idle_(); },
            .on_dropped = [this] { report_.note_drop(); },
            .on_sent = [this](auto transmitted, double computing) { report_.note(transmitted, computing); }},
        transport, log_to_user(options.quiet));
  });
}

void Bridge::start() {
  sender_->start();
  if (const std::string choice = loop().world()->engine_choice; !quiet_ && !choice.empty()) {
    say("{}\n", choice);
    flush_output();
  }
}

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
