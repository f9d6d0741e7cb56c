// sonar_messages.cpp -- makes the messages about one ping of one sonar.

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <utility>

#include "insonify/files.h"
#include "insonify/messages.h"
#include "insonify/printable.h"
#include "io/message/encode.h"
#include "io/message/head_scan.h"
#include "io/message/message_channels.h"
#include "io/message/message_display.h"
#include "io/message/ros_name.h"
#include "io/message/sonar_description.h"
#include "receiver/ping_table.h"

namespace insonify {
namespace {

constexpr double kTimeLimit = 2147483648.0;  // Limit of builtin_interfaces/Time, whose seconds are an int32 [s].

// Largest number of pings in the picture of a scanning head.
constexpr std::uint64_t kMostScanned = 4000;

// The frame of sonar images in that of the housing: z along the middle of the fan, y to port, x down. An azimuth of the
// message, atan2(-y, z), is positive to starboard, which readers draw to the right.
Pose housing_from_beams(const SonarConfig& sonar) {
  const double up = sonar.elevation_center;
  Eigen::Matrix3d axes;
  axes.col(0) = Vec3(std::sin(up), 0, -std::cos(up));
  axes.col(1) = Vec3(0, 1, 0);
  axes.col(2) = Vec3(std::cos(up), 0, std::sin(up));
  return {Vec3::Zero(), Eigen::Quaterniond(axes)};
}

// The frame of a multibeam's angles in that of the housing, whose x points down and whose z points ahead: x ahead, y to
// starboard, z down. An angle of the message is atan2(y, z) there.
Pose housing_from_swath() {
  Eigen::Matrix3d axes;
  axes.col(0) = Vec3::UnitZ();
  axes.col(1) = -Vec3::UnitY();
  axes.col(2) = Vec3::UnitX();
  return {Vec3::Zero(), Eigen::Quaterniond(axes)};
}

SonarImageFacts image_facts(const SonarConfig& sonar, double sound_speed) {
  SonarImageFacts facts;
  facts.frequency = static_cast<float>(sonar.frequency);
  facts.sound_speed = static_cast<float>(sound_speed);
  const BearingGrid beams = sonar.bearings();
  for (int beam = 0; beam < beams.count(); ++beam) {
    facts.transmit_widths.push_back(static_cast<float>(sonar.sent_elevation_aperture()));
    facts.receive_widths.push_back(static_cast<float>(sonar.azimuth_resolution.value_or(beams.width(beam))));
  }
  for (int bin = 0; bin < sonar.bin_count; ++bin) {
    facts.ranges.push_back(static_cast<float>(sonar.bin_range(bin)));
  }
  facts.directions.resize(static_cast<std::size_t>(sonar.beam_count));
  return facts;
}

// Soundings of a ping that has none are those of beams that found no bottom.
std::vector<Sounding> beam_soundings(const Ping& ping, const SonarConfig& sonar) {
  std::vector<Sounding> soundings = ping.soundings;
  soundings.resize(static_cast<std::size_t>(sonar.beam_count));
  for (int beam = 0; beam < sonar.beam_count; ++beam) {
    soundings[static_cast<std::size_t>(beam)].azimuth = static_cast<float>(sonar.beam_azimuth(beam));
  }
  return soundings;
}

template <typename Value>
std::vector<Value> values_of(const std::vector<float>& raised, const Display& display) {
  constexpr double kMost = std::numeric_limits<Value>::max();
  std::vector<Value> values(raised.size());
  for (std::size_t i = 0; i < raised.size(); ++i) {
    values[i] = static_cast<Value>(std::lround(kMost * shown_level(display, static_cast<double>(raised[i]))));
  }
  return values;
}

// The intensity above which a value counts as clipped: half a step above the brightest one. Below it, values are as
// exact as others, such as the brightest ones of a recording that is exported again.
double lowest_cut(const MessageLevels& levels, int bits) {
  const double half_step = 0.5 / (std::pow(2, bits) - 1);
  const double highest = std::pow(10, levels.high_db / 10);
  return levels.decibels ? highest * std::pow(10, half_step * (levels.high_db - levels.low_db) / 10)
                         : highest * (1 + half_step);
}

}  // namespace

struct SonarMessages::State {
  MessageSource source;
  MessageOptions options;
  MessageForm form;
  std::string name;
  std::vector<MessageChannel> channels;
  Display display;
  SonarImageFacts facts;

