// recorded_pings.h -- reads pings from recordings (HDF5, MCAP) and grey pictures from PNG files.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/similarity.h"
#include "insonify/sonar_config.h"

namespace insonify {

/// The pings of one sonar. Of a file that is still being written, those that it had when it was opened. The format is
/// recognised by the file's first bytes:
///
/// - HDF5: any file with a numeric dataset `intensity` [ping, bin, beam] at its root, such as Recording writes;
/// - MCAP: a file that insonify has written (McapRecording), also an unfinished one. Its intensities are decoded from
/// the
///   sonar images: exact within half a step of their levels (0.0005 dB with 16 bits), 0 at and below the lowest level,
///   clipped at the highest. docs/reference/messages.md has the levels.
class RecordedPings {
 public:
  /// @param sonar  Name of the sonar; "" for the only one.
  /// @throws Error with the path for a missing file or one of another format, and for an unknown sonar, with the names
  ///         of those in the file.
  explicit RecordedPings(const std::filesystem::path& path, const std::string& sonar = "");
  ~RecordedPings();
  RecordedPings(RecordedPings&&) noexcept;
  RecordedPings& operator=(RecordedPings&&) noexcept;

  [[nodiscard]] std::uint64_t ping_count() const;
  [[nodiscard]] int bin_count() const;
  [[nodiscard]] int beam_count() const;

  /// Name of the sonar; "" if the file has none.
  [[nodiscard]] const std::string& sonar() const;

  /// Model of the echo: "calibrated", "paper", or "" if unknown.
  [[nodiscard]] const std::string& model() const;

  /// Intensity at full scale: for integer datasets the largest number of the type (255 for 8 bits), else 1.
  [[nodiscard]] double full_scale() const;

  /// The intensities of one ping as stored, bin_count() x beam_count().
  /// @param ping  Below ping_count().
  /// @throws Error with the path if the file cannot be read.
  [[nodiscard]] std::vector<double> intensity(std::uint64_t ping) const;

  /// The greatest count of the instrument, 2^bits - 1; 0 for a recording without counts (ReceiverConfig::counts).
  [[nodiscard]] double greatest_count() const;

  /// The counts of one ping, as intensity(); only if the recording has counts.
  [[nodiscard]] std::vector<double> counts(std::uint64_t ping) const;

  /// One ping for drawing: number, time, pose, head angle and intensities, without ground truth.
  /// @param ping  Below ping_count().
  /// @throws Error with the path if the file cannot be read, or has no times or poses.
  [[nodiscard]] Ping ping(std::uint64_t ping) const;

  /// The settings of the sonar and of its receiver in the recording. Missing ones have their
  /// defaults.
  /// @throws Error with the path if the file has no settings, or one of the wrong type.
  [[nodiscard]] SonarConfig sonar_config() const;
  [[nodiscard]] ReceiverConfig receiver_config() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a grey PNG of up to 16 bits, scaled to 0..1 and named by its path. Fewer than 8 bits and palettes are read as
/// 8 bits. Coloured pictures are refused, because the colour map that would turn them into levels is not in the file.
/// @throws Error with the path; for a coloured or transparent pixel with its place.
[[nodiscard]] GreyPicture load_grey_picture(const std::filesystem::path& path);

}  // namespace insonify
