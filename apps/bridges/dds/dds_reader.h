// dds_reader.h -- reads a ROS 2 topic.

#pragma once

#include <cstdint>
#include <string>

#include "dds/dds_entity.h"

namespace insonify {

/// Quality of service that a reader requests. Weaker requests match more writers.
enum class DdsDelivery {
  kNewest,       ///< The newest message only; lost ones are not sent again.
  kMany,         ///< The newest 100; lost ones are not sent again.
  kEach,         ///< Each message.
  kEachAndLast,  ///< Each message, and the last ones written before the reader existed.
};

/// A reader of one topic. Ignores messages written by its own participant.
class DdsReader {
 public:
  /// @param topic  ROS 2 name: "/auv/odom".
  /// @param type   Made by idlc from ros_types.idl.
  DdsReader(dds_entity_t participant, const std::string& topic, const dds_topic_descriptor_t& type,
            DdsDelivery delivery);

  /// Calls visit(message) for each message received since the last call, in order.
  template <typename Message, typename Visit>
  void take(Visit&& visit) {
    constexpr int kMost = 16;
    for (int count = kMost; count == kMost;) {
      void* messages[kMost] = {};
      dds_sample_info_t infos[kMost];
      count = dds_take(reader_.get(), messages, infos, kMost, kMost);
      for (int i = 0; i < count; ++i) {
        if (infos[i].valid_data) {
          visit(*static_cast<const Message*>(messages[i]));
        }
      }
      if (count > 0) {
        (void)dds_return_loan(reader_.get(), messages, count);
      }
    }
  }

  [[nodiscard]] dds_entity_t get() const { return reader_.get(); }
  [[nodiscard]] const std::string& topic() const { return name_; }
  /// Number of current writers of the topic.
  [[nodiscard]] std::uint32_t writers() const;
  /// Number of current writers whose quality of service does not match this reader's.
  [[nodiscard]] std::uint32_t incompatible_writers() const;

 private:
  std::string name_;
  DdsEntity topic_, reader_;
};

}  // namespace insonify
