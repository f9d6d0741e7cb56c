// dds_inputs.h -- reads poses, time and settings from ROS 2 for the bridge.

#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "dds/dds_reader.h"
#include "dds/frame_tree.h"
#include "insonify/live_loop.h"

namespace insonify {

struct DdsInputOptions {
  std::string odometry = {};     ///< Topic; "": none.
  std::string tf = {};           ///< Frame of the vehicle; "": none.
  std::string ping_at = {};      ///< Topic of poses, each for one ping; "": none.
  std::string world_frame = {};  ///< Frame in which the vehicle's pose is looked up.
  bool clock = false;            ///< Whether time comes from /clock.
  std::string set_topic = {};    ///< Topic of settings; replies go to the topic with "_result" appended.
};

/// A thread that reads messages and passes them to a LiveLoop.
class DdsInputs {
 public:
  /// @param loop  Must live until end(); driven if poses are read, clocked if the clock is.
  DdsInputs(dds_entity_t participant, const DdsInputOptions& options, LiveLoop& loop);
  ~DdsInputs() { end(); }
  DdsInputs(const DdsInputs&) = delete;
  DdsInputs& operator=(const DdsInputs&) = delete;

  void start();
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  // Replies to requests for settings; outlives this object.
  struct Answers {
    DdsEntity topic, writer;
    void send(const std::string& text) const;
  };
  // A reader that needs a writer.
  struct Missed {
    const DdsReader* reader;
    std::string type;
    bool seen = false;      // Whether there was a writer at any time.
    bool reported = false;  // Whether the missing writer was reported.
  };

  void read();
  void take_all();
  void take_odometry();
  void take_asked();
  void warn_of_frame(const std::string& topic, const std::string& frame);
  void take_transforms(DdsReader& reader, bool is_static);
  void take_settings();
  void drive(const Pose& world_from_vehicle, const Twist& twist, double stamp);
  void look_for_writers();

  DdsInputOptions options_;
  LiveLoop& loop_;
  std::optional<DdsReader> odometry_, transforms_, static_transforms_, asked_, clock_, settings_;
  std::shared_ptr<Answers> answers_;
  DdsEntity waitset_, wake_;
  std::vector<Missed> missed_;
  Clock::time_point begin_ = Clock::now();
  std::atomic<bool> ending_ = false;
  std::thread thread_;

  // Used by the thread only.
  FrameTree frames_;
  bool placed_ = false;           // Whether transforms connect world and vehicle, or their absence was reported.
  bool warned_of_frame_ = false;  // Whether poses in an unexpected frame were reported.
  std::string refusal_;           // Why the last pose was rejected; "" if it was not.
};

}  // namespace insonify
