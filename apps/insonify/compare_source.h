// compare_source.h -- one of the two things that are compared: a recording or a picture.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/recorded_pings.h"

namespace insonify {

/// A recording, or a picture that stands for every ping.
class CompareSource {
 public:
  /// @param path    A recording, a folder of recordings, or a picture.
  /// @param sonar   Which recording of a folder; "" where there is one.
  CompareSource(std::filesystem::path path, const std::string& sonar);

  /// How intensities become levels from 0 to 1; full scale is relative to that of the recording. Before picture() and
  /// scan().
  void set_levels(const Display& levels);

  [[nodiscard]] std::string name() const { return path_.string(); }
  [[nodiscard]] std::string sonar() const { return recording_ ? recording_->sonar() : ""; }
  [[nodiscard]] bool is_calibrated() const { return recording_ && recording_->model() == "calibrated"; }
  [[nodiscard]] bool is_recording() const { return recording_.has_value(); }
  [[nodiscard]] bool is_scan() const { return recording_ && recording_->beam_count() == 1; }
  [[nodiscard]] std::uint64_t ping_count() const { return recording_->ping_count(); }  ///< Of a recording.

  /// Greatest intensity of some pings of a recording.
  [[nodiscard]] double loudest(const std::vector<std::uint64_t>& pings) const;

  /// One ping: bins down, beams across.
  [[nodiscard]] GreyPicture picture(std::uint64_t ping) const;

  /// Pings of one beam side by side.
  [[nodiscard]] GreyPicture scan(const std::vector<std::uint64_t>& pings) const;

 private:
  void check_sonar(const std::string& sonar) const;
  [[nodiscard]] std::vector<double> levels(std::uint64_t ping) const;

  std::filesystem::path path_;
  Display levels_;
  std::optional<RecordedPings> recording_;
  GreyPicture picture_;
};

}  // namespace insonify
