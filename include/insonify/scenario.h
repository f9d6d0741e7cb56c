// scenario.h -- what to simulate: world, water, sonars, their motion and their pings.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "insonify/engine.h"
#include "insonify/ground_truth.h"
#include "insonify/interferer.h"
#include "insonify/paper_model.h"
#include "insonify/pattern.h"
#include "insonify/point_target.h"
#include "insonify/receiver_config.h"
#include "insonify/scene.h"
#include "insonify/sea_surface.h"
#include "insonify/sonar_config.h"
#include "insonify/thruster.h"
#include "insonify/water.h"

namespace insonify {

/// A pose at a time.
struct Waypoint {
  double time = 0;                  ///< [s], within 1e10.
  Vec3 position = Vec3::Zero();     ///< [m], within 1e7.
  Vec3 orientation = Vec3::Zero();  ///< Roll, pitch, yaw [rad], within 1e6 deg.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"time", "s", from_to(-1e10, 1e10), "Time of the waypoint, rising from one to the next."}, self.time);
    visit(Field{"position", "m", coordinate(), "[x, y, z] in the world."}, self.position);
    visit(Field{"orientation", "rad", turn(), "[roll, pitch, yaw] as in SDF."}, self.orientation);
  }
};

/// Waypoints in order of time. Between two, position moves on a straight line and orientation turns the shorter way at
/// a constant rate; before the first and after the last it stands still. Empty: the world's origin.
struct Trajectory {
  std::vector<Waypoint> waypoints;
  [[nodiscard]] Pose at(double time) const;
  /// @throws Error unless times rise.
  void validate(std::string_view object) const;
};

/// An object of the world that moves by itself.
struct Motion {
  std::string object = {};     ///< A model, link or visual by its scoped name.
  Trajectory trajectory = {};  ///< Poses of the object's frame; its parts move with it.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"object", "", {}, "Model, link or visual of the world that moves, by its scoped name."}, self.object);
  }

  template <typename Self, typename Visit>
  static void visit_parts(Self& self, Visit&& visit) {
    visit(Part{"trajectory", "list of waypoints", "Where the object is: as `trajectory`.", ""},
          self.trajectory.waypoints);
  }
};

/// A camera for a picture of the scene.
struct ViewConfig {
  Vec3 position = Vec3::Zero();                     ///< Position of the camera in the world [m], within 1e8.
  Vec3 look_at = Vec3::UnitX();                     ///< [m], within 1e8.
  double field_of_view = radians_from_degrees(50);  ///< Horizontal [rad], in (0, 170 deg].

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    constexpr Limits kReach = from_to(-1e8, 1e8);  // Room around a sonar at the edge of the world.
    visit(Field{"position", "m", kReach, "Position of the camera: [x, y, z]."}, self.position);
    visit(Field{"look_at", "m", kReach, "Point that the camera looks at: [x, y, z]."}, self.look_at);
    visit(Field{"field_of_view", "rad", above_to(0, radians_from_degrees(170)), "Horizontal field of view."},
          self.field_of_view);
  }
};

struct Scenario {
  std::filesystem::path file;  ///< Source file; empty if made in code.
  /// Text of the file with --set applied, for recordings. A program that changes a scenario after reading it must clear
  /// this: if it is empty, recordings hold to_yaml().
  std::string text;
  Places places;  ///< Places of its settings in the file, for messages; empty if made in code.

