// export_bag.cpp -- pings as messages of ROS 1 in a bag.

#include "io/bag/bag_writer.h"
#include "io/export/export_format.h"
#include "io/export/recorded_sequence.h"
#include "io/export/recorded_source.h"
#include "io/message/message_stream.h"

namespace insonify {

void export_bag(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  MessageStream messages(message_sources(recordings), with_start(options.messages, recordings), MessageForm::kRos1);
  BagWriter out(file);
  std::vector<std::vector<std::uint32_t>> connections(messages.sonar_count());  // In the bag, by sonar and channel.
  for (std::size_t sonar = 0; sonar < messages.sonar_count(); ++sonar) {
    for (const MessageChannel& channel : messages.sonar(sonar).channels()) {
      connections[sonar].push_back(out.add_connection(channel.topic, channel.type, channel.md5, channel.definition));
    }
  }
  for (RecordedSequence pings(recordings); !pings.done(); pings.advance()) {
    check_stop(options);
    std::vector<std::pair<std::uint32_t, std::vector<std::byte>>> encoded;
    const std::uint64_t time_ns =
        messages.encode(pings.sonar(), pings.ping(), [&](std::size_t channel, std::vector<std::byte> message) {
          encoded.emplace_back(connections[pings.sonar()][channel], std::move(message));
        });
    for (const auto& [connection, message] : encoded) {
      out.add(time_ns, connection, message);
    }
  }
  out.close();
  messages.warn_of_clipping(file, options.log);
}

}  // namespace insonify
