// dds_inputs.h -- what the bridge reads from ROS 2: poses, time and settings.

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
  std::string odometry = {};     ///< Topic; "" for none.
  std::string tf = {};           ///< Frame of the vehicle; "" for none.
  std::string world_frame = {};  ///< Its transform is looked for from this frame on.
  bool clock = false;            ///< Whether /clock tells the time.
  std::string set_topic = {};    ///< Settings are read from it and answered on it with "_result" at its end.
};

/// A thread that passes what it reads to a LiveLoop.
class DdsInputs {
 public:
  /// @param loop  Must live until end(). With poses it must be driven, with the clock clocked.
  DdsInputs(dds_entity_t participant, const DdsInputOptions& options, LiveLoop& loop);
  ~DdsInputs() { end(); }
  DdsInputs(const DdsInputs&) = delete;
  DdsInputs& operator=(const DdsInputs&) = delete;

  void start();
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  // Who answers requests for settings, also after the end of this object.
  struct Answers {
    DdsEntity topic, writer;
    void tell(const std::string& text) const;
  };
  // A reader whose writers are missed when they are not there.
  struct Missed {
    const DdsReader* reader;
    std::string type;
    bool seen = false;  // Whether there ever were writers.
    bool told = false;  // Whether the user knows that there are none.
  };

  void read();
  void take_all();
  void take_odometry();
  void take_transforms(DdsReader& reader, bool is_static);
  void take_settings();
  void drive(const Pose& world_from_vehicle, const Twist& twist, double stamp);
  void look_for_writers();

  DdsInputOptions options_;
  LiveLoop& loop_;
  std::optional<DdsReader> odometry_, transforms_, static_transforms_, clock_, settings_;
  std::shared_ptr<Answers> answers_;
  DdsEntity waitset_, wake_;
  std::vector<Missed> missed_;
  Clock::time_point begin_ = Clock::now();
  std::atomic<bool> ending_ = false;
  std::thread thread_;

  // Used by the thread alone.
  FrameTree frames_;
  bool placed_ = false;      // Whether they led from the world to the vehicle, or that they do not was told.
  bool told_frame_ = false;  // Whether it was told that poses are in another frame than messages.
  std::string refusal_;      // Why the last pose was no good.
};

}  // namespace insonify
