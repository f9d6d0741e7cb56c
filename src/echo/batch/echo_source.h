// echo_source.h -- interface of the sources of echoes that need no samples of the fan: points, edges, walks and others.

#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "echo/batch/ping_view.h"
#include "echo/grid/echo.h"
#include "echo/model/hit.h"
#include "insonify/geometry.h"
#include "insonify/ground_truth.h"

namespace insonify {

/// End of a line of sight: the first surface of `instance` at a distance of at least `from`, even if it transmits
/// sound.
struct SightEnd {
  double from = std::numeric_limits<double>::infinity();  ///< [m]
  std::uint16_t instance = kNoLabel;                      ///< kNoLabel: any.
};

/// Rays that one source wants to be traced for one ping; their indices are its own.
struct RayList {
  std::vector<Ray> rays;       ///< To the first surface, whether it transmits sound or not.
  std::vector<Ray> sights;     ///< Lines of sight between the sonar and something: they continue behind surfaces that
                               ///< transmit sound (see_through.h), down to a two-way transmittance of kLeastPassed.
  std::vector<SightEnd> ends;  ///< [sight]; empty: none has an end.

  void clear() {
    rays.clear();
    sights.clear();
    ends.clear();
  }
  [[nodiscard]] bool empty() const { return rays.empty() && sights.empty(); }
};

/// Hits of the rays of a RayList.
struct RayAnswers {
  const RayList& asked;
  std::span<const Hit> rays;        ///< [ray]
  std::span<const Hit> sights;      ///< [sight] The surface that blocks it or is its end.
  std::span<const double> through;  ///< [sight] See passed(); empty where nothing transmits sound.

  /// Product of the transmittances of the surfaces in front of a sight's hit, one way.
  [[nodiscard]] double passed(std::size_t sight) const { return through.empty() ? 1 : through[sight]; }

  /// Whether nothing blocks a line of sight, and it has not met its end.
  [[nodiscard]] bool is_clear(std::size_t sight) const { return !std::isfinite(sights[sight].distance); }
};

/// Finds echoes of one kind. A source says which rays it needs, and the rays of all sources of all pings of a batch are
/// traced together. Each ping of a batch has sources of its own, so an object may keep what it needs from one call to
/// the next; calls allocate nothing once its lists have grown.
class EchoSource {
 public:
  virtual ~EchoSource() = default;

  /// Begins a ping: adds the rays of the first round.
  virtual void ask(const PingView& view, Workers& workers, RayList& rays) = 0;

  /// Adds the echoes that the hits show, and the rays of the next round; a ping ends with a round in which no source
  /// adds rays. Called in every round, also when this source had asked for nothing in it; in the order of the sources,
  /// so that a source may rest on what one before it has found.
  virtual void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more,
                      EchoList& found) = 0;
};

}  // namespace insonify
