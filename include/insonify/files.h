// files.h -- reads and writes files: scenes, scenarios, presets, recordings and pictures.

#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "insonify/mesh.h"
#include "insonify/picture.h"
#include "insonify/ping.h"
#include "insonify/ping_sink.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// From now on, this process itself reads meshes, PNG pictures, BAG grids and HDF5 recordings: for debuggers. Otherwise
/// the program insonify-read does, so that a damaged or hostile file on which assimp, libpng or HDF5 crash ends only
/// that, and is an Error here. INSONIFY_READER=in-process in the environment does the same.
void read_files_in_process();

/// Reads a mesh file (OBJ, STL, DAE, PLY, glTF, GLB by extension), cleaned (clean_mesh), in metres, z up: DAE units are
/// applied, but like Gazebo not its up axis; glTF is rotated from y up. Dropped triangles are reported to `log`.
/// @throws Error with the path for a missing, unreadable or empty file, or one of unknown type.
[[nodiscard]] Mesh load_mesh(const std::filesystem::path& path, const Log& log = {});

/// Reads heights: 16- or 8-bit grey PNG (0..1 over its full scale, spacing 1 m), ESRI ASCII grid (.asc) or BAG (.bag,
/// depths as negative heights). Geographic spacing (degrees) becomes metres at the grid's own latitude.
/// @throws Error with the path, and for text the line.
[[nodiscard]] HeightGrid load_height_grid(const std::filesystem::path& path, const Log& log = {});

/// Options for SDF worlds and Stonefish scenarios; other files ignore them.
struct WorldOptions {
  bool collisions = false;  ///< Use collision shapes instead of visuals.
  /// Whether a missing or unreadable part (an included model, a mesh, a height grid, a faulty joint) is an error. If
  /// not, such parts are skipped with one warning that lists them.
  bool strict = false;
  /// Name patterns of models, links, visuals and collisions to ignore: `*` matches any text, `?` one character. A
  /// pattern applies to the full name ("tank::walls::north") and to its last part ("north"). The log gets a warning for
  /// a pattern without a match.
  std::vector<std::string> ignore = {};
  /// Whether what is water by its name or its look is insonified; otherwise it is left out with a warning (SDF).
  bool keep_water = false;
  /// Values of a Stonefish scenario's $(arg px) and $(param px): "px=8".
  std::vector<std::string> arguments = {};
  /// Whether each named part of a mesh file (OBJ's o and g, nodes of DAE and glTF) is an instance, "ship::mast".
  bool parts = false;

  bool operator==(const WorldOptions&) const = default;
};

/// The options that a scenario has for its world.
[[nodiscard]] WorldOptions world_options(const Scenario& scenario);

/// Reads the world of a scenario: an SDF world or model (.sdf, .world, .xml), a Stonefish scenario (.scn), a
/// mesh file, or a height grid. Materials are not assigned yet.
/// @throws Error with the path, for SDF and Stonefish "path:line:column: ..."; also if nothing is left to insonify.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, const WorldOptions& options = {},
                               const Log& log = {});

/// Reads a scenario. Paths are relative to its folder; presets are found by name (load_preset). A scenario
/// without `sonars` gets those of its world if that is a Stonefish scenario or an SDF file with sonars; a
/// Stonefish scenario (.scn) or SDF file given directly counts as a scenario with that world.
/// @param settings  "key=value" as on the command line, applied in order: "pings=3", "sonars[0].max_range=30",
///                  "sonars.fls.max_range=30", "max_range=30" (a sonar's field alone applies to every sonar).
///                  "--pings=3" equals "pings=3", except that messages use this name: for programs with such an option.
/// @param log       Receives a warning for each value that a preset's instrument cannot have.
/// @throws Error "path:line:column: ..." for any fault; for an unknown key with the nearest known one.
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& path, std::span<const std::string> settings = {},
                                     const Log& log = {});

/// As load_scenario(), but from text; messages call it "FOLDER/scenario". It has no `file`.
/// @param folder  Base of relative paths; "" for the current folder.
[[nodiscard]] Scenario parse_scenario(const std::string& text, const std::filesystem::path& folder = {},
                                      std::span<const std::string> settings = {}, const Log& log = {});

/// As load_scenario(path), but with the file's text given: for a file that has been read
/// before.
[[nodiscard]] Scenario load_scenario_text(const std::string& text, const std::filesystem::path& path,
                                          std::span<const std::string> settings = {}, const Log& log = {});

