// grid.cpp -- insonify grid: makes a chart of the soundings of multibeams.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "grid/recorded_bed.h"
#include "insonify/bed_heights.h"
#include "insonify/draw_sounding_grid.h"
#include "insonify/files.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_formats.h"
#include "insonify/sound_speed_files.h"
#include "insonify/sounding_grid_files.h"
#include "insonify/survey/bottom_track.h"

namespace insonify {
namespace {

struct GridCommand {
  std::vector<std::filesystem::path> recordings, files;
  std::filesystem::path folder, profile;
  std::string sonar, origin, method = "mean", detection = "both";
  std::optional<double> cell = {}, datum = {};
  double outliers = 4, least_quality = 0;
  int fill = 0, height = 900;
  bool no_truth = false, force = false;
};

// All soundings of the recordings, and what the chart says of them.
struct RecordedSoundings {
  std::vector<PlacedSounding> soundings;
  std::uint64_t pings = 0;
  double highest_sonar = -std::numeric_limits<double>::infinity();  // [m]
  std::optional<GeographicPoint> origin = {};                       // What the first file says.
};

void check_files(const GridCommand& options) {
  for (const std::filesystem::path& file : options.files) {
    const std::string ending = file.extension().string();
    if (ending != ".png" && ending != ".bag" && ending != ".tif" && ending != ".asc" && ending != ".npz") {
      throw InputError(fmt::format("--output {}: must end in .png, {}", file.string(), kSoundingGridEndings));
    }
    std::error_code ignored;
    if (!options.force && std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) {
      throw InputError(fmt::format("{} exists already: --force replaces it", file.string()));
    }
  }
}

std::vector<RecordedPings> open_multibeams(const GridCommand& options) {
  std::vector<RecordedPings> multibeams;
  for (const std::filesystem::path& file : options.recordings) {
    const RecordedPings& pings = multibeams.emplace_back(file, options.sonar);
    if (!pings.has_soundings()) {
      throw Error(fmt::format("{}: {}", file.string(),
                              is_side_looking(pings.sonar_config())
                                  ? pings.sonar() + " is a side-scan sonar: insonify mosaic lays its lines onto a chart"
                                  : pings.sonar() + " has no soundings; multibeams (type: mbes) have"));
    }
  }
  return multibeams;
}

RecordedSoundings read_soundings(const GridCommand& options, const std::vector<RecordedPings>& multibeams,
                                 double datum) {
  constexpr double kUsualSpeed = 1500;  // By which ranges are shown where the recording does not say [m/s].
  std::optional<SoundSpeedProfile> profile;
  if (!options.profile.empty()) {
    profile.emplace(load_sound_speed_profile(options.profile, log_to_user(true)), options.profile.string());
  }
  RecordedSoundings read;
  for (const RecordedPings& pings : multibeams) {
    const double shown_speed = pings.sonar_config().assumed_sound_speed.value_or(kUsualSpeed);
    for (std::uint64_t ping = 0; ping < pings.ping_count(); ++ping) {
      const Pose pose = pings.pose(ping);
      if (profile) {
        place_soundings(pings.soundings(ping), pose, *profile, datum, shown_speed, read.soundings);
      } else {
        place_soundings(pings.soundings(ping), pose, read.soundings);
      }
      read.highest_sonar = std::max(read.highest_sonar, pose.position.z());
    }
    read.pings += pings.ping_count();
  }
  read.origin = multibeams.front().origin();
  return read;
}

SoundingGridOptions grid_options(const GridCommand& options) {
  return {.cell = options.cell.value_or(0),
          .method = options.method == "median"  ? GridMethod::kMedian
                    : options.method == "shoal" ? GridMethod::kShoal
                                                : GridMethod::kMean,
          .outliers = options.outliers,
          .fill = options.fill,
          .least_quality = options.least_quality,
          .only = options.detection == "amplitude" ? std::optional(Detection::kAmplitude)
                  : options.detection == "phase"   ? std::optional(Detection::kPhase)
                                                   : std::nullopt};
}

template <typename Value>
Value median_of(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::vector<Row> grid_rows(const SoundingGrid& grid, double datum) {
  std::vector<std::uint32_t> counts;
  std::vector<float> uncertainties;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t cell = 0; cell < grid.height.size(); ++cell) {
    if (grid.count[cell] > 0) {
      counts.push_back(grid.count[cell]);
      uncertainties.push_back(grid.uncertainty[cell]);
      low = std::min(low, static_cast<double>(grid.height[cell]) - datum);
      high = std::max(high, static_cast<double>(grid.height[cell]) - datum);
    }
  }
  const bool below = high < 0;
  return {
      {"soundings", fmt::format("{}, {} left out, {} refused as outliers", grid.given, grid.left_out, grid.refused)},
      {"cells", fmt::format("{} x {} of {:.6g} m; {} with soundings, {} in half of them or more; {} filled",
                            grid.columns, grid.rows, grid.cell, counts.size(), median_of(counts), grid.filled)},
      {below ? "depth" : "height", fmt::format("{:.2f} to {:.2f} m", below ? -high : low, below ? -low : high)},
      {"uncertainty", fmt::format("{:.3f} m (1 sigma, median)", median_of(uncertainties))}};
}

std::vector<Row> error_rows(const SoundingGrid& grid, double datum, const std::string& why) {
  if (grid.truth.empty()) {
    return why.empty() ? std::vector<Row>()
                       : std::vector<Row>{{"truth", why + " (--folder DIR names the scenario's folder)"}};
  }
  const std::optional<GridErrors> errors = errors_of(grid, datum);
  if (!errors) {
    return {{"truth", "there is no bed below the soundings"}};
  }
  const auto percent = [](double share) { return fmt::format("{:.1f} %", 100 * share); };
  return {{"truth", fmt::format("mean difference {:+.3f} m, standard deviation {:.3f} m, 95 % within {:.3f} m",
                                errors->mean, errors->deviation, errors->within_95)},
          {"S-44", fmt::format("exclusive order {}, special order {}, order 1a {} of cells", percent(errors->exclusive),
                               percent(errors->special), percent(errors->order_1a))}};
}

void write_files(const GridCommand& options, const SoundingGrid& grid, const RecordedSoundings& read, double datum) {
  const std::optional<GeographicPoint> origin = options.origin.empty() ? read.origin : parsed_origin(options.origin);
  const std::string name = options.recordings.front().stem().string();
  for (const std::filesystem::path& file : options.files) {
    if (file.extension() == ".png") {
      const SoundingGridTitle title{
          name, fmt::format("{}   {}   {} in cells of {:.3g} m", counted(options.recordings.size(), "recording"),
                            counted(read.pings, "ping"), options.method, grid.cell)};
      write_png(file, draw_sounding_grid(grid, title, datum, options.height));
    } else {
      write_sounding_grid(grid, file, {.origin = origin, .datum = datum, .title = name});
    }
    say("{}\n", file.string());
  }
}

int grid_command(const GridCommand& options) {
  check_files(options);
  if (!options.origin.empty()) {
    checked_input([&] { check_origin(*parsed_origin(options.origin)); });
  }
  const std::vector<RecordedPings> multibeams = checked_input([&] { return open_multibeams(options); });
  const RecordedBed bed =
      checked_input([&] { return recorded_bed(options.recordings, options.sonar, options.folder); });
  const bool has_surface = bed.scenario && bed.scenario->surface;
  const double datum = options.datum.value_or(has_surface ? bed.scenario->surface->level : 0);
  const RecordedSoundings read = checked_input([&] { return read_soundings(options, multibeams, datum); });
  SoundingGrid grid = checked_input([&] { return make_sounding_grid(read.soundings, grid_options(options)); });
  if (bed.scene && !options.no_truth) {
    grid.truth = true_heights(grid, *bed.scene, read.highest_sonar);
  }
  std::vector<Row> rows = grid_rows(grid, datum);
  std::ranges::copy(error_rows(grid, datum, options.no_truth ? "" : bed.why), std::back_inserter(rows));
  print_table(rows);
  write_files(options, grid, read, datum);
  return kDone;
}

}  // namespace

void add_grid(const Command& program) {
  const Command command = program.add("grid", "Make a chart of the soundings of multibeams");
  auto& options = command.keep<GridCommand>();
  command.argument("RECORDING", &options.recordings,
                   fmt::format("Recordings of multibeams ({})", readable_recordings()));
  command.option("-o,--output", "FILE", &options.files,
                 fmt::format("Chart in the format of FILE's ending: .png, {}; may be repeated", kSoundingGridEndings),
                 not_empty("a file, such as chart.png"));
  command.require("--output");
  command.one_at_a_time("--output");
  command.option("--sonar", "NAME", &options.sonar, "Which sonar of recordings that have several");
  command.option("--cell", "M", &options.cell, "Side of a cell in metres [by the density of soundings]",
                 number_within(above_to(0, 1e4)));
  command.option(
      "--method", "NAME", &options.method,
      "Height of a cell: mean (weighted by the soundings' uncertainty), median or shoal (the highest) [mean]",
      one_of({"mean", "median", "shoal"}));
  command.option("--outliers", "SIGMAS", &options.outliers,
                 "Refuse soundings farther from the median of their cell; 0 for none [4]",
                 number_within(from_to(0, 1e6)));
  command.option("--fill", "CELLS", &options.fill, "Interpolate over gaps of at most this width [0]",
                 whole_number(0, 1000));
  command.option("--least-quality", "Q", &options.least_quality, "Leave out soundings of a lower quality factor [0]",
                 number_within(from_to(0, 100)));
  command.option("--detection", "NAME", &options.detection, "Soundings by amplitude, by phase or both [both]",
                 one_of({"both", "amplitude", "phase"}));
  command.option("--datum", "Z", &options.datum,
                 "Height in the world from which depths count [level of the scenario's surface, else 0]",
                 number_within(coordinate()));
  command.option("--profile", "FILE", &options.profile,
                 "Sound-speed cast that bends the rays (.csv, .svp, .asvp), with depths from the datum [straight rays]",
                 not_empty("a file, such as cast.svp"));
  command.option("--origin", "LAT,LON", &options.origin,
                 "Place of the world's origin on the Earth, for .bag and .tif [what the first file says]", origin());
  command.option("--folder", "DIR", &options.folder,
                 "Folder that the files of the recorded scenario are relative to, for the true bed [looked for]",
                 existing_folder());
  command.flag("--no-truth", &options.no_truth, "Do not compare with the true bed");
  command.option("--height", "N", &options.height, "Height of the picture [900]", whole_number(240, 8192));
  command.flag("-f,--force", &options.force, "Replace existing files");
  command.footer(
      "Prints how the chart differs from the true bed where the recorded scenario's world is found.\n\n"
      "Examples:\n"
      "  insonify grid out/head.h5 -o chart.png\n"
      "  insonify grid line1.h5 line2.h5 -o chart.png -o chart.bag --cell 0.5 --origin 54.2,7.9\n"
      "  insonify grid out/head.h5 -o shoal.tif --method shoal --outliers 0");
  command.act([&options] { return grid_command(options); });
}

}  // namespace insonify
