// message_stream.cpp -- names the topics of sonars, and encodes the channels of each ping.

#include "io/message/message_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/printable.h"
#include "io/message/ros_name.h"

namespace insonify {

MessageSource message_source(const Scenario& scenario, const SonarConfig& sonar) {
  MessageSource source{sonar,
                       scenario.model,
                       scenario.receiver_of(sonar),
                       scenario.text.empty() ? to_yaml(scenario) : scenario.text,
                       {}};
  if (!source.sonar.assumed_sound_speed) {
    source.sonar.assumed_sound_speed = scenario.water_at(sonar).true_sound_speed();
  }
  source.absorption = scenario.water_at(sonar).absorption_db_per_m_at(sonar.frequency);
  std::vector<std::string> names;
  for (const SonarConfig& other : scenario.sonars) {
    names.push_back(other.name);
  }
  if (const auto own = std::ranges::find(names, sonar.name); own != names.end()) {
    source.name = ros_names(names)[static_cast<std::size_t>(own - names.begin())];
  }
  return source;
}

void name_topics(std::vector<MessageSource>& sources) {
  std::vector<std::string> names;
  std::set<std::string> sonars;
  for (const MessageSource& source : sources) {
    if (!sonars.insert(source.sonar.name).second) {
      throw Error(fmt::format("there are two sonars called {}; their names must differ", printable(source.sonar.name)));
    }
    names.push_back(source.name.empty() ? source.sonar.name : source.name);
  }
  names = ros_names(names);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    sources[i].name = names[i];
  }
}

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
