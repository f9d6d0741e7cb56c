// dds_road.h -- writes the messages of pings to the topics of ROS 2.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dds/raw_type.h"
#include "road/bridge.h"
#include "road/dds_options.h"

namespace insonify {

class DdsRoad : public Road {
 public:
  /// @param participant  Must live as long as the road.
  DdsRoad(dds_entity_t participant, bool best_effort) : participant_(participant), best_effort_(best_effort) {}

  void open(std::size_t sonar, const std::vector<MessageChannel>& channels) override;
  [[nodiscard]] bool is_read(std::size_t sonar, std::size_t channel) const override;
  /// @throws Error where a reader that wants every message could not keep up.
  void send(std::size_t sonar, std::size_t channel, std::uint64_t time_ns,
            const std::vector<std::byte>& message) override;

  /// Waits a moment for readers that want every message and have not had the last ones.
  void finish();

 private:
  struct Writer {
    std::string name;
    RawTopic topic;
    DdsEntity writer;
  };

  const Writer& writer(std::size_t sonar, std::size_t channel) const { return *channels_.at(sonar).at(channel); }

  dds_entity_t participant_;
  bool best_effort_;
  SendPace pace_;
  std::map<std::string, Writer> writers_;             // By the name of the topic; stay when a sonar changes.
  std::vector<std::vector<const Writer*>> channels_;  // By sonar and channel.
};

}  // namespace insonify
