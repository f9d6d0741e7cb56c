// dds_transport.h -- writes the messages of pings to ROS 2 topics.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dds/raw_type.h"
#include "transport/bridge.h"

namespace insonify {

class DdsTransport : public Transport {
 public:
  /// @param participant  Must live as long as the transport.
  /// @param lossless     Whether sending waits for slow reliable readers.
  DdsTransport(dds_entity_t participant, bool best_effort, bool lossless)
      : participant_(participant), best_effort_(best_effort), lossless_(lossless) {}

  void open(std::size_t sonar, const std::vector<MessageChannel>& channels) override;
  [[nodiscard]] bool is_read(std::size_t sonar, std::size_t channel) const override;
  /// @throws Error if a reliable reader could not keep up.
  void send(std::size_t sonar, std::size_t channel, std::uint64_t time_ns,
            const std::vector<std::byte>& message) override;

  /// Waits a moment for reliable readers to receive the last messages.
  void finish();

 private:
  struct Writer {
    std::string name;
    RawTopic topic;
    DdsEntity writer;
  };

  const Writer& writer(std::size_t sonar, std::size_t channel) const { return *channels_.at(sonar).at(channel); }

  dds_entity_t participant_;
  bool best_effort_, lossless_;
  SendPace pace_;
  std::map<std::string, Writer> writers_;             // By topic; kept when a sonar changes.
  std::vector<std::vector<const Writer*>> channels_;  // By sonar and channel.
};

}  // namespace insonify
