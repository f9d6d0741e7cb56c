// compare_source.h -- one side of a comparison: a recording or a picture.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "insonify/picture.h"
#include "insonify/recorded_pings.h"

namespace insonify {

/// A recording, also one of an instrument, or a picture that is compared with every ping of the other side.
class CompareSource {
 public:
  /// @param path    A recording, a folder of recordings, a foreign recording, or a picture.
  /// @param sonar   Sonar whose recording is used of a folder or of a file with several; "" if there is only one.
  CompareSource(std::filesystem::path path, const std::string& sonar);

  /// Sets the mapping of intensities to levels from 0 to 1; full scale is relative to that of the recording. Must be
  /// called before picture() and scan().
  void set_levels(const Display& levels);

  /// Uses a recording's counts instead of its intensities; must be called before all below. A recording of integers has
  /// no others.
  /// @throws Error for a recording of neither.
  void use_counts();

  [[nodiscard]] std::string name() const { return path_.string(); }
  [[nodiscard]] std::string sonar() const { return recording_ ? recording_->sonar() : ""; }
  [[nodiscard]] bool is_calibrated() const { return recording_ && recording_->model() == "calibrated"; }
  [[nodiscard]] bool is_of_the_paper() const { return recording_ && recording_->model() == "paper"; }
  [[nodiscard]] bool is_recording() const { return recording_.has_value(); }
  /// Settings of a recording's sonar; absent if it has no readable ones or they are assumed, and for a picture.
  [[nodiscard]] std::optional<SonarConfig> sonar_config() const;
  /// Whether its levels are counts or grey levels, from 0 to full scale; else intensities.
  [[nodiscard]] bool has_counts() const { return !recording_ || counts_ || recording_->has_integers(); }
  /// Whether it has counts beside its intensities.
  [[nodiscard]] bool has_both() const { return recording_ && recording_->greatest_count() > 0; }
  /// The greatest number of its integers' type; 0 for intensities and pictures.
  [[nodiscard]] double greatest_integer() const {
    return recording_ && !counts_ && recording_->has_integers() ? recording_->full_scale() : 0;
  }
  /// RecordedPings::notes(), each after the name.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// Whether its pings are compared together: those of a single beam, and of both sides of a side-scan sonar.
  [[nodiscard]] bool is_scan() const { return recording_ && recording_->beam_count() <= 2; }
  [[nodiscard]] std::size_t beam_count() const {  ///< Only for a recording.
    return static_cast<std::size_t>(recording_->beam_count());
  }
  [[nodiscard]] std::uint64_t ping_count() const { return recording_->ping_count(); }  ///< Only for a recording.

  /// Largest intensity in some pings of a recording.
  [[nodiscard]] double loudest(const std::vector<std::uint64_t>& pings) const;

  /// Picture of one ping: rows are bins, columns are beams.
  [[nodiscard]] GreyPicture picture(std::uint64_t ping) const;

  /// Picture of pings of a single beam, or of two, side by side: all of port, then all of starboard.
  [[nodiscard]] GreyPicture scan(const std::vector<std::uint64_t>& pings) const;

 private:
  [[nodiscard]] std::vector<double> levels(std::uint64_t ping) const;
  [[nodiscard]] double full_scale() const;

  std::filesystem::path path_;
  Display levels_;
  bool counts_ = false;
  std::optional<RecordedPings> recording_;
  GreyPicture picture_;
};

}  // namespace insonify
