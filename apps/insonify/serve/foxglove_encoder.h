// foxglove_encoder.h -- a thread that encodes pings as ROS 2 messages, beside the server's own.

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

/// A ping to be encoded, and those of SonarMessages::channels() that somebody wants.
struct EncoderJob {
  std::shared_ptr<const LivePing> ping;
  std::set<std::size_t> channels;
  double time_offset = 0;  ///< Added to the time of the ping, so that stamps rise over changes [s].
  bool again = false;      ///< Whether the ping was there before: for subscriptions that have nothing of its sonar yet.
};

/// A message: what `channel` tells of the sonar's ping.
struct EncodedMessage {
  std::shared_ptr<const LiveWorld> world;
  int sonar = 0;
  std::size_t channel = 0;
  bool again = false;  ///< As the job's.
  std::uint64_t time_ns = 0;
  std::shared_ptr<const std::string> bytes;
};

/// Drawing a fan takes longer than all else that a server does for a ping. Where it does not keep up, pings are left
/// out, but not those that are there again: jobs of these with the same ping are merged.
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
  // Used by the thread alone.
  std::shared_ptr<const LiveWorld> world_;
  std::vector<SonarMessages> messages_;                 // Messages of each sonar ...
  std::vector<std::shared_ptr<const LivePing>> taken_;  // ... and the ping that they are about.
  std::thread thread_;
};

}  // namespace insonify
