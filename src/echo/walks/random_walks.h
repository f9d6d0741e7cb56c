// random_walks.h -- reverberation of closed spaces: echoes of paths over many surfaces, by random walks.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/engine.h"
#include "echo/walks/surface_law.h"

namespace insonify {

/// Echoes of the paths over two and more surfaces that primary and secondary echoes leave out.
///
/// A walk leaves the sonar in a direction of the lattice. Where it meets a surface, a direction is drawn in which it
/// goes on (SurfaceLaw), and from the second surface on the sound that goes straight back to the sonar is added to the
/// grid if nothing is in its way. The expected value of the grid is the integral over all paths:
/// docs/concepts/multipath.md, "Random walks". Walks depend on seed and ping number, not on threads or engine.
///
/// A bounce is diffuse or mirrored, so that a path is one word of D and M, and each word is in exactly one place:
///
///     one surface      primary echoes
///     MD, DM, MM       secondary echoes of order 2
///     M X M            secondary echoes of order 3, if both M are the same mirror
///     MMM              CornerEchoes, for the coherent share of three perpendicular mirrors
///     M D M            secondary echoes of order 3, for the coherent share of the water's surface as one M
///     all others       here: DD; three surfaces unless M X M by one mirror; four surfaces and more
class RandomWalks {
 public:
  struct Settings {
    int count = 0;       ///< Walks of a ping, > 0.
    int first_beam = 0;  ///< Beams of the plan that the sonar transmits into; on a scanning head with an array
    int beam_count = 0;  ///< pattern these are fewer than those of the plan.
    std::uint64_t seed = 1;
  };
  explicit RandomWalks(const Settings& settings);

  /// Adds the echoes of a ping to the cells of a grid of the calibrated model. Its path order is that of the path, or
  /// kPathOrders for longer ones. Allocates nothing once the lists of the grid have grown to their size.
  /// @param number   Of the ping.
  /// @param elsewhere  What is added elsewhere.
  struct Elsewhere {
    bool corners = false;             ///< Whether the coherent echoes of three perpendicular mirrors are: CornerEchoes.
    SurfaceLabel water = kNoSurface;  ///< The water's surface: its coherent share in M D M.
  };
  void add(const PingPlan& plan, const Pose& world_from_sonar, std::uint64_t number, const Elsewhere& elsewhere,
           Engine& engine, EchoGrid& grid);

 private:
  // The end of a walk so far.
  struct Walk {
    Vec3 point = Vec3::Zero();        // World frame [m].
    Vec3f direction = Vec3f::Zero();  // In which its next leg goes.
    float length = 0;                 // Length of the path so far [m].
    float weight = 0;                 // Solid angle of launched sound that it stands for [sr].
    float share = 1;                  // Energy that is left of it, relative to that launched.
    std::uint32_t index = 0;          // Its random numbers.
    bool first_mirrored = false;      // Whether the first bounce was mirrored.
    SurfaceLabel first_surface = kNoSurface;
    Vec3f first_normal = Vec3f::Zero();
    Vec3f second_normal = Vec3f::Zero();
    bool second_mirrored = false;
    float first_coherent = 1;  // Share of the first bounce that a smooth mirror reflects.
    float coherent = 1;        // Share of the first two bounces that smooth mirrors reflect, 0 where one was diffuse.
  };

  void launch(const PingPlan& plan, const Pose& world_from_sonar);
  void deposit_clear_legs(const PingPlan& plan, EchoGrid& grid);
  void bounce_all(const PingPlan& plan, const Pose& world_from_sonar, int order);
  bool bounce(const PingPlan& plan, const Hit& hit, int order, Walk& walk);
  void connect(const PingPlan& plan, const Pose& world_from_sonar, const Hit& hit, const Vec3f& in, int order,
               const Walk& walk);
  [[nodiscard]] float per_steradian(const PingPlan& plan, const SurfaceLaw& law, const Hit& hit, const Vec3f& in,
                                    const Vec3f& out, int order, const Walk& walk) const;

  Settings settings_;
  std::uint64_t number_ = 0;
  bool corners_ = false;
  SurfaceLabel water_ = kNoSurface;
  std::size_t walking_ = 0;  // How many of the walks go on: these come first.
  std::vector<Walk> walks_;
  std::vector<Ray> rays_;  // Next legs of the walks that go on, then legs back to the sonar.
  std::vector<Hit> hits_;
  std::vector<Ray> legs_;     // Legs back to the sonar of this bounce,
  std::vector<Echo> echoes_;  // and the echoes that they bring if they are clear.
};

}  // namespace insonify
