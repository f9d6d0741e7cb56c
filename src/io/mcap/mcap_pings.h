// mcap_pings.h -- the pings of one sonar, read back from the sonar images and poses of an MCAP recording.

#pragma once

#include <filesystem>

#include "insonify/messages.h"
#include "insonify/ping.h"
#include "io/mcap/mcap_reader.h"

namespace insonify {

/// Pings of an MCAP recording made by insonify, also of an unfinished one. Intensities are decoded from the sonar
/// images: exact within half a step of the mapping (0.0005 dB with 16 bits), 0 at and below its lowest level, clipped
/// at the highest. Soundings of a multibeam are exact to the rounding of single-precision numbers. There is no ground
/// truth.
class McapPings {
 public:
  /// @param sonar  Its name; "" for the only one.
  /// @throws Error with the path for a file that is missing, not MCAP or not made by insonify; for an unknown sonar,
  /// with the names of those in the file.
  explicit McapPings(const std::filesystem::path& path, const std::string& sonar = "");

  [[nodiscard]] std::uint64_t ping_count() const { return count_; }
  [[nodiscard]] int bin_count() const { return source_.sonar.bin_count; }
  [[nodiscard]] int beam_count() const { return source_.sonar.beam_count; }
  [[nodiscard]] const std::string& sonar() const { return source_.sonar.name; }
  [[nodiscard]] const std::string& model() const { return model_; }
  /// @throws Error with the path for a message or a chunk that is damaged.
  [[nodiscard]] Ping ping(std::uint64_t ping) const;
  [[nodiscard]] SonarConfig sonar_config() const { return source_.sonar; }

  [[nodiscard]] const McapReader& file() const { return file_; }
  /// Sonar, receiver and model; `name` is that of its topics.
  [[nodiscard]] const MessageSource& source() const { return source_; }
  [[nodiscard]] const MessageLevels& levels() const { return levels_; }
  /// Bits per value in the first ping; 16 if there is none.
  [[nodiscard]] int bits() const;
  /// Time of transmission after the run's start, without reading messages [s].
  [[nodiscard]] double time(std::uint64_t ping) const;
  [[nodiscard]] Pose world_from_sonar(std::uint64_t ping) const;

  /// Whether the file has soundings: those of multibeams, but not of versions before they were in messages.
  [[nodiscard]] bool has_soundings() const { return soundings_ != nullptr; }
  /// One per beam; empty without soundings.
  [[nodiscard]] std::vector<Sounding> soundings(std::uint64_t ping) const;

 private:
  [[nodiscard]] std::vector<std::byte> image(std::uint64_t ping) const;
  [[nodiscard]] const std::vector<double>& intensities_of(int bits) const;
  [[noreturn]] void fail(std::uint64_t ping, const std::string& what) const;

  std::filesystem::path path_;
  McapReader file_;
  MessageSource source_;
  std::string model_;
  std::uint64_t start_ns_ = 0;  // Time 0 of the pings, since 1970.
  MessageLevels levels_;
  const std::vector<McapReader::Entry>*images_ = nullptr, *poses_ = nullptr, *soundings_ = nullptr;
  std::uint64_t count_ = 0;
  std::vector<double> factors_;                      // Inverse of the gain, per bin.
  mutable std::vector<double> of_bytes_, of_words_;  // Intensities by value, with the gain; made on demand.
};

/// Time 0 of a file's pings, since 1970-01-01T00:00:00Z [ns]; absent if its run had no start.
/// @throws Error with the path for invalid metadata.
[[nodiscard]] std::optional<std::uint64_t> mcap_start_ns(const McapReader& file, const std::filesystem::path& path);

/// Names of the sonars that an MCAP recording holds.
/// @throws Error with the path for a file not made by insonify.
[[nodiscard]] std::vector<std::string> mcap_sonars(const McapReader& file, const std::filesystem::path& path);

}  // namespace insonify
