// export_bag.cpp -- pings as messages of ROS 1 in a bag.

#include "io/bag/bag_writer.h"
#include "io/export/export_format.h"
#include "io/message/message_stream.h"

namespace insonify {
namespace {

class BagRecording final : public PingSink {
 public:
  BagRecording(const std::filesystem::path& file, MessageStream messages, Log log)
      : file_(file), messages_(std::move(messages)), out_(file), log_(std::move(log)) {
    for (std::size_t sonar = 0; sonar < messages_.sonar_count(); ++sonar) {
      std::vector<std::uint32_t>& of_sonar = connections_.emplace_back();
      for (const MessageChannel& channel : messages_.sonar(sonar).channels()) {
        of_sonar.push_back(out_.add_connection(channel.topic, channel.type, channel.md5, channel.definition));
      }
    }
  }

  void add(std::size_t sonar, const Ping& ping) override {
    std::vector<std::pair<std::uint32_t, std::vector<std::byte>>> encoded;
    const std::uint64_t time_ns =
        messages_.encode(sonar, ping, [&](std::size_t channel, std::vector<std::byte> message) {
          encoded.emplace_back(connections_[sonar][channel], std::move(message));
        });
    for (const auto& [connection, message] : encoded) {
      out_.add(time_ns, connection, message);
    }
  }

  void close() override {
    out_.close();
    messages_.warn_of_clipping(file_, log_);
  }

  [[nodiscard]] const std::filesystem::path& place() const override { return file_; }

 private:
  std::filesystem::path file_;
  MessageStream messages_;
  BagWriter out_;
  Log log_;
  std::vector<std::vector<std::uint32_t>> connections_;  // In the bag, by sonar and channel.
};

}  // namespace

void export_bag(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  BagRecording bag(file, {message_sources(recordings), with_start(options.messages, recordings), MessageForm::kRos1},
                   options.log);
  write_pings(recordings, bag, options);
}

}  // namespace insonify
