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
#include "insonify/log.h"
#include "insonify/ping.h"
#include "insonify/ping_request.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

struct SimulatedSonar;

/// One ping of a batch.
struct PingOrder {
  int sonar = 0;                         ///< Index of the sonar that makes it.
  const PingRequest* request = nullptr;  ///< What it is made from.
  Ping* ping = nullptr;                  ///< Receives it. Two orders must not share a ping.
};

/// An object that ping requests may move.
struct MovableObject {
  std::string name;                            ///< Scoped name of a model, link or visual; its parts move with it.
  std::optional<Pose> world_from_object = {};  ///< Pose of the object's frame in the scene as given. Default: the pose
                                               ///< of the mesh of its first part.
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
  std::vector<Material> materials_;  // The scene's when it was prepared.
  std::unique_ptr<SimulatedSonar> made_;
};

/// Runs the sonars of a scenario in a scene.
///
/// Each ping is computed from a PingRequest, which holds the poses of the vehicle and of moved objects.
/// ScenarioRequests makes the requests of the scenario's own trajectory; a caller may also build them itself. The same
/// request always gives the same ping, regardless of earlier ones.
///
/// Sonars keep their indices for the simulator's lifetime, and objects until they are removed; what is added later may
/// have the index of a removed object. Labels therefore mean the same in all pings between two calls of add_objects().
class Simulator {
 public:
  /// @param scene    Materials must be assigned. Objects named by the scenario's motions are movable, and so are
  ///                 instances marked `moving`.
  /// @param threads  0: one for each processor. Pings do not depend on it.
  /// @param movable  More movable objects. Each costs a little speed, since it is traced apart from the static scene.
  /// @param log      With `engine: auto`, receives a warning when a graphics card fails and `cpu` goes on.
  /// @param pings    Pings of each sonar that will be made, which `engine: auto` considers; 0: unknown, many.
  /// @throws Error for what Scenario::validate() refuses, and for a motion or a name without an object.
  Simulator(Scenario scenario, Scene scene, int threads = 0, std::span<const MovableObject> movable = {},
            const Log& log = {}, std::uint64_t pings = 0);
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// The scenario as given, with the changes of set_sonar(); `engine` is the name of the one that computes, which
  /// `auto` stands for.
  [[nodiscard]] const Scenario& scenario() const;

  /// The current scene, after add_objects() and remove_object(); the sea surface is an instance of its own.
  [[nodiscard]] const Scene& scene() const;

  /// A line that says which engine `engine: auto` has chosen at the start, and why; "" where the scenario names one.
  [[nodiscard]] const std::string& engine_choice() const;

  /// Names of the objects with too many thin parts (ropes, nets) to be sampled on the object. They are sampled by the
  /// lattice like any other surface, so their echoes vary with their place among the samples. As of the last ping or
  /// change.
  [[nodiscard]] std::span<const std::string> too_many_thin_parts() const;

  /// Number of straight edges without an echo, because the scene has too many; the shortest are omitted. As of the last
  /// ping or change.
  [[nodiscard]] std::size_t edges_left_out() const;

  /// Settings of one sonar, with assumed sound speed and ping period filled in.
  [[nodiscard]] const SonarConfig& sonar(int sonar) const;

  /// Makes one ping. Allocates nothing if `ping` has been used with this sonar before.
  /// @throws Error "ping 7 of fls: ..." for an invalid request, one that moves an immovable object, or one with the
  ///         sonar above the sea surface. The simulator is unchanged and stays usable.
  void ping(int sonar, const PingRequest& request, Ping& ping);
  [[nodiscard]] Ping ping(int sonar, const PingRequest& request);

  /// Makes many pings as one batch: of several sonars, from several poses, with objects moved. Each is the same as if
  /// made alone. A batch takes less time, since each thread makes pings of its own, and the memory of up to four pings
  /// per thread. Pings with different moved objects are computed one after another.
  /// @throws Error as above, after making the pings before the failing one.
  void ping(std::span<const PingOrder> orders);

