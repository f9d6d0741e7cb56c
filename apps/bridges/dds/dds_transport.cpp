// dds_transport.cpp -- makes a writer for each topic.

#include "dds/dds_transport.h"

#include <algorithm>
#include <utility>

#include "dds/dds_names.h"

namespace insonify {
namespace {

// ROS 2's quality of service for these topics. It matches readers that request less, such as those of sensor data, but
// not readers that request more.
DdsQos qos_of(const MessageChannel& channel, bool best_effort, bool lossless) {
  constexpr int kKept = 10, kKeptTransforms = 100, kKeptLossless = 1000;  // Messages until they are acknowledged.
  // How long sending waits for readers; a reader that is gone is given up after the 10 s of its lease.
  constexpr dds_duration_t kMostBlocking = DDS_MSECS(100), kMostBlockingLossless = DDS_SECS(10);
  DdsQos qos(dds_create_qos());
  const bool is_transform = channel.kind == MessageKind::kTransforms;
  const bool is_lossy = best_effort && !channel.latched && !is_transform;
  dds_qset_reliability(qos.get(), is_lossy ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
                       lossless ? kMostBlockingLossless : kMostBlocking);
  dds_qset_durability(qos.get(), channel.latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  const int kept = channel.latched ? 1 : lossless ? kKeptLossless : is_transform ? kKeptTransforms : kKept;
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kept);
  return qos;
}

}  // namespace

void DdsTransport::open(std::size_t sonar, const std::vector<MessageChannel>& channels) {
  channels_.resize(std::max(channels_.size(), sonar + 1));
  channels_[sonar].clear();
  for (const MessageChannel& channel : channels) {
    const std::string name = dds_topic_name(channel.topic);
    auto found = writers_.find(name);
    if (found == writers_.end()) {
      RawTopic topic(participant_, name, dds_type_name(channel.type), nullptr);
      const DdsQos qos = qos_of(channel, best_effort_, lossless_);
      add_type_hash(qos.get(), dds_type_name(channel.type));
      DdsEntity writer(dds_create_writer(participant_, topic.get(), qos.get(), nullptr),
                       fmt::format("make a writer of {}", name));
      found = writers_.emplace(name, Writer{channel.topic, std::move(topic), std::move(writer)}).first;
    }
    channels_[sonar].push_back(&found->second);
  }
}

bool DdsTransport::is_read(std::size_t sonar, std::size_t channel) const {
  dds_publication_matched_status_t status{};
  return dds_get_publication_matched_status(writer(sonar, channel).writer.get(), &status) == DDS_RETCODE_OK &&
         status.current_count > 0;
}

void DdsTransport::send(std::size_t sonar, std::size_t channel, std::uint64_t /*time_ns*/,
                        const std::vector<std::byte>& message) {
  const Writer& to = writer(sonar, channel);
  check_dds(write_raw(to.writer.get(), to.topic, message, pace_), fmt::format("send a message of {}", to.name));
}

void DdsTransport::finish() {
  const dds_time_t end = dds_time() + DDS_MSECS(300);
  for (const auto& [name, each] : writers_) {
    if (const dds_duration_t rest = end - dds_time(); rest > 0) {
      (void)dds_wait_for_acks(each.writer.get(), rest);
    }
  }
}

}  // namespace insonify
