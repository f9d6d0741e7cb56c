// files.h -- reads and writes files: scenes, scenarios, presets, recordings and pictures.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "insonify/log.h"
#include "insonify/mesh.h"
#include "insonify/picture.h"
#include "insonify/ping.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// Reads a mesh file (OBJ, STL, DAE, PLY, glTF, GLB by ending), cleaned (clean_mesh) and in metres, z up: DAE units are
/// applied and its up axis left alone as Gazebo does; glTF is turned from y up. What was dropped is told to `log`.
/// @throws Error with the path for a file that is missing, unreadable, empty or of an unknown kind.
[[nodiscard]] Mesh load_mesh(const std::filesystem::path& path, const Log& log = {});

/// Reads heights: 16- or 8-bit grey PNG (0..1 over its full scale, spacing 1 m), ESRI ASCII grid (.asc) or BAG (.bag,
/// depths as negative heights). Geographic spacing (degrees) becomes metres at the grid's own latitude.
/// @throws Error with the path, and for text the line.
[[nodiscard]] HeightGrid load_height_grid(const std::filesystem::path& path, const Log& log = {});

/// How to read an SDF world or a Stonefish scenario; other files have none of these.
struct WorldOptions {
  bool collisions = false;  ///< Take collision shapes instead of visuals.
  /// Whether a part that is missing or cannot be read (an included model, a mesh, a height grid, a faulty joint) is an
  /// error; else it is left out, and one warning lists all such parts.
  bool strict = false;
  /// Patterns of the names of models, links, visuals and collisions to leave out: `*` stands for any text, `?` for one
  /// character. A pattern applies to the name in full ("tank::walls::north") and to its last part ("north"). One that
  /// applies to nothing is told to the log.
  std::vector<std::string> ignore = {};

  bool operator==(const WorldOptions&) const = default;
};

/// The options that a scenario has for its world.
[[nodiscard]] WorldOptions world_options(const Scenario& scenario);

/// Reads what a scenario calls its world: an SDF world or model (.sdf, .world, .xml), a Stonefish scenario (.scn), a
/// mesh file, or a height grid. Materials are not assigned yet.
/// @throws Error with the path, for SDF and Stonefish "path:line:column: ..."; also when nothing is left to insonify.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, const WorldOptions& options = {},
                               const Log& log = {});

/// Reads a scenario. Relative paths are from its own folder; presets are looked up by name (load_preset). A scenario
/// without `sonars` whose world is a Stonefish scenario, or an SDF file with sonars in it, has the sonars of that; a
/// Stonefish scenario (.scn) or an SDF file itself is read as one that names it as its world.
/// @param settings  "key=value" as on the command line, applied in order: "pings=3", "sonars[0].max_range=30",
///                  "sonars.fls.max_range=30", "max_range=30" (a sonar's field alone means every sonar's). "--pings=3"
///                  is the same as "pings=3", but messages name it so: for programs that have such an option.
/// @param log       Takes a warning for each value that the instrument of a preset cannot have.
/// @throws Error "path:line:column: ..." for whatever is wrong; an unknown key names the nearest known one.
[[nodiscard]] Scenario load_scenario(const std::filesystem::path& path, std::span<const std::string> settings = {},
                                     const Log& log = {});

/// Reads a scenario from text, as load_scenario() from a file; messages call it "FOLDER/scenario". It has no `file`.
/// @param folder  Where relative paths are from; "" for the current one.
[[nodiscard]] Scenario parse_scenario(const std::string& text, const std::filesystem::path& folder = {},
                                      std::span<const std::string> settings = {}, const Log& log = {});

/// Reads a scenario from text as if `path`, whose folder relative paths are from, held it: load_scenario() of a file
/// that has been read before.
[[nodiscard]] Scenario load_scenario_text(const std::string& text, const std::filesystem::path& path,
                                          std::span<const std::string> settings = {}, const Log& log = {});

/// Reads waypoints from a CSV file (.csv; its header names the columns time, x, y, z and qw, qx, qy, qz or roll, pitch,
/// yaw or roll_deg, pitch_deg, yaw_deg) or a TUM file (.tum, .txt: time x y z qx qy qz qw). Lines that begin with # are
/// comments. docs/reference/trajectories.md says all.
/// @throws Error "path:line:column: ..." for what is no number, out of limits or out of order.
[[nodiscard]] Trajectory load_trajectory(const std::filesystem::path& path);

