// message_stream.h -- the messages of several sonars' pings, as a file holds them.

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

/// Messages of the sonars of a run, with topics that are told apart and each scenario's text once.
class MessageStream {
 public:
  /// @param sources  One a sonar.
  /// @throws Error for two sonars of the same name, and as SonarMessages().
  MessageStream(std::vector<MessageSource> sources, const MessageOptions& options, MessageForm form);

  [[nodiscard]] std::size_t sonar_count() const { return sonars_.size(); }
  /// What the messages tell of a sonar, with the name of its topics.
  [[nodiscard]] const MessageSource& source(std::size_t sonar) const { return sources_[sonar]; }
  [[nodiscard]] const SonarMessages& sonar(std::size_t sonar) const { return sonars_[sonar]; }

  /// Calls visit(channel, message) with each message about a ping that a file holds: SonarMessages::is_due(). `channel`
  /// counts those of the sonar.
  /// @return  The time of all of them [ns].
  /// @throws Error as SonarMessages::take().
  std::uint64_t tell(std::size_t sonar, const Ping& ping,
                     const std::function<void(std::size_t channel, std::vector<std::byte> message)>& visit);

  /// Warns of values that were cut, a line a sonar: SonarMessages::cut_text().
  void tell_cuts(const std::filesystem::path& file, const Log& log) const;

 private:
  std::vector<MessageSource> sources_;
  std::vector<SonarMessages> sonars_;
  std::set<std::string> told_scenarios_;
};

}  // namespace insonify
