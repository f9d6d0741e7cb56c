// foxglove_encoder.h -- a thread that encodes pings as ROS 2 messages, apart from the server's own.

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "insonify/live_loop.h"
#include "insonify/messages.h"

namespace insonify {

/// A ping to encode, and the subscribed ones of SonarMessages::channels().
struct EncoderJob {
  std::shared_ptr<const LivePing> ping;
  std::set<std::size_t> channels;
  double time_offset = 0;  ///< Added to the ping's time, so that stamps increase across changes [s].
  bool again = false;      ///< Whether the ping is repeated, for subscriptions that have nothing of its sonar yet.
};

/// The message of `channel` for the sonar's ping.
struct EncodedMessage {
  std::shared_ptr<const LiveWorld> world;
  int sonar = 0;
  std::size_t channel = 0;
  bool again = false;  ///< As in the job.
  std::uint64_t time_ns = 0;
  std::shared_ptr<const std::string> bytes;
};

/// Drawing a fan takes longer than the rest of a server's work for a ping. If the thread cannot keep up, pings are
/// dropped, except repeated ones: their jobs for the same ping are merged.
class FoxgloveEncoder {
 public:
  /// @param deliver  Called in the encoder's thread.
  FoxgloveEncoder(const MessageOptions& options, std::function<void(EncodedMessage)> deliver);
  ~FoxgloveEncoder();
  FoxgloveEncoder(const FoxgloveEncoder&) = delete;
  FoxgloveEncoder& operator=(const FoxgloveEncoder&) = delete;

  void add(EncoderJob job);

 private:
  void work();
  void encode(const EncoderJob& job);

  MessageOptions options_;
  std::function<void(EncodedMessage)> deliver_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<EncoderJob> jobs_;
  bool ending_ = false;
  // Used by the thread only.
  std::shared_ptr<const LiveWorld> world_;
  std::vector<SonarMessages> messages_;                 // Messages of each sonar ...
  std::vector<std::shared_ptr<const LivePing>> taken_;  // ... and the ping that they describe.
  std::thread thread_;
};

}  // namespace insonify