/// Writes a scenario as the text of a scenario file that load_scenario() reads back as the same: what differs from the
/// defaults, presets as the numbers they stand for, files by their absolute paths. An angle may differ in its last bit,
/// as not every number of radians is that of a number of degrees. What has no effect or no form in files is left out:
/// settings of the other model, a relief given as values (MaterialOverride::relief), the head's settings of a sonar
/// that has none.
[[nodiscard]] std::string to_yaml(const Scenario& scenario);

/// Assigns a scenario's materials to its world, which load_scene(scenario.world, world_options(scenario)) has read;
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
/// What is known of an instrument beside its SonarConfig.
struct Instrument {
  std::optional<double> range_resolution;  ///< Shortest bin [m].
  int bin_limit = 1000;                    ///< Most bins in a beam.
  std::optional<double> ping_rate_limit;   ///< Most pings a second [Hz].
  std::optional<double> dynamic_range_db;  ///< [dB]
  std::vector<double> bit_depths;          ///< Bits a sample that it can deliver.
  std::vector<double> steps;               ///< Steps its head can make [rad].

  // Duration of its pulse by max_range, where it depends on it: linear between, constant beyond the ends.
  std::vector<double> pulse_ranges;     ///< Rising [m].
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

  /// Gives a sonar the bins, the ping period and the duration of the pulse that the instrument has over its range
  /// window: bins of `range_resolution` as far as `bin_limit` allows, else `bin_limit` longer ones; pings at
  /// `ping_rate_limit` as far as the range allows; the duration of the pulse by `pulse_durations`, in whole
  /// microseconds.
  /// @param sound_speed  The one the sonar assumes [m/s].
  void fit_to_range(SonarConfig& sonar, double sound_speed) const;

  /// A setting of a sonar that the instrument cannot have.
  struct Excess {
    std::string field;  ///< As in files: "max_range", "step_deg".
    std::string text;   ///< " = 15000 m, and a Tritech Gemini 720i reaches 120 m", to follow the field's name.
  };
  [[nodiscard]] std::vector<Excess> exceeded_by(const SonarConfig& sonar) const;
};

/// Names of all presets in alphabetical order: those of the folders that INSONIFY_PRESETS lists (separated by colons)
/// and those shipped with insonify, in the installed or the source tree's `presets`. Of two with the same name the one
/// of the earlier folder counts, INSONIFY_PRESETS first.
/// @throws Error where INSONIFY_PRESETS names something that is no folder.
[[nodiscard]] std::vector<std::string> preset_names();

/// @param mode  "" for the default.
/// @throws Error naming the nearest preset or the modes there are; "path:line:column: ..." for a file that is wrong.
[[nodiscard]] Preset load_preset(const std::string& name, const std::string& mode = "");

struct RecordingOptions {
  bool compress = false;  ///< By HDF5's filters shuffle and deflate: smaller files, more time per ping.
  int threads = 0;        ///< Threads that compress, >= 0; 0 for as many as there are processors.
  bool replace = false;   ///< Whether the recording may take the place of a file that is there already.
};

/// Bytes on the disk that a recording of that many pings needs at most, without compression.
[[nodiscard]] std::uint64_t recording_bytes(const Scenario& scenario, const SonarConfig& sonar, std::uint64_t pings);

/// Writes one sonar's pings to one HDF5 file, ping by ping. At any moment the file on disk is complete up to the last
/// ping: a killed run leaves a file that opens as usual, no larger than what it holds.
/// docs/reference/recording.md lists its contents.
///
/// Where a file is there already and may be replaced, it stays until close(). The new recording is PATH.XXXXXXXX.new
/// until then, with eight random hexadecimal digits, and stays there if it is never closed and holds a ping.
class Recording {
 public:
  /// @param scenario  With `scene` and `sonar`, which has everything filled in, the source of the file's attributes and
  ///                  names.
  /// @throws Error when the file cannot be made, the disk is full, or `path` is there and may not be replaced.
  Recording(const std::filesystem::path& path, const Scenario& scenario, const Scene& scene, const SonarConfig& sonar,
            const RecordingOptions& options = {});
  ~Recording();
  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;

  /// @throws Error when the disk is full; what was written before stays readable.
  void add(const Ping& ping);

  /// Has the system put everything on the disk and replaces the earlier file, if there is one; nothing more can be
  /// added. The destructor does the same without reporting errors, but leaves an earlier file where it is.
  /// @throws Error when the system could not.
  void close();

  /// Where the recording is now: `path`, or beside it until it replaces an earlier file.
  [[nodiscard]] const std::filesystem::path& place() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a PNG, 8 bits a channel.  @throws Error with the path.
void write_png(const std::filesystem::path& path, const Picture& picture);

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
