// fast_node.cpp -- Fast DDS with a type whose messages are encoded already.

#include "bridges/dds/fast_node.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <map>
#include <mutex>
#include <stdexcept>

namespace insonify {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

using Lock = std::unique_lock<std::mutex>;

// Samples are Bytes.
class RawType : public dds::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 64;  // To begin with; histories grow.
    m_isGetKeyDefined = false;
  }
  bool serialize(void* sample, rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<const Bytes*>(sample);
    payload->reserve(static_cast<std::uint32_t>(bytes.size()));
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* sample) override {
    const auto* first = reinterpret_cast<const std::byte*>(payload->data);
    static_cast<Bytes*>(sample)->assign(first, first + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* sample) override {
    return [sample] { return static_cast<std::uint32_t>(static_cast<const Bytes*>(sample)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* sample) override { delete static_cast<Bytes*>(sample); }
  bool getKey(void* /*sample*/, rtps::InstanceHandle_t* /*handle*/, bool /*force_md5*/) override { return false; }
};

// Counts the other side's ends.
class Matches {
 public:
  void set(int count) {
    const Lock lock(mutex_);
    count_ = count;
    changed_.notify_all();
  }
  bool wait(std::chrono::seconds most) const {
    Lock lock(mutex_);
    return changed_.wait_for(lock, most, [this] { return count_ > 0; });
  }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  int count_ = 0;
};

template <typename Qos>
void fill(Qos& to, const FastQos& from) {
  to.reliability().kind = from.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  to.durability().kind = from.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  to.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  to.history().depth = from.kept;
  to.resource_limits().allocated_samples = 1;
  to.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
}

template <typename Entity>
Entity* made(Entity* entity, const char* what) {
  if (entity == nullptr) {
    throw std::runtime_error(std::string("Fast DDS makes no ") + what);
  }
  return entity;
}

class Reader : public FastReader, private dds::DataReaderListener {
 public:
  Reader(dds::Subscriber& subscriber, dds::Topic& topic, const FastQos& qos, std::function<void(const Bytes&)> hear)
      : subscriber_(subscriber), hear_(std::move(hear)) {
    dds::DataReaderQos settings = subscriber.get_default_datareader_qos();
    fill(settings, qos);
    reader_ = made(subscriber.create_datareader(&topic, settings, this), "reader");
  }
  ~Reader() override {
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }
  [[nodiscard]] std::vector<Bytes> messages() const override {
    const Lock lock(mutex_);
    return messages_;
  }
  [[nodiscard]] bool wait_for(std::size_t count, std::chrono::seconds most) const override {
    Lock lock(mutex_);
    return changed_.wait_for(lock, most, [&] { return messages_.size() >= count; });
  }
  [[nodiscard]] bool wait_for_writer(std::chrono::seconds most) const override { return matches_.wait(most); }

 private:
  void on_subscription_matched(dds::DataReader* /*reader*/, const dds::SubscriptionMatchedStatus& status) override {
    matches_.set(status.current_count);
  }
  void on_data_available(dds::DataReader* reader) override {
    Bytes bytes;
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) {
        continue;
      }
      if (hear_) {
        hear_(bytes);
        continue;
      }
      const Lock lock(mutex_);
      messages_.push_back(bytes);
      changed_.notify_all();
    }
  }

  dds::Subscriber& subscriber_;
  dds::DataReader* reader_ = nullptr;
  std::function<void(const Bytes&)> hear_;
  Matches matches_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::vector<Bytes> messages_;
};

class Writer : public FastWriter, private dds::DataWriterListener {
 public:
  Writer(dds::Publisher& publisher, dds::Topic& topic, const FastQos& qos) : publisher_(publisher) {
    dds::DataWriterQos settings = publisher.get_default_datawriter_qos();
    fill(settings, qos);
    writer_ = made(publisher.create_datawriter(&topic, settings, this), "writer");
  }
  ~Writer() override {
    writer_->set_listener(nullptr);
    publisher_.delete_datawriter(writer_);
  }
  void write(const Bytes& message) override {
    Bytes sample = message;
    if (!writer_->write(&sample)) {
      throw std::runtime_error("Fast DDS does not write a message");
    }
  }
  [[nodiscard]] bool wait_for_reader(std::chrono::seconds most) const override { return matches_.wait(most); }

 private:
  void on_publication_matched(dds::DataWriter* /*writer*/, const dds::PublicationMatchedStatus& status) override {
    matches_.set(status.current_count);
  }

  dds::Publisher& publisher_;
  dds::DataWriter* writer_ = nullptr;
  Matches matches_;
};

// Keeps the user data of others.
class Discovery : public dds::DomainParticipantListener {
 public:
  void on_publisher_discovery(dds::DomainParticipant* /*participant*/, rtps::WriterDiscoveryInfo&& found) override {
    keep(found.info.topicName().to_string(), found.info.m_qos.m_userData.data_vec());
  }
  void on_subscriber_discovery(dds::DomainParticipant* /*participant*/, rtps::ReaderDiscoveryInfo&& found) override {
    keep(found.info.topicName().to_string(), found.info.m_qos.m_userData.data_vec());
  }
  std::string user_data(const std::string& topic) {
    const Lock lock(mutex_);
    return user_data_[topic];
  }

 private:
  void keep(const std::string& topic, const std::vector<rtps::octet>& data) {
    const Lock lock(mutex_);
    user_data_[topic].assign(data.begin(), data.end());
  }

  std::mutex mutex_;
  std::map<std::string, std::string> user_data_;  // By topic.
};

}  // namespace

struct FastNode::State {
  Discovery discovery;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;

  dds::Topic& topic(const std::string& name, const std::string& type) const {
    if (dds::TopicDescription* known = participant->lookup_topicdescription(name)) {
      return *static_cast<dds::Topic*>(known);
    }
    dds::TypeSupport(new RawType(type)).register_type(participant);
    return *made(participant->create_topic(name, type, dds::TOPIC_QOS_DEFAULT), "topic");
  }
};

FastNode::FastNode(int domain, std::uint32_t socket_buffer) : state_(std::make_unique<State>()) {
  dds::DomainParticipantQos qos;
  const auto loopback = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  loopback->interfaceWhiteList.emplace_back("127.0.0.1");
  loopback->receiveBufferSize = socket_buffer;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(loopback);
  rtps::Locator_t peer;  // Without a port: those of the first participants of the domain.
  rtps::IPLocator::setIPv4(peer, 127, 0, 0, 1);
  qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  state_->participant = made(dds::DomainParticipantFactory::get_instance()->create_participant(
                                 static_cast<std::uint32_t>(domain), qos, &state_->discovery, dds::StatusMask::none()),
                             "participant");
  state_->publisher = made(state_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "publisher");
  state_->subscriber = made(state_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "subscriber");
}

FastNode::~FastNode() {
  state_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(state_->participant);
}

std::string FastNode::user_data(const std::string& topic) const {
  return state_->discovery.user_data(topic);
}

std::unique_ptr<FastReader> FastNode::reader(const std::string& topic, const std::string& type, const FastQos& qos,
                                             std::function<void(const Bytes&)> hear) {
  return std::make_unique<Reader>(*state_->subscriber, state_->topic(topic, type), qos, std::move(hear));
}

std::unique_ptr<FastWriter> FastNode::writer(const std::string& topic, const std::string& type, const FastQos& qos) {
  return std::make_unique<Writer>(*state_->publisher, state_->topic(topic, type), qos);
}

}  // namespace insonify