/// A column of a trajectory file.
struct TrajectoryColumn {
  std::string name = {};  ///< In the file's header; "" for that of the number.
  std::string unit = {};  ///< s, ms, us, ns, m, cm, mm, km, ft, rad or deg; "" for that in the header, else SI.
  double sign = 1;        ///< 1, or -1 for a depth in place of z, or a yaw to starboard.
};

/// Columns by the number of a waypoint that they are: time, x, y, z, qw, qx, qy, qz, roll, pitch, yaw.
using TrajectoryColumns = std::map<std::string, TrajectoryColumn>;

/// Reads waypoints from a text: values separated by commas, semicolons or white space, under a header that names the
/// columns (.csv), or as in TUM (.tum, .txt: time x y z qx qy qz qw), EuRoC and KITTI files. Lines that begin with #
/// are comments, or the header. See docs/reference/trajectories.md.
/// @param columns  Names, units and signs of columns; those of other names are found by theirs.
/// @param log      Receives warnings about columns that are not read, and rows with equal times, which are skipped.
/// @throws Error "path:line:column: ..." for an invalid number, or one out of limits or order.
[[nodiscard]] Trajectory load_trajectory(const std::filesystem::path& path, const TrajectoryColumns& columns = {},
                                         const Log& log = {});

/// Writes a scenario as text that load_scenario() reads back as the same scenario: settings that differ from
/// defaults, presets as numbers, files by absolute paths. An angle may differ in its last bit, since not all
/// radians convert to degrees and back exactly. Without settings that have no effect or no form in files: those
/// of the other model, a relief given as values (MaterialOverride::relief), head settings of a sonar without a
/// head.
[[nodiscard]] std::string to_yaml(const Scenario& scenario);

/// Assigns a scenario's materials to its world, read by load_scene(scenario.world, world_options(scenario));
/// reads the files of their reliefs.
void assign_scenario_materials(Scene& world, const Scenario& scenario, const Log& log = {});

/// Reads the scene of a scenario and assigns its materials.
[[nodiscard]] Scene load_scene(const Scenario& scenario, const Log& log = {});

/// One number of a preset: where it comes from and how far to trust it.
struct PresetFact {
  std::string field;       ///< As in the file.
  std::string value;       ///< As in the file.
  std::string unit;        ///< Unit of that value; may be "".
  std::string confidence;  ///< A (read in the source), B (data-sheet knowledge, cross-checked) or C (uncertain).
  std::string source;
};
/// Facts about an instrument beyond its SonarConfig.
struct Instrument {
  std::optional<double> range_resolution;  ///< Shortest bin [m].
  int bin_limit = 1000;                    ///< Most bins in a beam.
  std::optional<double> ping_rate_limit;   ///< Most pings a second [Hz].
  std::optional<double> dynamic_range_db;  ///< [dB]
  std::vector<double> bit_depths;          ///< Supported bits per sample.
  std::vector<double> steps;               ///< Supported steps of its head [rad].

  // Duration of its pulse by max_range, where it depends on it: linear between, constant beyond the ends.
  std::vector<double> pulse_ranges;     ///< Increasing [m].
  std::vector<double> pulse_durations;  ///< One per range [s].

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit);
};

struct Preset {
  std::string name;   ///< "tritech-gemini-720i"; a mode is chosen with "preset: NAME" and "mode: MODE".
  std::string title;  ///< "Tritech Gemini 720i"
  std::string default_mode;
  std::vector<std::string> modes;  ///< At least one.
  std::filesystem::path file;
  std::vector<PresetFact> facts;  ///< Facts of the mode it was loaded in.
  Instrument instrument;          ///< In that mode.
  SonarConfig sonar;              ///< In that mode, over its longest range, in water of 1500 m/s.

  /// Sets a sonar's bins, ping period and pulse duration to the instrument's for its range
  /// window: bins of `range_resolution`, or `bin_limit` longer ones; pings at `ping_rate_limit`,
  /// or as fast as the range allows; pulse durations by `pulse_durations`, in whole
  /// microseconds.
  /// @param sound_speed  Sound speed that the sonar assumes [m/s].
  void fit_to_range(SonarConfig& sonar, double sound_speed) const;

