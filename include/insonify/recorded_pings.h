// recorded_pings.h -- reads pings from recordings and from files of instruments, and grey pictures.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/ping.h"
#include "insonify/receiver_config.h"
#include "insonify/similarity.h"
#include "insonify/sonar_config.h"
#include "insonify/survey/geographic.h"

namespace insonify {

/// The pings of one sonar. Of a file that is still being written, those that it had when it was opened. The format is
/// recognised by the file's first bytes:
///
/// - HDF5: any file with a numeric dataset `intensity` [ping, bin, beam] at its root, such as Recording writes;
/// - MCAP: a file that insonify has written (McapRecording), also an unfinished one. Its intensities are decoded from
/// the
///   sonar images: exact within half a step of their levels (0.0005 dB with 16 bits), 0 at and below the lowest level,
///   clipped at the highest. docs/reference/messages.md has the levels;
/// - foreign_recordings(), and grey pictures as one ping each: docs/reference/foreign-files.md.
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

  /// Whether its intensities are counts, integers from 0 to full_scale(), as an instrument delivers them.
  [[nodiscard]] bool has_integers() const { return full_scale() > 1; }

  /// Name of a foreign format: "Oculus", "Ping360", "XTF", "NumPy", "picture"; "" for HDF5 and MCAP.
  [[nodiscard]] std::string foreign_format() const;

  /// Names of the sonars that a foreign file has, such as the sides of a side-scan; empty if it has one.
  [[nodiscard]] std::vector<std::string> sonars() const;

  /// What was chosen of a foreign file, or left out of it: "3 pings of other ranges ... left out".
  [[nodiscard]] std::vector<std::string> notes() const;

  /// What a foreign file does not say and its settings assume: "no sound speed in it, 1500 m/s is assumed".
  [[nodiscard]] std::vector<std::string> assumed() const;

  /// Altitude that the instrument has stored with a ping, as XTF does [m]; none without, and where it is 0.
  /// @throws Error with the path if the file cannot be read.
  [[nodiscard]] std::optional<double> altitude(std::uint64_t ping) const;

  /// Origin of the world on the Earth, of files that say it; the world's x is east, its y north.
  [[nodiscard]] std::optional<GeographicPoint> origin() const;

  /// The greatest count of the instrument, 2^bits - 1; 0 for a recording without counts (ReceiverConfig::counts).
  [[nodiscard]] double greatest_count() const;

  /// The counts of one ping, as intensity(); only if the recording has counts.
  [[nodiscard]] std::vector<double> counts(std::uint64_t ping) const;

  /// Whether it has soundings: recordings of multibeams have.
  [[nodiscard]] bool has_soundings() const;

  /// The bottom in each beam of a ping; empty without soundings.
  /// @throws Error with the path if the file cannot be read.
  [[nodiscard]] std::vector<Sounding> soundings(std::uint64_t ping) const;

  /// Pose of the sonar at a ping, Ping::world_from_sonar.
  /// @throws Error with the path if the file cannot be read, or has no poses.
  [[nodiscard]] Pose pose(std::uint64_t ping) const;

  /// One ping for drawing: number, time, pose, head angle, intensities and soundings, without ground truth.
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

/// Endings of the files of instruments and other programs that RecordedPings reads: ".raw, .oculus, .bin, .xtf ...".
[[nodiscard]] std::string foreign_recordings();

/// Whether a file is one of those, by its first bytes or else by its ending.
[[nodiscard]] bool is_foreign_recording(const std::filesystem::path& path);

/// Endings of the pictures that load_grey_picture() reads.
inline constexpr std::string_view kPictureEndings = ".png, .jpg, .jpeg, .pgm";

/// Whether a file is one of those, by its ending or its first bytes.
[[nodiscard]] bool is_picture(const std::filesystem::path& path);

/// Reads a grey picture, scaled to 0..1 and named by its path: PNG of up to 16 bits (fewer than 8 bits and palettes are
/// read as 8 bits), JPEG, PGM with any greatest level. Coloured pictures are refused, because the colour map that would
/// turn them into levels is not in the file.
/// @throws Error with the path; for a coloured or transparent pixel with its place.
[[nodiscard]] GreyPicture load_grey_picture(const std::filesystem::path& path);

}  // namespace insonify
