// simulator.h -- makes the pings of a scenario's sonars, along its trajectories or from given poses.

#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/engine.h"
#include "insonify/interrupted.h"
#include "insonify/ping.h"
#include "insonify/ping_request.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

struct SimulatedSonar;

/// Something in the world that requests may move.
struct MovableObject {
  std::string name;                            ///< A model, link or visual by its scoped name; its parts move with it.
  std::optional<Pose> world_from_object = {};  ///< Where the object's own frame is in the scene as given; absent: where
                                               ///< the mesh of its first part is.
};

/// A sonar that Simulator::prepare_sonar() has made for Simulator::set_sonar().
class PreparedSonar {
 public:
  PreparedSonar();
  ~PreparedSonar();
  PreparedSonar(PreparedSonar&&) noexcept;
  PreparedSonar& operator=(PreparedSonar&&) noexcept;

 private:
  friend class Simulator;
  SonarConfig config_;
  std::size_t material_count_ = 0;  // Materials of the scene.
  std::unique_ptr<SimulatedSonar> made_;
};

/// Runs the sonars of a scenario in a scene.
///
/// Each ping is made from a PingRequest, which tells where vehicle and objects are; ScenarioRequests makes those of the
/// scenario's own trajectory, others may come from anywhere. The same request gives the same ping, whatever was asked
/// for before.
///
/// Objects, sonars and materials keep their indices as long as the simulator lives: what is added comes after all that
/// was there, and nothing takes the index of what was removed. So labels mean the same in all pings.
class Simulator {
 public:
  /// @param scene    Materials must be assigned. What the scenario's motions name becomes movable, as are instances
  ///                 marked `moving`.
  /// @param threads  0 for as many as there are processors; pings do not depend on it.
  /// @param movable  What else requests may move. It costs a little speed, for it is kept apart from what stands still.
  /// @throws Error for what Scenario::validate() refuses, and for a motion or a name of an object that is not there.
  Simulator(Scenario scenario, Scene scene, int threads = 0, std::span<const MovableObject> movable = {});
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// As it was given, but for set_sonar().
  [[nodiscard]] const Scenario& scenario() const;

  /// With the sea's surface as an instance of its own, and all that was added or removed.
  [[nodiscard]] const Scene& scene() const;

  /// Names of the objects with too many thin parts (ropes, nets) to be sampled on the object. The lattice samples
  /// them as all else: their echoes vary with their place among the samples. As of the last ping or change.
  [[nodiscard]] std::span<const std::string> too_many_thin_parts() const;

  /// Straight edges that have no echo, since the scene has too many: the shortest. As of the last ping or change.
  [[nodiscard]] std::size_t edges_left_out() const;

  /// Settings of one sonar with everything filled in: assumed sound speed, ping period.
  [[nodiscard]] const SonarConfig& sonar(int sonar) const;

  /// Makes one ping. Allocates nothing once `ping` has been used with this sonar before.
  /// @throws Error "ping 7 of fls: ..." for a request that makes no sense, that moves what cannot move or that has the
  ///         sonar above the sea's surface. The simulator is as it was, and the next request may be a better one.
  void ping(int sonar, const PingRequest& request, Ping& ping);
  [[nodiscard]] Ping ping(int sonar, const PingRequest& request);

  /// Makes many pings of one sonar; pings[i] is that of requests[i], the same as when made alone. Where nothing but the
  /// sonar moves and there is no sea surface, threads make a ping each instead of sharing one, which
  /// takes memory for one ping more for each thread.
  /// @throws Error as above, with the pings before it made; and where there are not as many pings as requests.
  void ping(int sonar, std::span<const PingRequest> requests, std::span<Ping> pings);

  /// While `*asked` is true, ping() throws Interrupted, also one that is running, within some beams' time. So another
  /// thread, or a handler of signals, can end a ping that takes long. Null, as at the start: never.
  /// @param asked  Must live as long as the simulator, or until the next call.
  void stop_when(const std::atomic<bool>* asked);

  /// Ping `number` of the scenario's own: ping(sonar, ScenarioRequests(scenario()).at(sonar, number)).
  [[nodiscard]] Ping make_ping(int sonar, std::uint64_t number);

  /// Pose of the housing at a ping, and of the transducer: of a scanning sonar the housing with its head turned.
  [[nodiscard]] Pose world_from_housing(int sonar, const PingRequest& request) const;
  [[nodiscard]] Pose world_from_head(int sonar, const PingRequest& request) const;

  /// Changes range, gain, beams or all of a sonar but its name, from the next ping on: as if the simulator had been
  /// built with it.
  /// Takes milliseconds, for a plan is made anew (bench/README.md); under a sea surface a range that is twice or half
  /// of what it was means that the engine takes in the scene anew, as add_objects() does.
  /// @param config  Not yet filled in: rather scenario().sonars[i] than sonar(i), whose ping period is that of the
  ///                old range. Its name, which may be that of a preset, is not taken.
  /// @throws Error for what Scenario::validate() refuses; the sonar is as it was.
  void set_sonar(int sonar, const SonarConfig& config);

  /// The part of set_sonar() that takes long with thousands of beams, made beside pings: it shares nothing with the
  /// simulator.
  /// @param scenario  As scenario(), with the new settings in `sonars`.
  /// @param scene     As scene(): its materials count.
  /// @throws Error for an index that is none.
  [[nodiscard]] static PreparedSonar prepare_sonar(const Scenario& scenario, int sonar, const Scene& scene);

  /// As set_sonar() with the settings that were prepared.
  void set_sonar(int sonar, PreparedSonar prepared);

  /// Adds the instances of a scene, whose materials are assigned, and its materials. The engine takes in the whole
  /// scene anew before the next ping, which can take as long as at the start: add many things at once.
  /// @param movable  Among what is added.
  /// @return         Index of the first of them in scene().instances; the others follow.
  /// @throws Error for a name that is there already, and where there would be more than 65535 instances or materials.
  int add_objects(const Scene& objects, std::span<const MovableObject> movable = {});

  /// Removes an object with all its parts, by its scoped name. The engine takes in the scene anew.
  /// @throws Error where there is no such object.
  void remove_object(std::string_view name);

  /// Places everything as at a ping, without making it: for camera views.
  void place(int sonar, const PingRequest& request);

  /// A copy of the scene with everything where a request has it; meshes are shared. The sea's surface, which goes
  /// with the vehicle, is left where the scene has it.
  /// @throws Error as ping() for what cannot move.
  [[nodiscard]] Scene scene_at(const PingRequest& request);

  /// The engine, with everything placed as at the last ping or place(): for camera views and counts.
  [[nodiscard]] Engine& engine();

  /// Rays of the last ping.
  [[nodiscard]] RayCounts ray_counts() const;

  [[nodiscard]] EngineMemory engine_memory() const;

  /// The floor that a ping stands on: the time that its rays take the ray-tracing library alone. Packets are set up,
  /// but nothing is shaded or summed; the rays are the primary lattice, and the reflected rays and return legs that a
  /// ping from there really sends.
  /// @param world_from_sonar  Pose of the transducer.
  /// @return                  One value a repetition [s].
  /// @throws Error for an engine that has no such library ("reference").
  [[nodiscard]] std::vector<double> time_traversal(int sonar, const Pose& world_from_sonar, int repetitions);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
