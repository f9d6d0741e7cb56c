// engine.h -- the one question a simulator asks of the hardware: what comes back of this ping?

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "insonify/array_pattern.h"
#include "insonify/echo_grid.h"
#include "insonify/geometry.h"
#include "insonify/paper_model.h"
#include "insonify/scene.h"
#include "insonify/sonar_config.h"
#include "insonify/water.h"

namespace insonify {

/// How the nearest surface in each direction is found; the echoes are the same.
enum class PrimaryEchoes {
  kAuto,  ///< Whichever is likely to be faster.
  kRays,
  kRaster  ///< Triangles drawn into the fan's own columns and rows. `reference` traces rays all the same.
};

/// What an engine does: kRays or kRaster. For kAuto a cost model of triangles, samples and the azimuth aperture picks
/// the faster one (bench/README.md), the same for a scenario on every machine.
/// @param can_draw   Whether the engine can draw primaries, see EngineKind; others always trace.
/// @param even_rows  Whether columns are wedges and their rows even in tan(elevation), as without an array: others
///                   cannot be drawn, and kAuto traces them.
[[nodiscard]] PrimaryEchoes primary_echoes(PrimaryEchoes asked, const SonarConfig& sonar, std::size_t triangle_count,
                                           bool can_draw, bool even_rows = true);

/// Which hits send a ray on, in search of a second surface.
enum class SecondaryEchoes {
  kNone,
  kSelective,  ///< Those that can give an echo worth having, by chance and weighted so that sums stay unbiased; all
               ///< that may meet something where these are few.
  kAll
};

/// Where a ray first meets the scene.
struct Hit {
  double distance = 0;         ///< From the ray's origin [m]; infinite for a miss.
  Vec3 normal = Vec3::Zero();  ///< Unit shading normal on the surface's side of the ray, world frame; with relief.
  std::uint16_t instance = kNoLabel;  ///< Index into Scene::instances, kNoLabel for a miss.
  std::uint16_t material = kNoLabel;  ///< Index into Scene::materials.
  float reflectivity = 0;             ///< Of the surface there: its material's, times that of its relief.
};

/// What becomes of sound where it meets a surface and on its way, and what a cell of an EchoGrid holds.
enum class EchoModel {
  kPaper,      ///< Sums of shaped strengths 0..1 and of weights, whose ratio is drawn. See paper_model.h.
  kCalibrated  ///< `energy` is the sum of echo intensities relative to the source's at 1 m: 10 log10 of it is EL - SL.
};

/// Everything about one sonar that does not change from ping to ping, worked out once.
class PingPlan;

/// What a plan is made from.
struct PingPlanSettings {
  SonarConfig sonar = {};
  Water water = {};
  EchoModel model = EchoModel::kPaper;
  PaperModel paper = {};
  std::span<const Material> materials = {};  ///< The scene's, for the calibrated model; read only while planning.

  // Of the calibrated model; others than these are not for kRaster.
  BeamShape beam_shape = BeamShape::kWedge;
  std::optional<ArraySettings> elevation_array = {};  ///< One way, as wide at half power as the elevation aperture;
                                                      ///< sends and hears. A top hat when absent.

