// engine.h -- interface of the engines, which compute the echoes of a ping on one kind of hardware.

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

/// Resolves kAuto to kRays or kRaster: the one that is faster by a cost model of triangles, samples and azimuth
/// aperture (bench/README.md). The choice depends on the scenario only, not on the machine.
/// @param even_rows  Whether columns are wedges whose rows are evenly spaced in tan(elevation), as without an elevation
///                   array. Other columns cannot be rasterised, and kAuto traces them.
[[nodiscard]] PrimaryEchoes primary_echoes(PrimaryEchoes asked, const SonarConfig& sonar, std::size_t triangle_count,
                                           std::string_view engine, bool even_rows = true);

/// From which hits a reflected ray is traced to a second surface.
enum class SecondaryEchoes {
  kNone,
  kSelective,  ///< A random sample of the hits, preferring those that can give a strong echo, with weights that keep
               ///< sums unbiased; all hits whose ray may hit something where these are few.
  kAll
};

/// Where a ray first meets the scene.
struct Hit {
  double distance = 0;         ///< From the ray's origin [m]; infinite for a miss.
  Vec3 normal = Vec3::Zero();  ///< Unit shading normal on the surface's side of the ray, world frame; with relief.
  std::uint16_t instance = kNoLabel;  ///< Index into Scene::instances, kNoLabel for a miss.
  std::uint16_t material = kNoLabel;  ///< Index into Scene::materials.
  float reflectivity = 0;             ///< Reflectivity of the material there, times that of its relief.
};

/// Model of scattering and propagation, and with it the meaning of the values in an EchoGrid.
enum class EchoModel {
  kPaper,      ///< Sums of shaped strengths 0..1 and of weights, whose ratio is drawn. See paper_model.h.
  kCalibrated  ///< `energy` is the sum of echo intensities relative to the source's at 1 m: 10 log10 of it is EL - SL.
};

/// Everything about one sonar that does not change from ping to ping, computed once.
class PingPlan;

/// Settings from which a plan is made.
struct PingPlanSettings {
  SonarConfig sonar = {};
  Water water = {};
  EchoModel model = EchoModel::kPaper;
  PaperModel paper = {};
  std::span<const Material> materials = {};  ///< The scene's, for the calibrated model; read only while planning.

  // For the calibrated model. Values other than these defaults exclude kRaster.
  BeamShape beam_shape = BeamShape::kWedge;
  std::optional<ArraySettings> elevation_array = {};  ///< One way, as wide at half power as the elevation aperture;
                                                      ///< sends and hears. A top hat when absent.

  PrimaryEchoes primary = PrimaryEchoes::kAuto;
  SecondaryEchoes secondary = SecondaryEchoes::kSelective;
  int max_surfaces = kPathOrders;  ///< Greatest number of surfaces on a path, 1..3; the paper model has at most 2.
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

/// Memory that an engine uses for a scene, besides the meshes themselves.
struct EngineMemory {
  std::size_t own = 0;      ///< Vertices, normals and tables [bytes].
  std::size_t library = 0;  ///< Memory allocated by the ray-tracing library [bytes].
};

/// Finds the echoes of a ping on one kind of hardware.
///
/// All engines answer alike: tests/engines/ runs the same cases on each and compares the answers with those of the
/// `reference` engine. An object is used by one thread at a time.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Lower-case name, as given to make_engine() and on the command line.
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// Builds the engine's data of a scene. Positions are stored relative to the middle of its bounds, so that large
  /// survey coordinates do not cost precision. The scene must outlive the engine or the next call.
  virtual void set_scene(const Scene& scene) = 0;
  void set_scene(const Scene&& scene) = delete;  ///< It would not outlive the call.

  /// Moves an instance with `moving` set to another pose; data of the other instances are not rebuilt.
  virtual void move_instance(int instance, const Pose& world_from_mesh) = 0;

  /// Fills the grid with the echoes of one ping. The grid has the plan's beams and bins; it is cleared first. The
  /// result depends on plan, pose and ping number alone, not on threads.
  /// @param world_from_sonar  Pose of the transducer: the head, turned, for a scanning sonar.
  /// @param sink              Told of every beam as soon as it is complete; none when null. With secondary echoes of
  ///                          the calibrated model it must be null: they arrive in any beam.
  virtual void insonify(const PingPlan& plan, const Pose& world_from_sonar, std::uint64_t ping, EchoGrid& grid,
                        BeamSink* sink) = 0;

  /// Finds the first surface along every ray. `hits` has the length of `rays`.
  virtual void trace(std::span<const Ray> rays, std::span<Hit> hits) = 0;

  /// Rays traced for the last ping.
  [[nodiscard]] virtual RayCounts ray_counts() const = 0;

  [[nodiscard]] virtual EngineMemory memory() const = 0;
};

/// Names of the engines built in, fastest first.
[[nodiscard]] std::vector<std::string_view> engine_names();

/// Makes an engine by name, "cpu" or "reference".
/// @param threads  Worker threads, 0 for as many as there are processors. `reference` uses them too.
/// @throws Error if there is no such engine; the message lists those there are.
[[nodiscard]] std::unique_ptr<Engine> make_engine(std::string_view name, int threads = 0);

/// Times the ray-tracing library alone on the rays of a ping, as a lower bound for insonify(): the same primary
/// lattice, reflected rays and return legs, with packets set up but nothing shaded or deposited.
/// @return One time per repetition [s].
/// @throws Error for an engine that has no such library ("reference").
[[nodiscard]] std::vector<double> time_traversal(Engine& engine, const PingPlan& plan, const Pose& world_from_sonar,
                                                 int repetitions);

}  // namespace insonify
