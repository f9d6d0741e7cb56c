// messages.h -- pings as messages of ROS 2 (CDR), ROS 1 and Gazebo: for recordings, live viewers and bridges.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/picture.h"
#include "insonify/ping.h"
#include "insonify/scenario.h"

namespace insonify {

/// Information about a sonar in its messages, beyond its pings.
struct MessageSource {
  SonarConfig sonar;  ///< From Simulator::sonar(), with everything filled in.
  EchoModel model = EchoModel::kCalibrated;
  ReceiverConfig receiver;  ///< Receiver of this sonar: Scenario::receiver_of().
  std::string scenario;     ///< Text of the scenario file, as in recordings; "": none.
  std::string name = {};    ///< Name in topics and frames; "": the sonar's, with `_` for characters invalid in ROS.
  std::vector<std::string> labels = {};   ///< Names of the scene's instances, in order, for kDescription.
  std::optional<double> absorption = {};  ///< Of the water at the sonar's frequency, for MCAP files [dB/m]; absent:
                                          ///< unknown.
};

/// Sonars whose topics would have the same name get unique ones: the second one has the suffix `_2`, the third `_3`
/// ...
/// @param sonar  From Simulator::sonar().
[[nodiscard]] MessageSource message_source(const Scenario& scenario, const SonarConfig& sonar);

/// Gives the sonars of one run unique topic names, as message_source() does for those of a scenario.
/// @throws Error for two sonars of the same name.
void name_topics(std::vector<MessageSource>& sources);

/// Options for messages of pings.
struct MessageOptions {
  int bits = 16;  ///< Bits per value of ProjectedSonarImage, 8 or 16.

  /// Levels of the darkest and the brightest value, in sonar images and fans [dB]; absent: see SonarMessages::levels().
  std::optional<double> low_db = {}, high_db = {};

  int fan_height = 480;                        ///< Height of the fan picture [pixels], 240..8192.
  ColourMap colour_map = ColourMap::kInferno;  ///< Colour map of the fan picture.
  bool annotations = false;                    ///< Whether the fan picture has rings, axes and a colour bar.
  bool raw = false;                            ///< Whether there is a channel kRaw.
  bool live = false;  ///< Whether there are kLabels, kDescription and, of scanning sonars, kScan. Not with kGazebo.
  double strong_share = 0.01;         ///< Share of a ping's cells that become points, in (0, 1].
  std::string world_frame = "world";  ///< Name of the frame of the world, not empty.
  std::string vehicle_frame = {};  ///< The vehicle's frame: kTransforms has the sonar's mounting on it, on /tf_static.
                                   ///< "": it has the sonar's pose in the world, on /tf.

  /// Largest rate of fan pictures in a file, per sonar and second of ping time, 0..1000 [1/s]; 0: none. Absent:
  /// kScanningFanRate for a scanning sonar, whose picture changes by one beam per ping; one per ping for
  /// others.
  std::optional<double> fan_rate = {};

  static constexpr double kScanningFanRate = 2;  ///< [1/s]

  /// When the run started: the pings' time 0, since 1970-01-01T00:00:00Z, below 2^31 s [ns]. Absent: 0, or in an export
  /// the start that the recordings have.
  std::optional<std::uint64_t> start_ns = {};

  /// Rate of a sonar's fan pictures in a file [1/s]; absent: one per ping.
  [[nodiscard]] std::optional<double> fan_rate_of(const SonarConfig& sonar) const;

  /// @throws Error on the first field out of limits.
  void validate() const;

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    constexpr Limits kLevels = from_to(-400, 400);
    visit(Field{"bits", "", from_to(8, 16), "Bits of a value of a sonar image: 8 or 16."}, self.bits);
    visit(Field{"low_db", "dB", kLevels, "Level of the darkest value."}, self.low_db);
    visit(Field{"high_db", "dB", kLevels, "Level of the brightest value."}, self.high_db);
    visit(Field{"fan_height", "pixels", from_to(240, 8192), "Height of the fan picture."}, self.fan_height);
    visit(Field{"annotations", "", {}, "Whether the fan picture has rings, axes and a colour bar."}, self.annotations);
    visit(Field{"raw", "", {}, "Whether there is a topic of images with a pixel for each beam and bin."}, self.raw);
    visit(Field{"strong_share", "", above_to(0, 1), "Share of a ping's cells that become points."}, self.strong_share);
    visit(Field{"world_frame", "", {}, "Name of the frame of the world."}, self.world_frame);
    visit(Field{"fan_rate", "1/s", from_to(0, 1000),
                "Fan pictures in a file for a second of the pings' times, at most; when absent 2 for scanning sonars, "
                "and a picture of every ping for others."},
          self.fan_rate);
  }
};