  PrimaryEchoes primary = PrimaryEchoes::kAuto;
  SecondaryEchoes secondary = SecondaryEchoes::kSelective;
  int max_surfaces = kPathOrders;  ///< Of a path, 1..3; the paper model knows two.
  bool rough_mirrors = false;      ///< Send sound on about facets drawn from their slopes; calibrated model only.
  std::uint64_t seed = 1;
  int stagger_phase = 0;  ///< >= 0. Others put the samples elsewhere: what changes with it is the sampling's own.
};
[[nodiscard]] std::shared_ptr<const PingPlan> make_ping_plan(const PingPlanSettings& settings);

/// Rays that one ping sent.
struct RayCounts {
  std::uint64_t primary = 0;
  std::uint64_t secondary = 0;  ///< Reflected, and the few probes by which kSelective chooses.
  std::uint64_t return_legs = 0;
};

/// What an engine keeps in memory for a scene, besides the meshes themselves.
struct EngineMemory {
  std::size_t own = 0;      ///< Vertices, normals and tables [bytes].
  std::size_t library = 0;  ///< What the ray-tracing library took [bytes].
};

class Engine;

/// One kind of engine: what it is called, what it can do, and how it is made. Each engine defines its own, and the list
/// in src/echo/make_engine.cpp has them all.
struct EngineKind {
  std::string_view name;         ///< Lower case, as in scenarios and on the command line.
  bool draws_primaries = false;  ///< Whether it can draw triangles into the fan (PrimaryEchoes::kRaster).
  std::unique_ptr<Engine> (*make)(int threads) = nullptr;
};

/// The kind of engine of that name.
/// @throws Error if there is none; the message lists those there are.
[[nodiscard]] const EngineKind& engine_kind(std::string_view name);

/// Finds the echoes of a ping on one kind of hardware.
///
/// All engines answer alike: tests/engines/ runs the same cases on each and compares the answers with those of the
/// `reference` engine. An object is used by one thread at a time.
class Engine {
 public:
  virtual ~Engine() = default;

  [[nodiscard]] virtual const EngineKind& kind() const = 0;

  /// Takes in the scene. Positions are kept relative to the middle of its bounds, so that survey coordinates do not
  /// cost precision. The scene must outlive the engine or the next call.
  virtual void set_scene(const Scene& scene) = 0;
  void set_scene(const Scene&& scene) = delete;  ///< It would not outlive the call.

  /// Puts an instance with `moving` set somewhere else; what stands still is not rebuilt.
  virtual void move_instance(int instance, const Pose& world_from_mesh) = 0;

  /// Fills the grid with the echoes of one ping. The grid has the plan's beams and bins; it is cleared first. The
  /// result depends on plan, pose and ping number alone, not on threads.
  /// @param world_from_sonar  Pose of the transducer: the head, turned, for a scanning sonar.
  /// @param sink              Told of every beam as soon as it is complete; none when null. With secondary echoes of
  ///                          the calibrated model it must be null: they arrive in any beam.
  virtual void insonify(const PingPlan& plan, const Pose& world_from_sonar, std::uint64_t ping, EchoGrid& grid,
                        BeamSink* sink) = 0;

  /// Fills grids[i] with the echoes of the ping from poses[i], all with one plan and with the scene as it is now. For
  /// engines that make many pings in one go; here, one after another.
  virtual void insonify_all(const PingPlan& plan, std::span<const Pose> poses, std::span<EchoGrid> grids);

  /// Finds the first surface along every ray. `hits` has the length of `rays`.
  virtual void trace(std::span<const Ray> rays, std::span<Hit> hits) = 0;

  /// Of the last ping.
  [[nodiscard]] virtual RayCounts ray_counts() const = 0;

  [[nodiscard]] virtual EngineMemory memory() const = 0;

  /// The floor a ping stands on: seconds that its rays take the ray-tracing library alone, packets set up but nothing
  /// shaded or deposited; the same primary lattice, and the reflected rays and return legs that insonify() really
  /// sends.
  /// @return One value a repetition [s]; none from an engine that has no such library.
  [[nodiscard]] virtual std::vector<double> time_traversal(const PingPlan& plan, const Pose& world_from_sonar,
                                                           int repetitions);
};

/// Names of the engines built in, fastest first.
[[nodiscard]] std::vector<std::string_view> engine_names();

/// Makes an engine by name.
/// @param threads  Worker threads, 0 for as many as there are processors.
/// @throws Error if there is no such engine; the message lists those there are.
[[nodiscard]] std::unique_ptr<Engine> make_engine(std::string_view name, int threads = 0);

}  // namespace insonify
