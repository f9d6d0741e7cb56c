// message_stream.h -- the messages in a file, for the pings of several sonars.

#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "insonify/messages.h"

namespace insonify {

/// Messages of the sonars of a run, with unique topics and each scenario's text once.
class MessageStream {
 public:
  /// @param sources  One per sonar.
  /// @throws Error for two sonars of the same name, and as SonarMessages().
  MessageStream(std::vector<MessageSource> sources, const MessageOptions& options, MessageForm form);

  [[nodiscard]] std::size_t sonar_count() const { return sonars_.size(); }
  /// Information about a sonar in its messages, with the name of its topics.
  [[nodiscard]] const MessageSource& source(std::size_t sonar) const { return sources_[sonar]; }
  [[nodiscard]] const SonarMessages& sonar(std::size_t sonar) const { return sonars_[sonar]; }

  /// Encodes a ping: calls visit(channel, message) for each message that a file holds, see SonarMessages::is_due().
  /// `channel` is an index among the sonar's channels.
  /// @return  The time of these messages [ns].
  /// @throws Error as SonarMessages::take().
  std::uint64_t encode(std::size_t sonar, const Ping& ping,
                       const std::function<void(std::size_t channel, std::vector<std::byte> message)>& visit);

  /// Warns of clipped values, one line per sonar: SonarMessages::cut_text().
  void warn_of_clipping(const std::filesystem::path& file, const Log& log) const;

 private:
  std::vector<MessageSource> sources_;
  std::vector<SonarMessages> sonars_;
  std::set<std::string> sent_scenarios_;
};

}  // namespace insonify
