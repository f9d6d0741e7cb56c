// message_stream.cpp -- encodes the channels of each ping.

#include "io/message/message_stream.h"

#include <fmt/format.h>

#include <utility>

namespace insonify {

MessageStream::MessageStream(std::vector<MessageSource> sources, const MessageOptions& options, MessageForm form)
    : sources_(std::move(sources)) {
  name_topics(sources_);
  for (const MessageSource& source : sources_) {
    sonars_.emplace_back(source, options, form);
  }
}

std::uint64_t MessageStream::encode(
    std::size_t sonar, const Ping& ping,
    const std::function<void(std::size_t channel, std::vector<std::byte> message)>& visit) {
  SonarMessages& messages = sonars_.at(sonar);
  messages.take(ping);
  for (std::size_t i = 0; i < messages.channels().size(); ++i) {
    const bool is_scenario = messages.channels()[i].kind == MessageKind::kScenario;
    if (!messages.is_due(i)) {
      continue;
    }
    if (!is_scenario || sent_scenarios_.insert(sources_[sonar].scenario).second) {
      visit(i, messages.encode(i));
    }
  }
  return messages.time_ns();
}

void MessageStream::warn_of_clipping(const std::filesystem::path& file, const Log& log) const {
  for (const SonarMessages& messages : sonars_) {
    if (const std::string text = messages.cut_text(); !text.empty() && log) {
      log(Severity::kWarning, fmt::format("{}: {}", file.string(), text));
    }
  }
}

}  // namespace insonify