  /// The same for one sonar; pings[i] is the ping of requests[i].
  /// @throws Error also if the spans differ in length.
  void ping(int sonar, std::span<const PingRequest> requests, std::span<Ping> pings);

  /// While `*asked` is true, ping() throws Interrupted; a running ping stops within the time of a few beams. Lets
  /// another thread or a signal handler abort a long ping. Null, the default: never.
  /// @param asked  Must live as long as the simulator, or until the next call.
  void stop_when(const std::atomic<bool>* asked);

  /// Ping `number` of the scenario's own trajectory: ping(sonar, ScenarioRequests(scenario()).at(sonar, number)).
  [[nodiscard]] Ping make_ping(int sonar, std::uint64_t number);

  /// Poses of the housing and of the transducer at a ping; the transducer of a scanning sonar is turned with its head.
  [[nodiscard]] Pose world_from_housing(int sonar, const PingRequest& request) const;
  [[nodiscard]] Pose world_from_head(int sonar, const PingRequest& request) const;

  /// Changes any setting of a sonar except its name, from the next ping on, as if the simulator had been built with it.
  /// Takes milliseconds, to rebuild the plan (bench/README.md). Under a sea surface, doubling or halving the range also
  /// makes the engine rebuild its scene, as add_objects() does.
  /// @param config  As in scenario().sonars[i], not as in sonar(i), whose ping period is that of the old range. Its
  ///                name, which may be that of a preset, is ignored.
  /// @throws Error for what Scenario::validate() refuses; the sonar is unchanged.
  void set_sonar(int sonar, const SonarConfig& config);

  /// The slow part of set_sonar() with thousands of beams. It may run while pings are made: it shares nothing with the
  /// simulator.
  /// @param scenario  As scenario(), with the new settings in `sonars`.
  /// @param scene     As scene(); its materials are used.
  /// @throws Error for an index out of range.
  [[nodiscard]] static PreparedSonar prepare_sonar(const Scenario& scenario, int sonar, const Scene& scene);

  /// set_sonar() with prepared settings.
  void set_sonar(int sonar, PreparedSonar prepared);

  /// Adds the instances and materials of a scene whose materials are assigned. The engine rebuilds its whole scene
  /// before the next ping, which can take as long as at the start: add many objects at once. Indices of removed objects
  /// are used again, the lowest first.
  /// @param movable  The movable ones among them.
  /// @return         Index of the first one in scene().instances; the others follow.
  /// @throws Error for a name that exists already, and for more than 65535 instances or materials at a time.
  int add_objects(const Scene& objects, std::span<const MovableObject> movable = {});

  /// Removes an object with all its parts, by its scoped name. The engine rebuilds its scene.
  /// @throws Error if there is no such object.
  void remove_object(std::string_view name);

  /// Places everything as at a ping, without making it: for camera views.
  void place(int sonar, const PingRequest& request);

  /// A copy of the scene with objects placed as in a request; meshes are shared. The sea surface, which follows the
  /// vehicle, stays where the scene has it.
  /// @throws Error as ping() for an immovable object.
  [[nodiscard]] Scene scene_at(const PingRequest& request);

  /// The engine, with everything placed as at the last ping or place(): for camera views and counts.
  [[nodiscard]] Engine& engine();

  /// Rays of the last ping.
  [[nodiscard]] RayCounts ray_counts() const;

  [[nodiscard]] EngineMemory engine_memory() const;

  /// Time of each step of the last call of ping() on the device, all batches together; empty for engines that compute
  /// on the host.
  [[nodiscard]] std::vector<StepTime> step_times() const;

  /// Lower limit of a ping's computing time: how long the ray-tracing library alone takes for its rays. Packets are set
  /// up, but nothing is shaded or summed. The rays are the primary lattice and those reflected rays and return legs
  /// that a ping from this pose sends.
  /// @param world_from_sonar  Pose of the transducer.
  /// @return                  One value per repetition [s].
  /// @throws Error for an engine without such a library ("reference").
  [[nodiscard]] std::vector<double> time_traversal(int sonar, const Pose& world_from_sonar, int repetitions);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace insonify
