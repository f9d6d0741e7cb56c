// markers.h -- named points of the world that operators have marked: shared by all pages, and kept beside recordings.

#pragma once

#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "insonify/marker.h"

namespace insonify {

/// The markers of a session. All functions may be called from any thread.
class Markers {
 public:
  explicit Markers(std::vector<Marker> markers) : markers_(std::move(markers)) {}

  /// Replaces all markers by those of a message: {"markers": [{"name", "position": [x, y, z], "time", "sonar",
  /// "ping"}...]}, each perhaps with "range" and "side".
  /// @throws FormError for a member of the wrong type, Error for more than 1000 markers, a name of more than 200
  /// bytes, or a side other than port and starboard.
  void set(const nlohmann::json& message);

  [[nodiscard]] std::vector<Marker> all() const;
  /// The message {"op": "markers", "markers"}.
  [[nodiscard]] std::string text() const;

  /// Writes them as GeoJSON, in metres of the world, beside a recording: dive-markers.geojson for dive.yaml. Nothing
  /// without markers.
  /// @return  What to add to the note on the recording, "" without markers.
  [[nodiscard]] std::string write_beside(const std::filesystem::path& scenario) const;

 private:
  mutable std::mutex mutex_;
  std::vector<Marker> markers_;
};

}  // namespace insonify
