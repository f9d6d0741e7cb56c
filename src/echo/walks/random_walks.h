// random_walks.h -- reverberation of closed spaces: echoes of paths over many surfaces, by random walks.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/batch/echo_source.h"
#include "echo/model/hit.h"
#include "echo/walks/surface_law.h"
#include "echo/walks/walk_draws.h"

namespace insonify {

/// Echoes of the paths over two and more surfaces that primary and secondary echoes do not cover. Calibrated model
/// only. The order of an echo is the number of surfaces, at most kPathOrders.
///
/// A walk starts at the sonar, at a bearing that is fixed in the world. At each surface the next direction is drawn by
/// SurfaceLaw. From the second surface on, each surface is also connected to the sonar, and the echo of this leg is
/// added to the grid if nothing blocks it. The expected value of the grid is the integral over all paths:
/// docs/concepts/random-walks.md. Walks depend on the seed and on where everything is, not on threads or
/// engine, nor on the ping, but that waves on the water's surface reflect differently in each.
///
/// All bearings of the full circle, in equal steps, have one walk each, and a ping takes those that its beams send to:
/// one that turns has most of its walks in common with those before it. A two-way array sends to all cells, with its
/// one-way gain there; where that is low, every second, fourth ... walk is taken, with so much more weight.
///
/// Few surfaces lie in the one beam of a two-way array, so that few legs back to the sonar are received. Each of its
/// surfaces is therefore also connected to the sonar over the first surface of another walk, its partner, which lies in
/// the beam: bidirectional path tracing (Veach 1997, ch. 10). A path that both ways find is weighted in each by the
/// probability with which it is found, relative to that of both (his balance heuristic, section 9.2.2).
///
/// Echoes are labelled with the middle of the elevation aperture, not with the elevation that they arrive from: they
/// are sums of many paths, whose speckle depends on bearing and range alone and is the same in all directions of a head
/// that have it in their beam.
///
/// A bounce is diffuse (D) or mirrored (M), so that a path is a word of these letters. Each word is counted exactly
/// once:
///
///     one surface      primary echoes
///     MD, DM, MM       secondary echoes of order 2
///     M X M            secondary echoes of order 3, if both M are the same mirror; X is D or M
///     MMM              CornerEchoes, for the coherent share of three perpendicular mirrors
///     M D M            secondary echoes of order 3, for the coherent share of the water's surface as one M
///     all others       here: DD; three surfaces unless M X M by one mirror; four surfaces and more
class RandomWalks final : public EchoSource {
 public:
  /// Paths that other echoes include, which walks must leave out.
  struct Elsewhere {
    bool corners = false;             ///< Whether CornerEchoes adds coherent echoes of three perpendicular mirrors.
    SurfaceLabel water = kNoSurface;  ///< The water's surface, if secondary echoes include its coherent share of M D M.
  };

  struct Settings {
    int count = 0;                ///< Walks per ping, about, > 0.
    std::vector<int> beams = {};  ///< The plan's beams that walks start in: those of the sonar, without guard cells.
                                  ///< Of a two-way array all.
    std::uint64_t seed = 1;
    Elsewhere elsewhere = {};
    SurfaceLabel waves = kNoSurface;  ///< The water's surface, if it has waves.
  };
  explicit RandomWalks(const Settings& settings);

  void ask(const PingView& view, Workers& workers, RayList& rays) override;
  void answer(const PingView& view, const RayAnswers& hits, Workers& workers, RayList& more, EchoList& found) override;

 private:
  // State of a walk after its last bounce.
  struct Walk {
    Vec3 point = Vec3::Zero();        // World frame [m].
    Vec3f direction = Vec3f::Zero();  // Direction of its next leg, unit length.
    float length = 0;                 // Length of the path so far [m].
    float weight = 0;                 // Solid angle of launched sound that it represents [sr].
    float share = 1;                  // Remaining energy, relative to that launched.
    std::uint32_t index = 0;          // Number of its bearing in the world, which selects its random numbers.
    int column = 0;                   // Of the lattice, in which it was launched.
    int partner = -1;                 // Number in partners_; -1 for none.
    float density = 0;                // With which the direction of its next leg was drawn [1/sr].
    bool first_mirrored = false;      // Whether the first bounce was mirrored.
    SurfaceLabel first_surface = kNoSurface;
    Vec3f first_normal = Vec3f::Zero();
    Vec3f second_normal = Vec3f::Zero();
    bool second_mirrored = false;
    float first_coherent = 1;  // Coherent share of the first bounce.
    float coherent = 1;        // Coherent share of the first two bounces; 0 if one was diffuse.
  };

  // The walks that one of the plan's beams launches: every step-th.
  struct Launch {
    int beam;
    std::int64_t step;
  };

  // The first surface of a walk, by which others return.
  struct Partner {
    Hit hit = {};
    Vec3 point = Vec3::Zero();   // World frame [m].
    double range = 0;            // From the sonar [m]; 0 if nothing was hit.
    Vec3f back = Vec3f::Zero();  // Direction to the sonar.
    FlatPlan::Arrival arrival = {};
    float weight = 0;  // Solid angle that it represents, weighted by the pattern of reception, where each walk has one
                       // partner of all [sr].
  };

  void choose_steps(const FlatPlan& plan);
  void choose_partners(const FlatPlan& plan);
  void launch(const PingView& view, const Launch& from, RayList& rays);
  void find_partners(const PingView& view, const RayAnswers& hits);
  [[nodiscard]] float partner_density(double bearing, float facing, double range) const;
  void connect_by_partner(const FlatPlan& plan, const Hit& hit, float choice, const Walk& walk);
  void note_bounce(const FlatPlan& plan, const SurfaceLaw& law, const Hit& hit, bool mirrored, Walk& walk) const;
  void add_clear_legs(std::span<const Hit> legs, EchoList& found) const;
  void bounce_all(const PingView& view, const RayAnswers& hits, RayList& more);
  bool bounce(const FlatPlan& plan, const Hit& hit, const WalkDraws& draws, Walk& walk);
  void connect(const FlatPlan& plan, const Pose& world_from_sonar, const Hit& hit, const Walk& walk);
  [[nodiscard]] float per_steradian(const FlatPlan& plan, const SurfaceLaw& law, const Hit& hit, const Vec3f& in,
                                    const Vec3f& out, int order, const Walk& walk) const;

  Settings settings_;
  std::uint64_t number_ = 0;
  std::vector<Launch> launches_;
  std::int64_t bearings_ = 1;       // Number of bearings on the full circle, a multiple of all steps.
  std::int64_t first_ = 0;          // Walks are taken with each step from this bearing on.
  double offset_ = 0;               // BearingFrame::offset
  std::vector<Partner> partners_;   // Of consecutive bearings; empty unless the array is two-way.
  std::int64_t first_partner_ = 0;  // The bearing of the first.
  double height_ = 0;               // Of the elevation aperture [rad].
  SurfaceLabel water_ = kNoSurface;
  int order_ = 0;            // Surfaces that the active walks will have met after the rays asked for.
  std::size_t walking_ = 0;  // Number of active walks, which come first in walks_ and in the rays asked for.
  std::vector<Walk> walks_;
  std::vector<Ray> legs_;     // Legs back to the sonar from this bounce; they follow in the rays asked for.
  std::vector<Echo> echoes_;  // [leg] Its echo, if nothing blocks the leg.
};

}  // namespace insonify
