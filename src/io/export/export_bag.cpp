// export_bag.cpp -- pings as messages of ROS 1 in a bag.

#include <fmt/format.h>

#include <set>

#include "insonify/messages.h"
#include "io/bag/bag_writer.h"
#include "io/export/export_format.h"
#include "io/export/recorded_sequence.h"
#include "io/export/recorded_source.h"

namespace insonify {

void export_bag(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  BagWriter out(file);
  std::vector<SonarMessages> messages;
  std::vector<std::vector<std::uint32_t>> connections;  // Of each sonar's channels.
  std::vector<std::string> scenarios;                   // One a sonar ...
  std::set<std::string> told;                           // ... and those that the bag has.
  std::vector<MessageSource> sources = message_sources(recordings);
  name_topics(sources);
  for (MessageSource& source : sources) {
    scenarios.push_back(source.scenario);
    messages.emplace_back(std::move(source), options.messages, MessageForm::kRos1);
    std::vector<std::uint32_t>& of_sonar = connections.emplace_back();
    for (const MessageChannel& channel : messages.back().channels()) {
      of_sonar.push_back(out.add_connection(channel.topic, channel.type, channel.md5, channel.definition));
    }
  }
  for (RecordedSequence pings(recordings); !pings.done(); pings.advance()) {
    check_stop(options);
    SonarMessages& of_sonar = messages[pings.sonar()];
    of_sonar.take(pings.ping());
    for (std::size_t i = 0; i < of_sonar.channels().size(); ++i) {
      if (of_sonar.channels()[i].kind != MessageKind::kScenario || told.insert(scenarios[pings.sonar()]).second) {
        out.add(of_sonar.time_ns(), connections[pings.sonar()][i], of_sonar.encode(i));
      }
    }
  }
  out.close();
  for (const SonarMessages& of_sonar : messages) {
    if (const std::string text = of_sonar.cut_text(); !text.empty() && options.log) {
      options.log(Severity::kWarning, fmt::format("{}: {}", file.string(), text));
    }
  }
}

}  // namespace insonify