  std::filesystem::path
      world;  ///< SDF world or model, Stonefish scenario, mesh or height grid; absolute. Empty for open water.
  bool collisions = false;             ///< Insonify the world's collision shapes instead of its visuals.
  bool strict = false;                 ///< Whether a missing part of the world is an error; else it is skipped.
  std::vector<std::string> ignore;     ///< Objects of the world to ignore, as WorldOptions::ignore.
  bool keep_water = false;             ///< Whether the world's water is insonified, as WorldOptions::keep_water.
  std::vector<std::string> arguments;  ///< Values for a Stonefish world, "px=8", as WorldOptions::arguments.
  bool parts = false;                  ///< An instance for each part of a mesh file, as WorldOptions::parts.
  EchoModel model = EchoModel::kCalibrated;
  std::string engine = std::string(kAutoEngine);  ///< One of engine_choices().
  std::string device = {};
  PrimaryEchoes primary = PrimaryEchoes::kAuto;
  SecondaryEchoes secondary = SecondaryEchoes::kSelective;
  int max_surfaces = kPathOrders;    ///< Largest number of surfaces on a path, 1..3.
  bool rough_mirrors = false;        ///< Whether mirrors reflect by facets only, for any rms_height.
  int random_walks = 0;              ///< Random walks per ping, 0..1e6: reverberation of closed spaces; 0: none.
  bool motion_in_ping = false;       ///< Whether the sonar moves between transmission and reception.
  bool mutual_interference = false;  ///< Whether each sonar receives the pulses of the others.
  GroundTruth ground_truth = GroundTruth::kLabels;
  std::uint64_t seed = 1;
  int pings = 1;                   ///< Pings per sonar, >= 1, unless `duration` or `turns` is given.
  std::optional<double> duration;  ///< Pings of each sonar from time 0 until before this time [s], > 0.
  std::optional<double> turns;     ///< Full turns of scanning heads, or sweeps across their sectors, > 0.

  Water water;
  PaperModel paper;
  ReceiverConfig receiver;  ///< Receiver of all sonars without their own.
  MaterialRules materials;
  std::vector<PointTarget> points;      ///< Calibrated model only.
  std::vector<Interferer> interferers;  ///< Calibrated model only.
  std::vector<Thruster> thrusters;      ///< Thrusters of the vehicle. Calibrated model only.
  std::optional<SeaSurface> surface;    ///< Absent: none.
  std::vector<SonarConfig> sonars;
  Trajectory trajectory;                 ///< Trajectory of the vehicle.
  std::optional<SurveyPattern> pattern;  ///< Instead: what flown() makes the trajectory from. A simulator's has none.
  std::vector<PingSpan> ping_spans;      ///< When the sonars ping, in order; empty: all the time. The last has no end
                                         ///< where `pings` are more.
  std::vector<Motion> motions;
  std::optional<ViewConfig> view;  ///< Absent: chosen to show the first sonar's field.

  /// The receiver of one of its sonars: the sonar's own, or `receiver`.
  [[nodiscard]] const ReceiverConfig& receiver_of(const SonarConfig& sonar) const {
    return sonar.receiver ? *sonar.receiver : receiver;
  }

  /// Whether a sonar's columns are wedges with even rows, so that triangles can be drawn into them; see
  /// primary_echoes().
  [[nodiscard]] bool has_even_rows(const SonarConfig& sonar) const;

  /// The water around one of its sonars: `water`, with a `surface` at the sonar's depth below it at the start of the
  /// trajectory. The only source of sound speed and absorption.
  [[nodiscard]] Water water_at(const SonarConfig& sonar) const;

  /// World z of the surface, where depth is 0: that of `surface`, else `water.depth` above the sonar at the start of
  /// the trajectory [m].
  [[nodiscard]] double surface_height(const SonarConfig& sonar) const;

  /// The settings of a sonar with derived ones filled in: assumed sound speed and ping period.
  [[nodiscard]] SonarConfig filled_in(SonarConfig sonar) const;

  /// Number of pings of one of its sonars by `pings`, `duration` or `turns`, and `ping_spans`, at least 1. Expects the
  /// sonar from filled_in().
  [[nodiscard]] std::uint64_t ping_count(const SonarConfig& sonar) const;

  /// Checks every part and the rules between them: at least one sonar, unique names, periods long enough.
  /// @throws Error on the first fault.
  void validate() const;