  Ping ping = {};    // Without tables that no message has; its intensities as received ...
  Ping raised = {};  // ... and with the gain over range.
  std::uint64_t time_ns = 0;
  std::uint64_t values = 0, cut = 0;        // Values of all pings, and those above the highest level.
  double loudest = 0;                       // Intensity, raised.
  std::deque<Ping> scanned = {};            // Pings of a scanning sonar's last turn, raised.
  std::optional<double> fan_interval = {};  // Interval of time, counted from time 0, of the last fan picture in a file.
  bool fan_is_due = true;                   // Whether the current ping has one.
  HeadScan head_scan = {};

  [[nodiscard]] MessageHeader header(const std::string& frame) const {
    return {time_ns, frame, static_cast<std::uint32_t>(ping.number)};
  }
  void look_for_fan();
  [[nodiscard]] std::vector<std::byte> sonar_image() const;
  [[nodiscard]] std::vector<std::byte> raw_image() const;
  [[nodiscard]] std::vector<std::byte> raw_sonar_image() const;
  [[nodiscard]] Picture fan() const;
  [[nodiscard]] std::vector<std::byte> points(bool true_elevations) const;
  [[nodiscard]] std::vector<FramePose> transforms() const;
  [[nodiscard]] std::vector<std::byte> labels() const;
  [[nodiscard]] std::vector<std::byte> scan() const;
  [[nodiscard]] std::vector<std::byte> detections() const;
};

std::vector<std::byte> SonarMessages::State::sonar_image() const {
  SonarImageFacts now = facts;
  const double down = source.sonar.is_side_scan() ? source.sonar.depression : 0;  // x of the message.
  for (int beam = 0; beam < source.sonar.beam_count; ++beam) {
    const double azimuth = source.sonar.beam_azimuth(beam) + ping.head_angle;
    now.directions[static_cast<std::size_t>(beam)] =
        Vec3(std::sin(down), std::cos(down) * std::sin(azimuth), std::cos(down) * std::cos(azimuth));
  }
  const MessageHeader head = header(name + "_beams");
  if (options.bits == 8) {
    return encode_sonar_image(form, head, now,
                              std::span<const std::uint8_t>(values_of<std::uint8_t>(raised.intensity, display)));
  }
  return encode_sonar_image(form, head, now,
                            std::span<const std::uint16_t>(values_of<std::uint16_t>(raised.intensity, display)));
}

// The sides of a side-scan sonar look across the track, port to negative angles.
std::vector<std::byte> SonarMessages::State::raw_sonar_image() const {
  const SonarConfig& sonar = source.sonar;
  const auto angle = static_cast<float>(std::numbers::pi / 2 - sonar.depression);
  const RawImageFacts raw{.sample_rate = static_cast<float>(facts.sound_speed / (2 * sonar.bin_length())),
                          .first_sample = static_cast<std::uint32_t>(std::lround(sonar.min_range / sonar.bin_length())),
                          .receive_angles = {-angle, angle}};
  const auto encode = [&]<typename Value>(Value) {
    return encode_raw_sonar_image(form, header(name + "_beams"), facts, raw,
                                  std::span<const Value>(values_of<Value>(raised.intensity, display)));
  };
  return options.bits == 8 ? encode(std::uint8_t{}) : encode(std::uint16_t{});
}

// A fan picture is due at the first ping of each interval of 1 / fan_rate.
void SonarMessages::State::look_for_fan() {
  const std::optional<double> rate = options.fan_rate_of(source.sonar);
  if (!rate) {
    return;
  }
  constexpr double kRounding = 1e-6;  // Rounding of times such as 3 * 0.1 [intervals].
  const double interval = std::floor(ping.time * *rate + kRounding);
  fan_is_due = *rate > 0 && fan_interval != interval;
  fan_interval = interval;
}

std::vector<std::byte> SonarMessages::State::raw_image() const {
  const auto width = static_cast<std::size_t>(source.sonar.beam_count);
  const auto encode = [&]<typename Value>(Value) {
    return encode_grey_image(form, header(name), width,
                             std::span<const Value>(values_of<Value>(raised.intensity, display)));
  };
  return options.bits == 8 ? encode(std::uint8_t{}) : encode(std::uint16_t{});
}

Picture SonarMessages::State::fan() const {
  ProductView view(source.sonar);
  for (const Ping& each : scanned) {
    view.add(each);
  }
  if (scanned.empty()) {
    view.add(raised);
  }
  return view.draw(display);
}

std::vector<std::byte> SonarMessages::State::points(bool true_elevations) const {
  return encode_cloud(
      form, header(name),
      cloud_of(strong_points(ping, raised.intensity, source.sonar, options.strong_share, true_elevations)));
}

std::vector<FramePose> SonarMessages::State::transforms() const {
  const FramePose beams{header(name), name + "_beams", housing_from_beams(source.sonar)};
  std::vector<FramePose> frames = {
      options.vehicle_frame.empty() ? FramePose{header(options.world_frame), name, ping.world_from_sonar}
                                    : FramePose{header(options.vehicle_frame), name, source.sonar.vehicle_from_sonar()},
      beams};
  if (source.sonar.is_multibeam() && form != MessageForm::kGazebo) {
    frames.push_back({header(name), name + "_swath", housing_from_swath()});
  }
  return frames;
}

// Without ground truth, no cell has a label.
std::vector<std::byte> SonarMessages::State::labels() const {
  std::vector<std::uint16_t> values = ping.instance;
  values.resize(ping.intensity.size(), kNoLabel);
  return encode_grey_image(form, header(name), static_cast<std::size_t>(source.sonar.beam_count), values);
}

std::vector<std::byte> SonarMessages::State::scan() const {
  const std::optional<HeadScan::Ended>& ended = head_scan.ended();
  assert(ended);
  return encode_scan(form, {ended->time_ns, name, static_cast<std::uint32_t>(ended->first_ping)}, ended->scan);
}

// Beams without a sounding have zeros and a flag.
std::vector<std::byte> SonarMessages::State::detections() const {
  constexpr std::uint8_t kGood = 0, kBad = 1;  // DETECT_OK, DETECT_BAD_SONAR
  DetectionFacts facts_now;
  for (const Sounding& sounding : ping.soundings) {
    const bool placed = is_placed(sounding);
    facts_now.flags.push_back(placed ? kGood : kBad);
    facts_now.travel_times.push_back(placed ? 2 * sounding.range / facts.sound_speed : 0);
    facts_now.intensities.push_back(placed ? decibels_of(sounding.intensity) : 0);
    facts_now.receive_angles.push_back(-sounding.azimuth);
  }
  return encode_detections(form, header(name + "_swath"), facts, facts_now);
}

SonarMessages::SonarMessages(MessageSource source, MessageOptions options, MessageForm form) {
  options.validate();
  const MessageLevels levels = message_levels(source, options);
  if (levels.decibels && !(levels.low_db < levels.high_db)) {
    throw Error("messages", "low_db",
                fmt::format(" = {:.6g} dB must be less than high_db = {:.6g} dB", levels.low_db, levels.high_db));
  }
  const Display display = message_display(source, options);
  display.validate();
  const std::string name = ros_name(source.name.empty() ? source.sonar.name : source.name);
  const double sound_speed = source.sonar.assumed_sound_speed.value_or(0);  // 0: unknown, as the .msg file says.
  if (source.sonar.is_multibeam() && !(sound_speed > 0)) {
    throw Error(fmt::format("messages of the multibeam {}: assumed_sound_speed is missing, by which ranges are times",
                            printable(source.sonar.name)));
  }
  SonarImageFacts facts = image_facts(source.sonar, sound_speed);
  std::vector<MessageChannel> channels = message_channels(name, form, options, source.sonar);
  state_ = std::make_unique<State>(
      State{std::move(source), std::move(options), form, name, std::move(channels), display, std::move(facts)});
}

SonarMessages::~SonarMessages() = default;
SonarMessages::SonarMessages(SonarMessages&&) noexcept = default;
SonarMessages& SonarMessages::operator=(SonarMessages&&) noexcept = default;

const std::vector<MessageChannel>& SonarMessages::channels() const {
  return state_->channels;
}

MessageLevels SonarMessages::levels() const {
  return message_levels(state_->source, state_->options);
}

void SonarMessages::take(const Ping& ping, double time) {
  const SonarConfig& sonar = state_->source.sonar;
  check_ping(ping, sonar);
  const std::uint64_t start_ns = state_->options.start_ns.value_or(0);
  if (!(time >= 0 && static_cast<double>(start_ns) * 1e-9 + time < kTimeLimit - 1)) {
    throw Error(
        fmt::format("ping {} of {}: time = {:.6g} s{} must be from 0 to below 2147483647 s{}, as ROS messages hold it",
                    ping.number, sonar.name, time, start_ns == 0 ? "" : " after " + start_text(start_ns),
                    start_ns == 0 ? "" : " after 1970-01-01T00:00:00Z"));
  }
  Ping& kept = state_->ping;
  kept.number = ping.number;
  kept.time = ping.time;
  kept.world_from_sonar = ping.world_from_sonar;
  kept.head_angle = ping.head_angle;
  kept.bin_count = ping.bin_count;
  kept.beam_count = ping.beam_count;
  kept.intensity = ping.intensity;
  kept.elevation = ping.elevation;
  if (state_->options.live) {
    kept.instance = ping.instance;
  }
  if (sonar.is_multibeam()) {
    kept.soundings = beam_soundings(ping, sonar);
  }
  state_->time_ns = start_ns + static_cast<std::uint64_t>(std::llround(time * 1e9));
  state_->look_for_fan();
  Ping bare = kept;
  bare.elevation.clear();
  bare.instance.clear();
  bare.soundings.clear();
  state_->raised = raised_by_range(std::move(bare), sonar, state_->display.raised_per_decade);
  const auto limit = static_cast<float>(lowest_cut(levels(), state_->options.bits));
  for (const float value : state_->raised.intensity) {
    if (value > limit) {
      ++state_->cut;
      state_->loudest = std::max(state_->loudest, static_cast<double>(value));
    }
  }
  state_->values += kept.intensity.size();
  if (state_->options.live && sonar.scans()) {
    state_->head_scan.add(kept, state_->raised, state_->time_ns, sonar, state_->display);
  }
  if (sonar.product() == Product::kLine) {
    state_->scanned.push_back(state_->raised);
    if (state_->scanned.size() > std::min(sonar.pings_per_turn(), kMostScanned)) {
      state_->scanned.pop_front();
    }
  }
}

bool SonarMessages::is_due(std::size_t channel) const {
  assert(channel < state_->channels.size());
  const MessageKind kind = state_->channels[channel].kind;
  return kind == MessageKind::kScan ? state_->head_scan.ended().has_value()
                                    : kind != MessageKind::kFan || state_->fan_is_due;
}

std::vector<std::byte> SonarMessages::encode(std::size_t channel) const {
  const State& state = *state_;
  assert(channel < state.channels.size());
  switch (state.channels[channel].kind) {
    case MessageKind::kSonarImage:
      return state.sonar_image();
    case MessageKind::kFan:
      return encode_image(state.form, state.header(state.name), state.fan());
    case MessageKind::kPoints:
      return state.points(false);
    case MessageKind::kTruePoints:
      return state.points(true);
    case MessageKind::kPose:
      return encode_pose(state.form, state.header(state.options.world_frame), state.ping.world_from_sonar);
    case MessageKind::kTransforms:
      return encode_transforms(state.form, state.transforms());
    case MessageKind::kRaw:
      return state.raw_image();
    case MessageKind::kLabels:
      return state.labels();
    case MessageKind::kDescription:
      return encode_text(state.form, sonar_description(state.source, state.options, state.name));
    case MessageKind::kScan:
      return state.scan();
    case MessageKind::kRawImage:
      return state.raw_sonar_image();
    case MessageKind::kDetections:
      return state.detections();
    case MessageKind::kSoundings:
      return encode_cloud(state.form, state.header(state.name), cloud_of(sounding_points(state.ping.soundings)));
    case MessageKind::kScenario:
      break;
  }
  return encode_text(state.form, state.source.scenario);
}

std::vector<std::byte> SonarMessages::mountings(const std::vector<SonarMessages>& sonars) {
  std::vector<FramePose> frames;
  for (const SonarMessages& each : sonars) {
    std::ranges::move(each.state_->transforms(), std::back_inserter(frames));
  }
  return encode_transforms(sonars.front().state_->form, frames);
}

std::string SonarMessages::cut_text() const {
  if (state_->cut == 0) {
    return "";
  }
  const MessageLevels highest = levels();
  const char* const unit = highest.decibels ? " dB" : "";
  return fmt::format(
      "{} of {} values of {} are above the highest level, {:.4g}{}, and are clipped; the loudest has {:.4g}{}",
      state_->cut, state_->values, printable(state_->source.sonar.name),
      highest.decibels ? highest.high_db : std::pow(10, highest.high_db / 10), unit,
      highest.decibels ? 10 * std::log10(state_->loudest) : state_->loudest, unit);
}

std::uint64_t SonarMessages::time_ns() const {
  return state_->time_ns;
}

}  // namespace insonify
