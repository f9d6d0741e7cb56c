// ping_sink.h -- what takes the pings of a run one after another: recordings of any format.

#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "insonify/marker.h"
#include "insonify/ping.h"

namespace insonify {

/// Receives the pings of one or several sonars. recording_formats() lists the sinks that are files.
class PingSink {
 public:
  virtual ~PingSink() = default;

  /// @param sonar  Index into the sonars that the sink was made for.
  /// @throws Error when the disk is full; what was written before stays readable.
  virtual void add(std::size_t sonar, const Ping& ping) = 0;

  /// Markers that close() adds, in place of earlier ones; pictures and videos have none.
  virtual void mark(const std::vector<Marker>& /*markers*/) {}

  /// Puts everything in place; nothing more can be added.
  /// @throws Error when the system could not.
  virtual void close() = 0;

  /// Where the pings are now: under the sink's own name, or beside it until it replaces an earlier file.
  [[nodiscard]] virtual const std::filesystem::path& place() const = 0;

 protected:
  PingSink() = default;
  PingSink(const PingSink&) = default;
  PingSink(PingSink&&) = default;
  PingSink& operator=(const PingSink&) = default;
  PingSink& operator=(PingSink&&) = default;
};

}  // namespace insonify