/// Parses the start of a run, an ISO 8601 time with zone: "2026-06-01T10:00:00Z", "2026-06-01T12:00:00.25+02:00".
/// @return  Time since 1970-01-01T00:00:00Z, below 2^31 s [ns].
/// @throws Error for anything else; the message begins with the text.
[[nodiscard]] std::uint64_t start_from_text(std::string_view text);

/// A start as text, in UTC: "2026-06-01T10:00:00.25Z".
[[nodiscard]] std::string start_text(std::uint64_t start_ns);

/// Framework of the messages. ROS 2 and ROS 1 have the same types, with different bytes and definitions.
enum class MessageForm { kRos2, kRos1, kGazebo };

/// Contents of a channel.
enum class MessageKind {
  kSonarImage,
  kFan,
  kPoints,
  kTruePoints,
  kPose,
  kTransforms,
  kScenario,
  kRaw,
  kLabels,
  kDescription,
  kScan,
  kRawImage,
  kDetections,
  kSoundings
};

/// Messages of one kind on one topic.
struct MessageChannel {
  MessageKind kind = MessageKind::kSonarImage;
  std::string topic;       ///< "/fls/points"; "/tf" and "/scenario" are the same for all sonars.
  std::string type;        ///< "sensor_msgs/msg/PointCloud2"; of ROS 1 "sensor_msgs/PointCloud2"; of Gazebo
                           ///< "gz.msgs.PointCloudPacked".
  std::string definition;  ///< Definition of the type and of all types in it, as MCAP's encodings "ros2msg" and
                           ///< "ros1msg" have it, and bags of ROS 1; of Gazebo empty.
  std::string md5 = {};    ///< Checksum of the definition by which ROS 1 knows the type; of others empty.
  bool latched = false;    ///< The same for all pings: sent once, and kept for those who read later.
};

/// A level of intensity mapped to the darkest and the brightest value of an image [dB].
struct MessageLevels {
  bool decibels = true;  ///< Whether values are decibels between the two; else linear from 0 to `high_db`.
  double low_db = 0, high_db = 0;
  double gain_per_decade = 0;  ///< Gain over range added before the mapping [dB/decade of range in m].
};

