// simulator_state.h -- state of a simulator between pings.

#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "echo/batch/batch_runner.h"
#include "echo/engine.h"
#include "echo/spare_engine.h"
#include "echo/targets/scene_targets.h"
#include "insonify/simulator.h"
#include "receiver/ping_motion.h"
#include "simulator/layered_water.h"
#include "simulator/movable_objects.h"
#include "simulator/mutual_interference.h"
#include "simulator/sea_plane.h"
#include "simulator/simulated_sonar.h"

namespace insonify {

struct Simulator::State {
  State(Scenario the_scenario, Scene the_scene, int threads, std::span<const MovableObject> movable, const Log& log,
        std::uint64_t pings);

  /// Makes a sonar of the scenario `in` for the scene of this simulator.
  [[nodiscard]] SimulatedSonar simulated(const Scenario& in, const SonarConfig& sonar) const;

  /// Replaces a sonar by one with the settings in `changed`.
  void set(int index, SimulatedSonar sonar, const Scenario& changed);

  /// Fills `senders` with the present sonars.
  void set_senders();

  /// Has the next batch make all sources anew.
  void forget_sources();

  /// Passes the scene to the engine again if it has changed, and finds its targets.
  void load_scene();

  /// One of `sonars`.  @throws Error for an index out of range.
  [[nodiscard]] SimulatedSonar& sonar(int index);

  /// Places everything in the engine as at a ping.
  /// @throws Error for an invalid request.
  void place(int sonar, const PingRequest& request);

  /// Makes all pings of the orders. @throws Error for an invalid request, with the pings before it made.
  void make(std::span<const PingOrder> orders);

  Scenario scenario;
  Scene scene;
  Workers workers;
  std::string engine_choice;  ///< See Simulator::engine_choice().
  std::unique_ptr<Engine> engine;
  SpareEngine* spare = nullptr;  ///< `engine`, where `auto` has taken a device.
  std::optional<BatchRunner> runner;
  MovableObjects objects;
  std::optional<SeaPlane> sea;
  std::optional<LayeredWater> layers;  ///< Where the water bends rays.
  SceneTargets targets;
  std::vector<Pose> at_home;  ///< [instance] World from mesh, in the scene.
  std::vector<SimulatedSonar> sonars;
  std::vector<SendingSonar> senders;  ///< All sonars, where they receive each other's pulses; else empty.
  bool scene_changed = true;          ///< Since the engine has loaded it.
  RayCounts ray_counts;               ///< Rays of the last ping.
  std::vector<StepTime> step_times;   ///< Steps on the device in the last call of make().

 private:
  class Receiver;

  /// Makes the engine of the scenario.
  /// @throws Error for one that does not bend rays where the water does.
  void start_engine(const Log& log, std::uint64_t pings);

  /// Makes the runner of batches for the present engine.
  void start_runner();

  // What a view is made for.
  struct Shot {
    const PingRequest* request;
    const SimulatedSonar* sonar;
    Aperture* aperture;
    std::size_t order;  // Index in placements_ and displaced_.
    Ping* ping;         // Receives it.
  };

  // Adds the views of an order to views_ and shots_: one for each aperture of its sonar.
  // @param i  Index of the order.
  // @throws Error for an invalid request; then none is added.
  void add_views(std::size_t i, const PingOrder& order);

  // Makes the pings of all views.
  void make_views();

  // @param first, count  The views in `views_`.
  void make_batch(std::size_t first, std::size_t count);
  void aim_receivers(std::size_t first, std::size_t count);
  void bend_rays(std::size_t first, std::size_t count);

  // False if the device of `spare` has failed, with another engine in its place.
  bool try_batch(std::size_t first, std::size_t count);
  [[nodiscard]] SourceSet* sources_of(Aperture& aperture, std::size_t slot);

  // Makes the pings of sonars with several apertures of those of the apertures.
  void join(std::span<const PingOrder> orders);

  // Views of the pings that are being made, reused from call to call.
  std::vector<PingView> views_;
  std::vector<Shot> shots_;                                // [view]
  std::vector<std::unique_ptr<Ping>> parts_;               // Pings of apertures of sonars that have several.
  std::vector<std::unique_ptr<Placement>> placements_;     // [order]
  std::vector<std::vector<DisplacedInstance>> displaced_;  // [order]
  std::vector<SourceSet*> sources_;
  std::vector<std::unique_ptr<Reception>> receptions_;
  std::vector<std::unique_ptr<Refraction>> refractions_;  // [view of the batch]
};

}  // namespace insonify
