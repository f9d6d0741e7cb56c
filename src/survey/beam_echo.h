// beam_echo.h -- the echo of the bottom in one beam: its snippet, and its range by amplitude and by phase.

#pragma once

#include <optional>
#include <span>

namespace insonify {

/// A beam's row of bins. Ranges are counted in bins from the near edge of the first.
struct BeamRow {
  std::span<const float> intensity;
  std::span<const float> smoothed;  ///< Moving mean.
  std::span<const float> phase;     ///< [rad]; empty without.
  int resolution = 1;               ///< Bins that are one independent sample.
  int bridged = 0;                  ///< Longest fade of speckle within an echo [bins].
};

/// Bins of an echo, [begin, end).
struct Snippet {
  int begin = 0, end = 0;
};

/// Where the bottom is in a beam, and the standard deviation of that [bins].
struct BeamRange {
  double place = 0, deviation = 0;
};

/// The bottom in a beam.
struct BeamEcho {
  Snippet snippet;
  BeamRange range;
  bool by_phase = false;
};

/// The strongest echo inside a gate, by amplitude or by phase, whichever is less uncertain; none below `least`.
/// @param least    Of the smoothed intensity.
/// @param to_port  Whether the beam looks to port of straight down.
[[nodiscard]] std::optional<BeamEcho> find_echo(const BeamRow& row, const Snippet& gate, float least, bool to_port);

/// The bins around `peak` in which the smoothed intensity stays within 10 dB of its value there but for fades, inside
/// [first, last).
[[nodiscard]] Snippet snippet_around(const BeamRow& row, int peak, int first, int last);

/// Centre of the intensity in a snippet.
[[nodiscard]] BeamRange range_by_amplitude(const BeamRow& row, const Snippet& snippet);

/// Where a line through the phases of a snippet, weighted by intensity, crosses 0; none where the phases are too few,
/// or do not grow (shrink) with range as those of a beam to port (starboard) do.
/// @param to_port  Whether the beam looks to port of straight down.
[[nodiscard]] std::optional<BeamRange> range_by_phase(const BeamRow& row, const Snippet& snippet, bool to_port);

}  // namespace insonify