  /// Visits the members that are plain values.
  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"world",
                "",
                {},
                "SDF world or model, Stonefish scenario, mesh or height grid; relative paths start from the scenario's "
                "folder. Open water when absent, for `points` or under a `surface`; `none` is for programs that supply "
                "the scene."},
          self.world);
    visit(Field{"collisions", "", {}, "Insonify the world's collision shapes instead of its visuals (SDF, Stonefish)."},
          self.collisions);
    visit(Field{"strict",
                "",
                {},
                "Whether a missing model or file of the world is an error; otherwise it is skipped with a warning "
                "(SDF, Stonefish)."},
          self.strict);
    visit(Field{"ignore",
                "",
                {},
                "Objects of the world to skip, by patterns of their names: `[water_surface*, box_walls]` (SDF, "
                "Stonefish)."},
          self.ignore);
    visit(Field{"keep_water",
                "",
                {},
                "Whether what is water by its name (ocean, sea_surface, water, waves) or its look echoes as a solid "
                "surface; otherwise it is left out with a warning (SDF)."},
          self.keep_water);
    visit(Field{"arguments",
                "",
                {},
                "Values of `$(arg px)` and `$(param px)` in a Stonefish world, which launch files give: `{px: 8}`."},
          self.arguments);
    visit(
        Field{"parts",
              "",
              {},
              "Whether each named part of a mesh file is an object of its own, `ship::mast`, with labels and materials "
              "by its name (OBJ's o and g, nodes of DAE and glTF)."},
        self.parts);
    visit(Field{"model", "", {}, "Echo model: calibrated (levels by the sonar equation) or paper (shaped strengths)."},
          self.model);
    visit(
        Field{
            "engine",
            "",
            {},
            "Engine that computes the echoes: cpu, gpu (a graphics card, by Vulkan), reference (slow, for checks), or "
            "auto: gpu where it is expected to be faster (fans of many beams, on a card), else cpu."},
        self.engine);
    visit(Field{"device",
                "",
                {},
                "Graphics card of engine gpu or auto: a part of its name, or its index as `insonify version` lists it; "
                "without one the fastest. Drivers that compute on the processor are used only where they are named."},
          self.device);
    visit(Field{"primary", "", {}, "How the nearest surface in each direction is found; the echoes are the same."},
          self.primary);
    visit(Field{"secondary", "", {}, "From which hits a reflected ray is traced to a second surface."}, self.secondary);
    visit(Field{"max_surfaces", "", from_to(1, kPathOrders),
                "Largest number of surfaces on a path: 2 adds echoes via a mirror one way, 3 via a mirror both ways "
                "(calibrated)."},
          self.max_surfaces);
    visit(Field{"rough_mirrors",
                "",
                {},
                "Whether mirrors reflect all sound by facets of their rms_slope; otherwise the share that follows from "
                "their rms_height is reflected coherently (calibrated)."},
          self.rough_mirrors);
    visit(Field{"random_walks", "", from_to(0, 1e6),
                "Random walks per ping over many surfaces, for the reverberation of closed spaces: 1000 to 5000 in a "
                "tank, 0 for none (calibrated)."},
          self.random_walks);
    visit(Field{"motion_in_ping", "", {}, "Whether the sonar moves along its trajectory during a ping (calibrated)."},
          self.motion_in_ping);
    visit(
        Field{"mutual_interference",
              "",
              {},
              "Whether each sonar receives the pulses of the scenario's other sonars on the direct path (calibrated)."},
        self.mutual_interference);
    visit(Field{"ground_truth",
                "",
                {},
                "Recorded origin of each bin's echo: none, labels (instance, material, elevation) or full (also "
                "shares, spread, path order, shadow and direct echo; calibrated)."},
          self.ground_truth);
    visit(Field{"seed", "", at_least(0), "Seed of the random numbers; the same seed gives the same pings."}, self.seed);
    visit(Field{"pings", "", from_to(1, 1e9), "Number of pings of each sonar."}, self.pings);
    visit(Field{"duration", "s", above_to(0, 1e9),
                "Instead of `pings`: each sonar pings from time 0 until before this time."},
          self.duration);
    visit(Field{"turns", "", above_to(0, 1e6),
                "Instead of `pings`: full turns of a scanning head, or sweeps across its sector. Other sonars ping for "
                "the same time."},
          self.turns);
    MaterialRules::visit_fields(self.materials, visit);
  }

  /// Visits the members that have fields of their own.
  template <typename Self, typename Visit>
  static void visit_parts(Self& self, Visit&& visit);
};

/// The scenario with a trajectory over a scene instead of its `pattern`, and `duration` and `ping_spans` of the survey
/// where it has no others; the same scenario if it has no pattern. Simulator does this too.
/// @param scene  As for Simulator.
/// @throws Error for a line that leaves the terrain or runs into something.
[[nodiscard]] Scenario flown(Scenario scenario, const Scene& scene);

// ---------------------------------------------------------------------------------------------------------------------

