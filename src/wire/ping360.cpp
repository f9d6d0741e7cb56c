// ping360.cpp -- the messages of a Ping360. Ids, fields and limits are those of the published ping protocol.

#include "insonify/wire/ping360.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "insonify/field.h"
#include "wire/little_endian.h"

namespace insonify {
namespace {

enum Message : std::uint16_t {
  kAck = 1,
  kNack = kPingNack,
  kDeviceInformation = 4,
  kProtocolVersion = 5,
  kGeneralRequest = 6,
  kSetDeviceId = 100,
  kDeviceId = 2000,
  kDeviceData = 2300,
  kAutoDeviceData = 2301,
  kReset = 2600,
  kTransducer = 2601,
  kAutoTransmit = 2602,
  kMotorOff = 2903,
};

constexpr std::uint8_t kAnyDevice = 255;
constexpr std::uint8_t kPing360Type = 2;  // "device_type" of device_information.

// Bytes of the payload of a command.
constexpr std::size_t kTransducerSize = 14, kAutoTransmitSize = 16;

// @return  "" or what is wrong with a value.
std::string out_of(const char* name, int value, int least, int most) {
  return value < least || value > most ? fmt::format("{} = {} must be from {} to {}", name, value, least, most) : "";
}

// @return  "" or the first of the settings that is wrong.
std::string wrong_setting(const Ping360Settings& settings) {
  for (std::string wrong :
       {out_of("gain_setting", settings.gain_setting, 0, 2), out_of("angle", settings.angle, 0, kGradiansPerTurn - 1),
        out_of("transmit_duration", settings.transmit_duration, 1, 1000),
        out_of("sample_period", settings.sample_period, 80, 40000),
        out_of("transmit_frequency", settings.transmit_frequency, 500, 1000),
        out_of("number_of_samples", settings.sample_count, 200, 1200)}) {
    if (!wrong.empty()) {
      return wrong;
    }
  }
  return "";
}

std::string wrong_sector(const Ping360Sector& sector) {
  for (std::string wrong : {out_of("start_angle", sector.start_angle, 0, kGradiansPerTurn - 1),
                            out_of("stop_angle", sector.stop_angle, 0, kGradiansPerTurn - 1),
                            out_of("num_steps", sector.step, 1, 10), out_of("delay", sector.delay, 0, 100)}) {
    if (!wrong.empty()) {
      return wrong;
    }
  }
  return "";
}

std::string wrong_length(const PingFrame& frame, std::size_t bytes) {
  return fmt::format("payload has {} bytes, must have {}", frame.payload.size(), bytes);
}

}  // namespace

std::string ping360_introduction(const std::array<std::uint8_t, 4>& address) {
  // The MAC address is one for local use: it belongs to no maker.
  return fmt::format(
      "SONAR PING360\r\nBlue Robotics\r\nMAC Address:- 02-00-00-00-00-01\r\n"
      "IP Address:- {:03}.{:03}.{:03}.{:03}\r\n",
      address[0], address[1], address[2], address[3]);
}

double ping360_turn_time(int from, int to) {
  const int turned = std::abs(to - from);
  return kPing360StepTime * std::min(turned, kGradiansPerTurn - turned);
}

std::uint16_t Ping360Sector::angle_at(std::uint64_t ping) const {
  const int width = (stop_angle - start_angle + kGradiansPerTurn) % kGradiansPerTurn;
  if (width + step >= kGradiansPerTurn) {
    return static_cast<std::uint16_t>((start_angle + ping % kGradiansPerTurn * step) % kGradiansPerTurn);
  }
  const std::uint64_t steps = static_cast<std::uint64_t>(width / step);
  if (steps == 0) {
    return start_angle;
  }
  const std::uint64_t phase = ping % (width > kGradiansPerTurn / 2 ? steps + 1 : 2 * steps);
  const std::uint64_t taken = phase > steps ? 2 * steps - phase : phase;
  return static_cast<std::uint16_t>((start_angle + taken * step) % kGradiansPerTurn);
}

PingFrame Ping360::frame(std::uint16_t id, std::vector<std::uint8_t> payload) const {
  return {.id = id, .source = device_, .destination = 0, .payload = std::move(payload)};
}

PingFrame Ping360::refusal(std::uint16_t id, std::string_view reason) const {
  std::vector<std::uint8_t> payload;
  put(payload, id);
  payload.insert(payload.end(), reason.begin(), reason.end());
  return frame(kNack, std::move(payload));
}

Ping360Answer Ping360::refused(std::uint16_t id, std::string_view reason) const {
  return {.frames = {refusal(id, reason)}};
}

Ping360Answer Ping360::accepted(std::uint16_t id) const {
  std::vector<std::uint8_t> payload;
  put(payload, id);
  return {.frames = {frame(kAck, std::move(payload))}};
}

PingFrame Ping360::data(std::span<const std::uint8_t> samples) const {
  std::vector<std::uint8_t> payload;
  put(payload, settings_.mode, settings_.gain_setting, settings_.angle, settings_.transmit_duration,
      settings_.sample_period, settings_.transmit_frequency);
  if (sector_) {
    put(payload, sector_->start_angle, sector_->stop_angle, sector_->step, sector_->delay);
  }
  put(payload, settings_.sample_count, static_cast<std::uint16_t>(samples.size()));
  payload.insert(payload.end(), samples.begin(), samples.end());
  return frame(sector_ ? kAutoDeviceData : kDeviceData, std::move(payload));
}

void Ping360::turn_to(std::uint64_t ping) {
  settings_.angle = sector_->angle_at(ping);
}

Ping360Answer Ping360::requested(std::uint16_t id) const {
  switch (id) {
    case kDeviceInformation:  // Revision 0, firmware 3.3.8.
      return {.frames = {frame(id, {kPing360Type, 0, 3, 3, 8, 0})}};
    case kProtocolVersion:
      return {.frames = {frame(id, {1, 0, 0, 0})}};
    case kDeviceId:
      return {.frames = {frame(id, {device_, 0})}};
    case kDeviceData: {  // Also during another client's scan: drivers request it first.
      Ping360 still = *this;
      still.stop();
      return {.frames = {still.data({})}};
    }
    case kAutoDeviceData:
      return sector_ ? Ping360Answer{.frames = {data({})}} : refused(id, "the sonar is not scanning");
    default:
      return refused(id, "unknown message");
  }
}

Ping360Answer Ping360::set_device(const PingFrame& frame) {
  const std::size_t bytes = frame.id == kDeviceId ? 2 : 1;
  if (frame.payload.size() != bytes) {
    return refused(frame.id, wrong_length(frame, bytes));
  }
  if (const std::string wrong = out_of("id", frame.payload[0], 1, kAnyDevice - 1); !wrong.empty()) {
    return refused(frame.id, wrong);
  }
  device_ = frame.payload[0];
  return accepted(frame.id);
}

Ping360Answer Ping360::set_transducer(const PingFrame& frame) {
  if (frame.payload.size() != kTransducerSize) {
    return refused(frame.id, wrong_length(frame, kTransducerSize));
  }
  PacketReader reader(frame.payload);
  Ping360Settings settings;
  std::uint8_t transmit = 0;
  reader.get(settings.mode, settings.gain_setting, settings.angle, settings.transmit_duration, settings.sample_period,
             settings.transmit_frequency, settings.sample_count, transmit);
  std::string wrong = wrong_setting(settings);
  if (wrong.empty()) {
    wrong = out_of("transmit", transmit, 0, 1);
  }
  if (!wrong.empty()) {
    return refused(frame.id, wrong);
  }
  Ping360Answer answer{.transmit = transmit != 0, .scan_changed = sector_.has_value()};
  settings_ = settings;
  sector_.reset();
  if (!answer.transmit) {
    answer.frames.push_back(data({}));
  }
  return answer;
}

Ping360Answer Ping360::start_scan(const PingFrame& frame) {
  if (frame.payload.size() != kAutoTransmitSize) {
    return refused(frame.id, wrong_length(frame, kAutoTransmitSize));
  }
  PacketReader reader(frame.payload);
  Ping360Settings settings;
  Ping360Sector sector;
  reader.get(settings.mode, settings.gain_setting, settings.transmit_duration, settings.sample_period,
             settings.transmit_frequency, settings.sample_count, sector.start_angle, sector.stop_angle, sector.step,
             sector.delay);
  std::string wrong = wrong_setting(settings);
  if (wrong.empty()) {
    wrong = wrong_sector(sector);
  }
  if (!wrong.empty()) {
    return refused(frame.id, wrong);
  }
  settings_ = settings;
  sector_ = sector;
  turn_to(0);
  return {.scan_changed = true};
}

Ping360Answer Ping360::take(const PingFrame& frame) {
  if (frame.destination != 0 && frame.destination != kAnyDevice && frame.destination != device_) {
    return {};
  }
  switch (frame.id) {
    case kGeneralRequest: {
      if (frame.payload.size() != 2) {
        return refused(frame.id, wrong_length(frame, 2));
      }
      return requested(static_cast<std::uint16_t>(frame.payload[0] | frame.payload[1] << 8));
    }
    case kSetDeviceId:
      return set_device(frame);
    case kDeviceId:
      return frame.payload.empty() ? requested(frame.id) : set_device(frame);
    case kTransducer:
      return set_transducer(frame);
    case kAutoTransmit:
      return start_scan(frame);
    case kMotorOff: {
      Ping360Answer answer = accepted(frame.id);
      answer.scan_changed = sector_.has_value();
      stop();
      return answer;
    }
    case kReset: {  // The instrument is silent until it is called again; here that is at once.
      if (frame.payload.size() != 2) {
        return refused(frame.id, wrong_length(frame, 2));
      }
      const bool scanned = sector_.has_value();
      *this = Ping360();
      return {.scan_changed = scanned};
    }
    case kDeviceInformation:
    case kProtocolVersion:
    case kDeviceData:
    case kAutoDeviceData:
      return frame.payload.empty() ? requested(frame.id) : refused(frame.id, wrong_length(frame, 0));
    case kAck:
    case kNack:
      return {};  // Answers are not answered: two instruments on one line would never stop.
    default:
      return refused(frame.id, "unknown message");
  }
}

Ping360Answer Ping360::take(const PingEvent& event) {
  switch (event.kind) {
    case PingEvent::Kind::kFrame:
      return take(event.frame);
    case PingEvent::Kind::kDamaged:
      return refused(event.frame.id, event.reason);
    case PingEvent::Kind::kBreak:
      break;
  }
  Ping360Answer answer{.scan_changed = sector_.has_value()};
  stop();
  return answer;
}

}  // namespace insonify