/// Encodes the pings of one sonar as ROS messages: for ROS 2 as CDR (XCDR1, little-endian, with its four-byte header),
/// for ROS 1 in the form of its topics and bags, with the ping's number as `header.seq`.
///
/// | Kind        | Topic              | Type                                         | Frame       |
/// | ----------- | ------------------ | -------------------------------------------- | ----------- |
/// | kSonarImage | /NAME/sonar_image  | marine_acoustic_msgs/msg/ProjectedSonarImage | NAME_beams  |
/// | kFan        | /NAME/fan          | sensor_msgs/msg/Image, rgb8                  | NAME        |
/// | kPoints     | /NAME/points       | sensor_msgs/msg/PointCloud2                  | NAME        |
/// | kTruePoints | /NAME/true_points  | sensor_msgs/msg/PointCloud2                  | NAME        |
/// | kPose       | /NAME/pose         | geometry_msgs/msg/PoseStamped                | world       |
/// | kTransforms | /tf                | tf2_msgs/msg/TFMessage                       |             |
/// | kScenario   | /scenario          | std_msgs/msg/String                          |             |
/// | kRaw        | /NAME/raw          | sensor_msgs/msg/Image, mono8 or mono16       | NAME        |
/// | kLabels     | /NAME/labels       | sensor_msgs/msg/Image, mono16                | NAME        |
/// | kDescription | /NAME/description | std_msgs/msg/String                          |             |
/// | kScan       | /NAME/scan         | sensor_msgs/msg/LaserScan                    | NAME        |
/// | kRawImage   | /NAME/raw_sonar_image | marine_acoustic_msgs/msg/RawSonarImage    | NAME_beams  |
/// | kDetections | /NAME/detections   | marine_acoustic_msgs/msg/SonarDetections     | NAME_swath  |
/// | kSoundings  | /NAME/soundings    | sensor_msgs/msg/PointCloud2                  | NAME        |
///
/// Points are in the middle of their beams, as a sonar knows them; true points at the elevations of the ground truth.
/// kRaw exists with MessageOptions::raw only: the values of the sonar image, row i its bin i, column 0 the beam
/// furthest to port. With MessageOptions::live, kLabels has Ping::instance in that layout; kDescription is a JSON
/// object with beams, bins, levels and the names of labels; kScan has the first returns of a scanning head's last turn,
/// or last sweep across its sector. kRawImage is that of a side-scan sonar, with the values of the sonar image.
/// kDetections and kSoundings are those of a multibeam: Ping::soundings by beams, and as points in the housing's frame.
/// NAME is MessageSource::name. Frame NAME is that of the housing (x forward, y to port, z up). NAME_beams, of the
/// sonar image, has z along the middle of the fan, y to port, x down; NAME_swath, of a multibeam alone and with
/// kDetections, x ahead, y to starboard, z along the middle of the swath. docs/reference/messages.md has every field.
///
/// In MessageForm::kGazebo they are gz.msgs.Image (kSonarImage, kFan, kRaw), PointCloudPacked (kPoints, kTruePoints,
/// kSoundings), Pose, Pose_V and StringMsg, as Protocol Buffers; ignition.msgs have the same bytes.
class SonarMessages {
 public:
  /// @throws Error for options out of limits, and for a multibeam without assumed_sound_speed, by which its ranges are
  ///         times.
  explicit SonarMessages(MessageSource source, MessageOptions options = {}, MessageForm form = MessageForm::kRos2);
  ~SonarMessages();
  SonarMessages(SonarMessages&&) noexcept;
  SonarMessages& operator=(SonarMessages&&) noexcept;

  /// In the order of MessageKind.
  [[nodiscard]] const std::vector<MessageChannel>& channels() const;

  /// The mapping of levels to values of images. Unless the options say otherwise: from -100 to -40 dB re the source's
  /// level at 1 m, with a gain of 30 dB per decade of range where the receiver applies none of its own
  /// (usual_display()); where the receiver has full_scale_db, the sonar's mapping_range_db up to it; in the paper's
  /// model linear, from 0 to 1.
  [[nodiscard]] MessageLevels levels() const;

  /// Sets the current ping, for encode(). The fan of a scanning sonar shows all pings of the head's last turn.
  /// @throws Error for a ping that does not have the sonar's beams and bins, and for a time below 0
  ///         or from 2^31 s on (counted from 1970 if there is a start), which a ROS time cannot
  ///         hold.
  void take(const Ping& ping) { take(ping, ping.time); }

  /// The same with the time of another clock.
  /// @param time  Of transmission, by that clock [s].
  void take(const Ping& ping, double time);

  /// Whether files hold this message of the current ping: they skip fan pictures beyond MessageOptions::fan_rate.
  /// Programs that send messages on request need to check kScan alone, which ends with a turn.
  /// @param channel  Index into channels().
  [[nodiscard]] bool is_due(std::size_t channel) const;

  /// The message of the current ping. Several threads may encode at once.
  /// @param channel  Index into channels().
  [[nodiscard]] std::vector<std::byte> encode(std::size_t channel) const;

  /// "286 of 64000 values of fls are above the highest level, -40 dB, and are clipped; the loudest has -30.4 dB", of
  /// all pings so far; "" if none is.
  [[nodiscard]] std::string cut_text() const;

  /// Time of the current ping, counted from 1970 if there is a start [ns].
  [[nodiscard]] std::uint64_t time_ns() const;

  /// The message of a latched kTransforms for several sonars: readers that come late get the last one only.
  /// @param sonars  Of one run, with the same form.
  [[nodiscard]] static std::vector<std::byte> mountings(const std::vector<SonarMessages>& sonars);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
