// dds_inputs.cpp -- reads poses, time and settings from ROS 2 topics.

#include "dds/dds_inputs.h"

#include <fmt/format.h>
#include <ros_types.h>

#include <cmath>
#include <utility>

#include "console/console.h"
#include "dds/dds_names.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "transport/bridge.h"

namespace insonify {
namespace {

using TimeMessage = builtin_interfaces_msg_dds__Time_;
using StampedPose = geometry_msgs_msg_dds__PoseStamped_;
using Odometry = nav_msgs_msg_dds__Odometry_;
using Transforms = tf2_msgs_msg_dds__TFMessage_;
using ClockMessage = rosgraph_msgs_msg_dds__Clock_;
using Text = std_msgs_msg_dds__String_;

double seconds(const TimeMessage& time) {
  return time.sec + 1e-9 * time.nanosec;
}

template <typename Vector>
Vec3 vector(const Vector& from) {
  return {from.x, from.y, from.z};
}

// The norm drifts in programs that store orientations in single precision or accumulate small rotations; such small
// drift is accepted.
Eigen::Quaterniond orientation(const geometry_msgs_msg_dds__Quaternion_& from) {
  constexpr double kDrift = 0.01;
  const Eigen::Quaterniond given(from.w, from.x, from.y, from.z);
  return std::abs(given.norm() - 1) < kDrift ? given.normalized() : given;
}

double unix_time() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace

void DdsInputs::Answers::send(const std::string& text) const {
  std::string copy = text;
  const Text message{copy.data()};
  (void)dds_write(writer.get(), &message);  // The requester may be gone.
}

DdsInputs::DdsInputs(dds_entity_t participant, const DdsInputOptions& options, LiveLoop& loop)
    : options_(options), loop_(loop) {
  waitset_ = DdsEntity(dds_create_waitset(participant), "wait for messages");
  wake_ = DdsEntity(dds_create_guardcondition(participant), "wait for messages");
  check_dds(dds_waitset_attach(waitset_.get(), wake_.get(), 0), "wait for messages");
  const auto add = [&](std::optional<DdsReader>& reader, const std::string& topic, const dds_topic_descriptor_t& type,
                       DdsDelivery delivery) {
    reader.emplace(participant, topic, type, delivery);
    check_dds(dds_set_status_mask(reader->get(), DDS_DATA_AVAILABLE_STATUS), "wait for messages");
    check_dds(dds_waitset_attach(waitset_.get(), reader->get(), 0), "wait for messages");
  };
  if (!options.odometry.empty()) {
    add(odometry_, options.odometry, nav_msgs_msg_dds__Odometry__desc, DdsDelivery::kNewest);
    missed_.push_back({&*odometry_, "nav_msgs/msg/Odometry"});
  }
  if (!options.tf.empty()) {
    add(transforms_, "/tf", tf2_msgs_msg_dds__TFMessage__desc, DdsDelivery::kMany);
    add(static_transforms_, "/tf_static", tf2_msgs_msg_dds__TFMessage__desc, DdsDelivery::kEachAndLast);
    missed_.push_back({&*transforms_, "tf2_msgs/msg/TFMessage"});
  }
  if (!options.ping_at.empty()) {
    add(asked_, options.ping_at, geometry_msgs_msg_dds__PoseStamped__desc, DdsDelivery::kEach);
  }
  if (options.clock) {
    add(clock_, "/clock", rosgraph_msgs_msg_dds__Clock__desc, DdsDelivery::kNewest);
    missed_.push_back({&*clock_, "rosgraph_msgs/msg/Clock"});
  }
  add(settings_, options.set_topic, std_msgs_msg_dds__String__desc, DdsDelivery::kEach);
  answers_ = std::make_shared<Answers>();
  const std::string answer = options.set_topic + "_result";
  answers_->topic = DdsEntity(
      dds_create_topic(participant, &std_msgs_msg_dds__String__desc, dds_topic_name(answer).c_str(), nullptr, nullptr),
      fmt::format("make the topic {}", answer));
  const DdsQos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 10);
  add_type_hash(qos.get(), std_msgs_msg_dds__String__desc.m_typename);
  answers_->writer = DdsEntity(dds_create_writer(participant, answers_->topic.get(), qos.get(), nullptr),
                               fmt::format("make a writer of {}", answer));
}

void DdsInputs::start() {
  begin_ = Clock::now();
  thread_ = std::thread([this] { read(); });
}

void DdsInputs::end() {
  if (!thread_.joinable()) {
    return;
  }
  ending_ = true;
  (void)dds_set_guardcondition(wake_.get(), true);
  thread_.join();
}

void DdsInputs::read() {
  constexpr dds_duration_t kLook = DDS_MSECS(500);  // Between checks for writers.
  while (!ending_) {
    (void)dds_waitset_wait(waitset_.get(), nullptr, 0, kLook);
    take_all();
    look_for_writers();
  }
}

// A pose received before a clock message must affect the pings of that time, so the time is read first and passed last.
void DdsInputs::take_all() {
  std::optional<double> time;
  if (clock_) {
    clock_->take<ClockMessage>([&](const ClockMessage& message) { time = seconds(message.clock); });
  }
  if (odometry_) {
    take_odometry();
  }
  if (transforms_) {
    take_transforms(*static_transforms_, true);
    take_transforms(*transforms_, false);
  }
  if (asked_) {
    take_asked();
  }
  take_settings();
  if (time) {
    loop_.advance(*time);
  }
}

void DdsInputs::warn_of_frame(const std::string& topic, const std::string& frame) {
  if (!frame.empty() && frame != options_.world_frame && !std::exchange(warned_of_frame_, true)) {
    complain(fmt::format("{}: poses are in the frame {}, which messages call {}; --world-frame {} would agree", topic,
                         printable(frame), options_.world_frame, printable(frame)));
  }
}

void DdsInputs::take_asked() {
  asked_->take<StampedPose>([this](const StampedPose& message) {
    warn_of_frame(options_.ping_at, message.header.frame_id);
    drive({vector(message.pose.position), orientation(message.pose.orientation)}, {}, seconds(message.header.stamp));
  });
}

// Odometry's twist is in the vehicle's frame.
void DdsInputs::take_odometry() {
  odometry_->take<Odometry>([this](const Odometry& message) {
    warn_of_frame(options_.odometry, message.header.frame_id);
    const Pose pose{vector(message.pose.pose.position), orientation(message.pose.pose.orientation)};
    const auto& twist = message.twist.twist;
    drive(pose, {pose.orientation * vector(twist.linear), pose.orientation * vector(twist.angular)},
          seconds(message.header.stamp));
  });
}

void DdsInputs::take_transforms(DdsReader& reader, bool is_static) {
  bool any = false;
  reader.take<Transforms>([&](const Transforms& message) {
    for (std::uint32_t i = 0; i < message.transforms._length; ++i) {
      const auto& each = message.transforms._buffer[i];
      frames_.set(each.header.frame_id, each.child_frame_id,
                  {vector(each.transform.translation), orientation(each.transform.rotation)},
                  is_static ? 0 : seconds(each.header.stamp));
      any = true;
    }
  });
  if (!any) {
    return;
  }
  if (const auto place = frames_.find(options_.world_frame, options_.tf)) {
    placed_ = true;
    drive(place->pose, {}, place->stamp);
  }
}

void DdsInputs::drive(const Pose& world_from_vehicle, const Twist& twist, double stamp) {
  std::string refusal;
  try {
    // A message without a stamp counts as current; simulated time starts at 0.
    loop_.drive({.world_from_vehicle = world_from_vehicle,
                 .twist = twist,
                 .stamp = stamp != 0 || options_.clock ? stamp : unix_time()});
  } catch (const Error& error) {
    refusal = fmt::format("{}: {}", !options_.tf.empty() ? "/tf" : options_.odometry + options_.ping_at, error.what());
  }
  if (!refusal.empty() && refusal_.empty()) {  // Once, not for every message.
    complain(refusal);
  }
  refusal_ = refusal;
}

void DdsInputs::take_settings() {
  settings_->take<Text>([this](const Text& message) {
    request_settings(loop_, message.data, [answers = answers_](const std::string& answer) { answers->send(answer); });
  });
}

// Reports topics without a writer, once discovery has had time to complete, and writers that appear later.
void DdsInputs::look_for_writers() {
  const bool patient = Clock::now() - begin_ < std::chrono::seconds(3);
  for (Missed& each : missed_) {
    const bool there = each.reader->writers() > 0;
    if (!there && !each.reported && (each.seen || !patient)) {
      complain(each.reader->incompatible_writers() > 0
                   ? fmt::format("{}: is written without the quality of service that is needed", each.reader->topic())
                   : fmt::format("{}: nobody writes {} to it{}", each.reader->topic(), each.type,
                                 each.seen ? " any more" : ""));
      each.reported = true;
    } else if (there && each.reported) {
      complain(fmt::format("{}: is written now", each.reader->topic()));
      each.reported = false;
    }
    each.seen = each.seen || there;
  }
  if (transforms_ && !patient && !placed_ && transforms_->writers() > 0) {
    complain(fmt::format("/tf: leads from {} up to {}, not to {}", printable(options_.tf),
                         printable(frames_.top(options_.tf)), printable(options_.world_frame)));
    placed_ = true;  // Once.
  }
}

}  // namespace insonify
