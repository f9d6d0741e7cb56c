// dds_reader.h -- reads a topic of ROS 2.

#pragma once

#include <cstdint>
#include <string>

#include "dds/dds_entity.h"

namespace insonify {

/// What a reader asks of those who write. One that asks for less finds more of them.
enum class DdsDelivery {
  kNewest,       ///< The newest message alone; one that gets lost is not sent again.
  kMany,         ///< The newest hundred; likewise.
  kEach,         ///< Each message.
  kEachAndLast,  ///< Each message, and what was written before the reader was there.
};

/// A reader of one topic. Messages that this participant writes itself are not read.
class DdsReader {
 public:
  /// @param topic  As ROS 2 has it: "/auv/odom".
  /// @param type   Made by idlc from ros_types.idl.
  DdsReader(dds_entity_t participant, const std::string& topic, const dds_topic_descriptor_t& type,
            DdsDelivery delivery);

  /// Calls visit(message) for each message that has come since the last call, in order.
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
  /// How many write the topic now.
  [[nodiscard]] std::uint32_t writers() const;
  /// How many do, but not so that this reader could read it.
  [[nodiscard]] std::uint32_t incompatible_writers() const;

 private:
  std::string name_;
  DdsEntity topic_, reader_;
};

}  // namespace insonify
