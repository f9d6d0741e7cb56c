// fast_node.h -- reads and writes topics of ROS 2 with eProsima's Fast DDS, as nodes of another vendor's would.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace insonify {

using Bytes = std::vector<std::byte>;

/// What a reader asks for, and what a writer offers.
struct FastQos {
  bool reliable = true;
  bool transient_local = false;
  int kept = 100;  ///< Messages.
};

class FastReader {
 public:
  virtual ~FastReader() = default;
  /// All messages so far: CDR with its header, with up to three bytes of padding.
  [[nodiscard]] virtual std::vector<Bytes> messages() const = 0;
  /// Waits until there are so many in all. @return  Whether they came.
  [[nodiscard]] virtual bool wait_for(std::size_t count,
                                      std::chrono::seconds most = std::chrono::seconds(60)) const = 0;
  /// Waits until the bridge is found.
  [[nodiscard]] virtual bool wait_for_writer(std::chrono::seconds most = std::chrono::seconds(60)) const = 0;
};

class FastWriter {
 public:
  virtual ~FastWriter() = default;
  virtual void write(const Bytes& message) = 0;
  [[nodiscard]] virtual bool wait_for_reader(std::chrono::seconds most = std::chrono::seconds(60)) const = 0;
};

/// A participant that talks over the loopback interface alone and finds others without multicast.
class FastNode {
 public:
  /// @param socket_buffer  Of the sockets that receive [byte]; 0 for what the system has as default.
  explicit FastNode(int domain, std::uint32_t socket_buffer = 4 << 20);
  ~FastNode();
  FastNode(const FastNode&) = delete;
  FastNode& operator=(const FastNode&) = delete;

  /// @param topic  As on the wire: "rt/fls/fan".
  /// @param type   As on the wire: "sensor_msgs::msg::dds_::Image_".
  /// @param hear   Is called with each message, in a thread of Fast DDS; it is not kept then.
  std::unique_ptr<FastReader> reader(const std::string& topic, const std::string& type, const FastQos& qos = {},
                                     std::function<void(const Bytes&)> hear = {});
  /// What a writer or reader of another participant tells of itself beside its qualities of service; "" where there is
  /// none, or none yet.
  [[nodiscard]] std::string user_data(const std::string& topic) const;
  std::unique_ptr<FastWriter> writer(const std::string& topic, const std::string& type, const FastQos& qos = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
