// recorded_pings.h -- what sonars have recorded, read back: pings of recordings, and grey pictures.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "insonify/similarity.h"

namespace insonify {

/// The intensities of a recording, as `Recording` writes it or as anyone may: an HDF5 file with numbers `intensity`
/// [ping, bin, beam] at its root. Also one that is still being written: the pings there were when it was opened.
class RecordedPings {
 public:
  /// @throws Error with the path for a file that is missing, no HDF5, or has no such dataset.
  explicit RecordedPings(const std::filesystem::path& path);
  ~RecordedPings();
  RecordedPings(RecordedPings&&) noexcept;
  RecordedPings& operator=(RecordedPings&&) noexcept;

  [[nodiscard]] std::uint64_t ping_count() const;
  [[nodiscard]] int bin_count() const;
  [[nodiscard]] int beam_count() const;

  /// Name of the sonar; "" where the file does not tell.
  [[nodiscard]] const std::string& sonar() const;

  /// Model of the echo: "calibrated", "paper", or "" where the file does not say.
  [[nodiscard]] const std::string& model() const;

  /// Intensity that stands for full scale: the largest number of the type where whole numbers are stored (255 for 8
  /// bits), else 1.
  [[nodiscard]] double full_scale() const;

  /// The intensities of one ping, as they are stored: bin_count() rows of beam_count() numbers.
  /// @param ping  Below ping_count().
  /// @throws Error with the path where the file cannot be read.
  [[nodiscard]] std::vector<double> intensity(std::uint64_t ping) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads a grey PNG of 8 or 16 bits (fewer bits and palettes count as 8), 0 to 1 over full scale, named by its path.
/// Coloured pictures are refused: how loud a colour is depends on a colour map that the file does not hold.
/// @throws Error with the path; for a coloured or transparent pixel with its place.
[[nodiscard]] GreyPicture load_grey_picture(const std::filesystem::path& path);

}  // namespace insonify
