// foreign_bytes.h -- files of instruments as their formats lay them out, written without the code that reads them.

#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/recorded_pings.h"
#include "support/message_of.h"
#include "support/test_files.h"
#include "support/working_folder.h"

namespace insonify {

/// Numbers as they lie in memory: little-endian.
template <typename... Numbers>
std::string little(Numbers... numbers) {
  return (bytes_of(numbers) + ...);
}

/// Most significant byte first, as Qt writes.
inline std::string big(std::uint32_t number) {
  std::string bytes = bytes_of(number);
  return {bytes.rbegin(), bytes.rend()};
}

inline std::string padded(std::string text, std::size_t size) {
  text.resize(size, '\0');
  return text;
}

// ---------------------------------------------------------------- Oculus

struct OculusBytes {
  std::uint8_t flags = 0x19, pixel_type = 0;  // Range in metres, simple return, gain assist; 8 bits.
  std::uint16_t rows = 3, beams = 2;
  std::vector<std::int16_t> bearings = {-1000, 1000};  // [0.01 deg]
  std::string image = std::string("\x01\x02\x03\x04\x05\xff", 6);
  double resolution = 0.5;
  std::uint32_t microseconds = 2'000'000;
  std::uint16_t version = 0, id = 0x23;
};

/// A simple ping result in the layout of liboculus (BSD-3-Clause), with 10 bytes between bearings and image.
inline std::string oculus_message(const OculusBytes& ping) {
  const bool second = ping.version == 2;
  std::string body;
  body += little(std::uint8_t{2}, std::uint8_t{0}, std::uint8_t{255}, std::uint8_t{127}, ping.flags, 2.0, 50.0, 1480.0,
                 0.0);
  if (second) {
    body += padded("", 36);  // More flags, and reserved.
  }
  body += little(std::uint32_t{7}, std::uint32_t{0}, 2.1e6, 12.0, 1.5);
  if (second) {
    body += little(10.0, 20.0, 30.0);  // Heading, pitch, roll.
  }
  body += little(1490.0);
  body += second ? little(ping.microseconds / 1e6) : little(ping.microseconds);
  body += little(ping.pixel_type, ping.resolution, ping.rows, ping.beams);
  if (second) {
    body += padded("", 16);
  }
  const std::size_t head = 16 + body.size() + 12;
  const std::size_t offset = head + 2 * ping.bearings.size() + 10;
  const std::size_t size = offset + ping.image.size();
  body += little(static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(ping.image.size()),
                 static_cast<std::uint32_t>(size));
  for (const std::int16_t bearing : ping.bearings) {
    body += little(bearing);
  }
  body += padded("", 10) + ping.image;
  return "SO" +
         little(std::uint16_t{7892}, std::uint16_t{0}, ping.id, ping.version, static_cast<std::uint32_t>(size - 16),
                std::uint16_t{0}) +
         body;
}

// ---------------------------------------------------------------- Ping360

/// A frame of the ping protocol.
inline std::string ping_frame(std::uint16_t id, const std::string& payload) {
  const std::string frame =
      "BR" + little(static_cast<std::uint16_t>(payload.size()), id, std::uint8_t{2}, std::uint8_t{0}) + payload;
  const unsigned sum = std::accumulate(frame.begin(), frame.end(), 0U, [](unsigned total, char byte) {
    return total + static_cast<unsigned char>(byte);
  });
  return frame + little(static_cast<std::uint16_t>(sum));
}

/// device_data of 750 kHz with 100 ticks a sample.
inline std::string ping360_profile(std::uint16_t angle, const std::string& samples, std::uint16_t period = 100) {
  const auto count = static_cast<std::uint16_t>(samples.size());
  return ping_frame(2300, little(std::uint8_t{1}, std::uint8_t{1}, angle, std::uint16_t{32}, period, std::uint16_t{750},
                                 count, count) +
                              samples);
}

/// auto_device_data.
inline std::string ping360_auto_profile(std::uint16_t angle, const std::string& samples) {
  const auto count = static_cast<std::uint16_t>(samples.size());
  return ping_frame(
      2301, little(std::uint8_t{1}, std::uint8_t{1}, angle, std::uint16_t{32}, std::uint16_t{100}, std::uint16_t{750},
                   std::uint16_t{0}, std::uint16_t{399}, std::uint8_t{1}, std::uint8_t{0}, count, count) +
                samples);
}

/// A text with its length; on Windows each letter has two bytes.
inline std::string qt_text(const std::string& text, bool windows = false) {
  std::string letters;
  for (const char letter : text) {
    letters += windows ? std::string{'\0', letter} : std::string(1, letter);
  }
  return big(static_cast<std::uint32_t>(letters.size())) + letters;
}

/// A log of Ping Viewer: messages at 12:00:00.000, 12:00:00.250 ...
inline std::string ping_viewer_log(const std::vector<std::string>& messages, bool windows = false) {
  std::string log = qt_text("PingViewer sensor log file", windows) + big(1);
  for (const char* about : {"b0461486", "2020-01-03", "v2.4", "Arch Linux", "unknown"}) {
    log += qt_text(about, windows);
  }
  log += big(1) + big(2);
  int milliseconds = 0;
  for (const std::string& message : messages) {
    log += qt_text(fmt::format("12:00:{:02}.{:03}", milliseconds / 1000, milliseconds % 1000), windows) +
           big(static_cast<std::uint32_t>(message.size())) + message;
    milliseconds += 250;
  }
  return log;
}

// ---------------------------------------------------------------- XTF

struct XtfBytes {
  std::uint16_t sample_bytes = 2;
  std::uint8_t sample_format = 0;
  std::string port, starboard;  // Samples.
  std::uint32_t samples = 3;
  float range = 30;
  std::uint8_t second = 5;
  std::array<double, 7> fix = {};  // y, x, depth, altitude, pitch, roll, heading.
  float sound_velocity = 0;
};

inline std::string xtf_header(const XtfBytes& file) {
  std::string header = padded("{\x01pyxtf", 256);
  for (const char type : {1, 2}) {
    std::string channel =
        padded(std::string{type, char(type - 1)} + little(std::uint16_t{0}, std::uint16_t{1}, file.sample_bytes), 128);
    channel[74] = static_cast<char>(file.sample_format);
    header += channel;
  }
  return padded(header, 1024);
}

inline std::string xtf_packet(const XtfBytes& ping) {
  const auto channel = [&](std::uint16_t number, const std::string& samples) {
    std::string head = padded(little(number, std::uint16_t{0}, ping.range), 26) + little(std::uint16_t{600});
    return padded(padded(head, 42) + little(ping.samples), 64) + samples;
  };
  const std::string body = channel(0, ping.port) + channel(1, ping.starboard);
  const std::string head = little(std::uint16_t{0xface}, std::uint8_t{0}, std::uint8_t{0}, std::uint16_t{2},
                                  std::uint32_t{0}, static_cast<std::uint32_t>(256 + body.size())) +
                           little(std::uint16_t{2013}, std::uint8_t{9}, std::uint8_t{10}, std::uint8_t{21},
                                  std::uint8_t{13}, ping.second, std::uint8_t{50});
  const auto& fix = ping.fix;
  const auto word = [&](int i) { return static_cast<float>(fix[i]); };
  const std::string place = padded(padded(head, 32) + little(ping.sound_velocity), 160) + little(fix[0], fix[1]);
  return padded(padded(place, 192) + little(word(2), word(3), 0.0F, word(4), word(5), word(6)), 256) + body;
}

// ---------------------------------------------------------------- What is read

/// A whole file.
inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What opening a recording says.
inline std::string opening(const std::string& path, const std::string& sonar = "") {
  return message_of([&] { static_cast<void>(RecordedPings(path, sonar)); });
}

}  // namespace insonify
