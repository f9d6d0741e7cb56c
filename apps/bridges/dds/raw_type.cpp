// raw_type.cpp -- CycloneDDS's type operations for messages that are already encoded; a leaky bucket for the pace.

#include "dds/raw_type.h"

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <thread>

namespace insonify {
namespace {

// DDS sends messages in multiples of four bytes.
constexpr std::size_t kAlignment = 4;

std::size_t padded(std::size_t size) {
  return (size + kAlignment - 1) / kAlignment * kAlignment;
}

struct RawMessage : ddsi_serdata {
  RawMessage(const ddsi_sertype* of, ddsi_serdata_kind what, std::span<const std::byte> message)
      : ddsi_serdata{}, size(message.size()), bytes(padded(message.size())) {
    ddsi_serdata_init(this, of, what);
    std::ranges::copy(message, bytes.begin());
  }

  std::size_t size;
  std::vector<std::byte> bytes;  // With padding.
};

const RawMessage& raw(const ddsi_serdata* message) {
  return *static_cast<const RawMessage*>(message);
}

// A topic without keys has a single instance.
bool has_same_key(const ddsi_serdata* /*a*/, const ddsi_serdata* /*b*/) {
  return true;
}

std::uint32_t size_of(const ddsi_serdata* message) {
  return static_cast<std::uint32_t>(raw(message).size);
}

void copy_to(const ddsi_serdata* message, std::size_t offset, std::size_t size, void* buffer) {
  std::memcpy(buffer, raw(message).bytes.data() + offset, size);
}

// Set in the writing thread during a write. Threads that resend fragments have none.
thread_local SendPace* current_pace = nullptr;

// Called right before each fragment is sent.
ddsi_serdata* lend(const ddsi_serdata* message, std::size_t offset, std::size_t size, ddsrt_iovec_t* lent) {
  if (current_pace != nullptr) {
    current_pace->wait(size);
  }
  lent->iov_base = const_cast<std::byte*>(raw(message).bytes.data() + offset);
  lent->iov_len = size;
  return ddsi_serdata_ref(message);
}

void take_back(ddsi_serdata* message, const ddsrt_iovec_t* /*lent*/) {
  ddsi_serdata_unref(message);
}

ddsi_serdata* key_of(const ddsi_serdata* message) {
  auto* key = new RawMessage(message->type, SDK_KEY, {});
  key->type = nullptr;
  return key;
}

void free_message(ddsi_serdata* message) {
  delete static_cast<RawMessage*>(message);
}

std::size_t print(const ddsi_sertype* /*type*/, const ddsi_serdata* /*message*/, char* buffer, std::size_t size) {
  return static_cast<std::size_t>(std::max(0, std::snprintf(buffer, size, "(raw)")));
}

void hash_key(const ddsi_serdata* /*message*/, ddsi_keyhash* hash, bool /*as_md5*/) {
  *hash = {};
}

// These topics are write-only: operations that would decode received bytes fail.
ddsi_serdata_ops message_operations() {
  ddsi_serdata_ops operations{};
  operations.eqkey = has_same_key;
  operations.get_size = size_of;
  operations.from_ser = [](auto...) -> ddsi_serdata* { return nullptr; };
  operations.from_ser_iov = [](auto...) -> ddsi_serdata* { return nullptr; };
  operations.from_keyhash = [](auto...) -> ddsi_serdata* { return nullptr; };
  operations.from_sample = [](auto...) -> ddsi_serdata* { return nullptr; };
  operations.to_ser = copy_to;
  operations.to_ser_ref = lend;
  operations.to_ser_unref = take_back;
  operations.to_sample = [](auto...) { return false; };
  operations.to_untyped = key_of;
  operations.untyped_to_sample = [](auto...) { return false; };
  operations.free = free_message;
  operations.print = print;
  operations.get_keyhash = hash_key;
  return operations;
}
const ddsi_serdata_ops kMessageOperations = message_operations();

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}

// CycloneDDS has compared the names already: equal names mean equal types.
ddsi_sertype_ops type_operations() {
  ddsi_sertype_ops operations{};
  operations.version = ddsi_sertype_v0;
  operations.free = free_type;
  operations.zero_samples = [](auto...) {};
  operations.realloc_samples = [](void** samples, auto...) { *samples = nullptr; };
  operations.free_samples = [](auto...) {};
  operations.equal = [](auto...) { return true; };
  operations.hash = [](auto...) { return std::uint32_t{0}; };
  return operations;
}
const ddsi_sertype_ops kTypeOperations = type_operations();

}  // namespace

RawTopic::RawTopic(dds_entity_t participant, const std::string& name, const std::string& type, const dds_qos_t* qos) {
  auto* raw_type = new ddsi_sertype{};
  ddsi_sertype_init_flags(raw_type, type.c_str(), &kTypeOperations, &kMessageOperations,
                          DDSI_SERTYPE_FLAG_TOPICKIND_NO_KEY);
  ddsi_sertype* used = raw_type;  // Replaced by an existing one of the same type, if any.
  const dds_entity_t topic = dds_create_topic_sertype(participant, name.c_str(), &used, qos, nullptr, nullptr);
  if (topic < 0) {
    ddsi_sertype_unref(raw_type);
  }
  topic_ = DdsEntity(topic, fmt::format("make the topic {} of type {}", name, type));
  type_ = used;
}

void SendPace::wait(std::size_t size) {
  const auto drain = [this] {
    const Clock::time_point now = Clock::now();
    const double passed = std::chrono::duration<double>(now - at_).count();
    pending_ = std::max(0.0, pending_ - passed * rate_);
    at_ = now;
  };
  drain();
  const auto bytes = static_cast<double>(size);
  const double excess = std::min(pending_, pending_ + bytes - kBurst);  // A single fragment may exceed a burst.
  if (excess > 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(excess / rate_));
    drain();
  }
  pending_ += bytes;
}

dds_return_t write_raw(dds_entity_t writer, const RawTopic& topic, std::span<const std::byte> message, SendPace& pace) {
  current_pace = &pace;
  const dds_return_t result = dds_writecdr(writer, new RawMessage(topic.type(), SDK_DATA, message));
  current_pace = nullptr;
  return result;
}

}  // namespace insonify
