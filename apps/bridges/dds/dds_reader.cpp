// dds_reader.cpp -- makes a reader with the quality of service that ROS 2 uses for its kind of topic.

#include "dds/dds_reader.h"

#include "dds/dds_names.h"

namespace insonify {

DdsReader::DdsReader(dds_entity_t participant, const std::string& topic, const dds_topic_descriptor_t& type,
                     DdsDelivery delivery)
    : name_(topic) {
  const std::string name = dds_topic_name(topic);
  topic_ = DdsEntity(dds_create_topic(participant, &type, name.c_str(), nullptr, nullptr),
                     fmt::format("make the topic {}", name));
  const DdsQos qos(dds_create_qos());
  const bool is_each = delivery == DdsDelivery::kEach || delivery == DdsDelivery::kEachAndLast;
  constexpr int kKept = 100;
  dds_qset_reliability(qos.get(), is_each ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(),
                      delivery == DdsDelivery::kEachAndLast ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, delivery == DdsDelivery::kNewest ? 1 : kKept);
  add_type_hash(qos.get(), type.m_typename);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  reader_ = DdsEntity(dds_create_reader(participant, topic_.get(), qos.get(), nullptr),
                      fmt::format("make a reader of {}", name));
}

std::uint32_t DdsReader::writers() const {
  dds_subscription_matched_status_t status{};
  return dds_get_subscription_matched_status(get(), &status) == DDS_RETCODE_OK ? status.current_count : 0;
}

std::uint32_t DdsReader::incompatible_writers() const {
  dds_requested_incompatible_qos_status_t status{};
  return dds_get_requested_incompatible_qos_status(get(), &status) == DDS_RETCODE_OK ? status.total_count : 0;
}

}  // namespace insonify