template <typename Self, typename Visit>
void Scenario::visit_parts(Self& self, Visit&& visit) {
  visit(Part{"water", "map", "The water: see `water`.", "The water, the same everywhere unless it has a `profile`."},
        self.water);
  visit(Part{"materials", "map of object names", "What surfaces are made of: see `materials`.",
             "One entry for each name of a visual or a material: `hull: steel` or `hull: {like: steel, lambert_db: "
             "-15}`."},
        self.materials.overrides);
  visit(Part{"sonars", "list of sonars", "The sonars, at least one: see `sonars`.",
             "One entry for each sonar. The keys beside `preset` override it; without one, the defaults below hold. "
             "With a preset, `bin_count`, `ping_period` and `pulse_duration` follow from the range unless given."},
        self.sonars);
  visit(Part{"receiver", "map", "Settings of the receiver: see `receiver`.",
             "Settings of the receiver. A sonar may have its own `receiver`, which starts from this one. In the paper "
             "model only `noise` has an effect."},
        self.receiver);
  visit(Part{"paper", "map", "The paper model's settings: see `paper`.", "Settings of the paper model."}, self.paper);
  visit(Part{"surface", "map", "The water's surface; none when absent: see `surface`.",
             "The water's surface above the sonar, a rough mirror."},
        self.surface);
  visit(Part{"points", "list of point targets", "Ideal point targets (calibrated model): see `points`.",
             "One entry for each ideal point target (calibrated model)."},
        self.points);
  visit(Part{"interferers", "list of other sonars",
             "Other sonars whose pulses are received (calibrated model): see `interferers`.",
             "One entry for each other sonar whose pulses are received (calibrated model)."},
        self.interferers);
  visit(Part{"thrusters", "list of thrusters",
             "Thrusters of the vehicle, whose noise the sonars receive (calibrated model): see `thrusters`.",
             "One entry for each running thruster of the vehicle. Sonars receive its noise with `receiver.noise` "
             "(calibrated model)."},
        self.thrusters);
  visit(Part{"trajectory", "list of waypoints", "How the vehicle moves: see `trajectory`.",
             "One entry for each waypoint, in order of time. Between two, the vehicle moves straight and turns evenly; "
             "before the first and after the last it stands still. Instead of the list, a file: `trajectory: "
             "log.csv` or `trajectory: {file: log.tum, start: 100}` ([trajectory files](trajectories.md))."},
        self.trajectory.waypoints);
  visit(Part{"pattern", "map", "Instead of `trajectory`: a survey by lines, see `pattern`.",
             "A survey over the bed of the world ([how to](../how-to/survey.md)). Without `pings` and `duration` the "
             "sonars ping until its end."},
        self.pattern);
  visit(Part{"ping_spans", "list of spans of time", "When the sonars ping; all the time when absent: see `ping_spans`.",
             "One entry for each span of time in which the sonars ping, in order."},
        self.ping_spans);
  visit(Part{"motions", "list of motions", "Objects of the world that move: see `motions`.",
             "One entry for each object of the world that moves."},
        self.motions);
  visit(Part{"view", "map", "The camera of the picture of the scene: see `view`.",
             "The camera of the picture of the scene; when absent, one that shows the first sonar's field."},
        self.view);
}

// Their tables are compiled once, in src/simulator/scenario_tables.cpp.
extern template const SettingsTable& table_of<ProfilePoint>();
extern template const SettingsTable& table_of<Water>();
extern template const SettingsTable& table_of<PaperModel>();
extern template const SettingsTable& table_of<ReceiverConfig>();
extern template const SettingsTable& table_of<Sampling>();
extern template const SettingsTable& table_of<SonarConfig>();
extern template const SettingsTable& table_of<MaterialOverride>();
extern template const SettingsTable& table_of<Material>();
extern template const SettingsTable& table_of<PointTarget>();
extern template const SettingsTable& table_of<Interferer>();
extern template const SettingsTable& table_of<Thruster>();
extern template const SettingsTable& table_of<SeaSurface>();
extern template const SettingsTable& table_of<Waypoint>();
extern template const SettingsTable& table_of<SurveyPattern>();
extern template const SettingsTable& table_of<SurveyLines>();
extern template const SettingsTable& table_of<MotionNoise>();
extern template const SettingsTable& table_of<PingSpan>();
extern template const SettingsTable& table_of<Motion>();
extern template const SettingsTable& table_of<ViewConfig>();
extern template const SettingsTable& table_of<Scenario>();

}  // namespace insonify