  /// A setting of a sonar that the instrument cannot have.
  struct Excess {
    std::string field;  ///< As in files: "max_range", "step_deg".
    std::string text;   ///< " = 15000 m, and a Tritech Gemini 720i reaches 120 m", to follow the field's name.
  };
  [[nodiscard]] std::vector<Excess> exceeded_by(const SonarConfig& sonar) const;
};

/// Names of all presets in alphabetical order: those of the folders that INSONIFY_PRESETS lists (separated by colons)
/// and those shipped with insonify, in the installed or the source tree's `presets`. Of two with the same name, that
/// in the earlier folder is used, INSONIFY_PRESETS first.
/// @throws Error if INSONIFY_PRESETS names something that is not a folder.
[[nodiscard]] std::vector<std::string> preset_names();

/// @param mode  "" for the default.
/// @throws Error with the nearest preset or the available modes; "path:line:column: ..." for an invalid file.
[[nodiscard]] Preset load_preset(const std::string& name, const std::string& mode = "");

struct RecordingOptions {
  bool compress = false;  ///< By HDF5's filters shuffle and deflate: smaller files, more time per ping.
  int threads = 0;        ///< Threads for compression, >= 0; 0: one per processor.
  bool replace = false;   ///< Whether an existing file is replaced.
};

/// Largest size on disk of a recording of that many pings, without compression [bytes].
[[nodiscard]] std::uint64_t recording_bytes(const Scenario& scenario, const SonarConfig& sonar, std::uint64_t pings);

/// Writes one sonar's pings to one HDF5 file, ping by ping. At any moment the file on disk is complete up to the last
/// ping: a killed run leaves a readable file, no larger than its contents.
/// docs/reference/recording.md lists its contents.
///
/// An existing file that may be replaced stays until close(). Until then the new recording is PATH.XXXXXXXX.new, with
/// eight random hexadecimal digits; it stays there if it is never closed and holds a ping.
class Recording final : public PingSink {
 public:
  /// @param scenario  Source of the file's attributes and names, with `scene` and `sonar` (filled in).
  /// @throws Error if the file cannot be made, the disk is full, or `path` exists and may not be
  ///         replaced.
  Recording(const std::filesystem::path& path, const Scenario& scenario, const Scene& scene, const SonarConfig& sonar,
            const RecordingOptions& options = {});
  ~Recording() override;
  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;

  /// @throws Error if the disk is full; earlier pings stay readable.
  void add(const Ping& ping);
  void add(std::size_t /*sonar*/, const Ping& ping) override { add(ping); }

  void mark(const std::vector<Marker>& markers) override;

  /// Flushes everything to disk and replaces an existing file; nothing can be added afterwards. The destructor does the
  /// same without reporting errors, without markers and without replacing an existing file.
  /// @throws Error for a failure of the system.
  void close() override;

  /// Current path of the recording: `path`, or a file beside it until it replaces an existing one.
  [[nodiscard]] const std::filesystem::path& place() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a PNG, 8 bits per channel.  @throws Error with the path.
void write_png(const std::filesystem::path& path, const Picture& picture);

/// Writes a grey PNG of 8 or 16 bits per pixel, with the numbers as they are.
/// @throws Error with the path, also for a number of more bits.
void write_png(const std::filesystem::path& path, const NumberPicture& picture, int bits);

// ---------------------------------------------------------------------------------------------------------------------

template <typename Self, typename Visit>
void Instrument::visit_fields(Self& self, Visit&& visit) {
  visit(Field{"range_resolution", "m", greater_than(0), "Shortest bin."}, self.range_resolution);
  visit(Field{"bin_limit", "", from_to(1, 65536), "Most bins in a beam."}, self.bin_limit);
  visit(Field{"ping_rate_limit", "Hz", greater_than(0), "Most pings a second."}, self.ping_rate_limit);
  visit(Field{"dynamic_range_db", "dB", greater_than(0), "Dynamic range of the receiver."}, self.dynamic_range_db);
  visit(Field{"bit_depths", "", from_to(1, 64), "Bits a sample that it can deliver."}, self.bit_depths);
  visit(Field{"steps", "rad", greater_than(0), "Steps its head can make."}, self.steps);
  visit(Field{"pulse_ranges", "m", greater_than(0), "Values of max_range that pulse_durations are for."},
        self.pulse_ranges);
  visit(Field{"pulse_durations", "s", above_to(0, 1), "Duration of the pulse at each of pulse_ranges."},
        self.pulse_durations);
}

}  // namespace insonify
