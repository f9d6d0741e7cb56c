// mosaic.cpp -- insonify mosaic: lays lines of side-scan sonars onto a chart.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/draw_mosaic.h"
#include "insonify/files.h"
#include "insonify/mosaic_files.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_formats.h"
#include "insonify/stored_tables.h"
#include "pictures/altitudes.h"
#include "pictures/picture_options.h"

namespace insonify {
namespace {

struct MosaicCommand {
  std::vector<std::filesystem::path> recordings, data;
  std::filesystem::path file;
  std::string sonar, origin, rule = "best";
  std::optional<double> cell = {};
  bool force = false;
  LineOptions line;
  PictureOptions pictures;
};

// A recording that is open, as a line.
struct OpenLine {
  OpenLine(std::filesystem::path path, const std::string& sonar)
      : file(std::move(path)), pings(file, sonar), tables(file, sonar) {
    labels = tables.find("instance");
  }

  [[nodiscard]] Ping ping(std::uint64_t number) const {
    Ping ping = pings.ping(number);
    if (own && chart) {
      const double height = ping.world_from_sonar.position.z();
      ping.world_from_sonar.position = chart->local(own->geographic(ping.world_from_sonar.position));
      ping.world_from_sonar.position.z() = height;
    }
    if (labels != nullptr) {
      ping.instance.resize(ping.intensity.size());
      const std::array<TableSlice, 3> slices{{{number, 1}, {0, labels->shape.at(1)}, {0, labels->shape.at(2)}}};
      tables.read(*labels, slices, std::as_writable_bytes(std::span(ping.instance)));
    }
    return ping;
  }

  [[nodiscard]] bool is_foreign() const { return pings.model().empty() && !pings.foreign_format().empty(); }

  // What its intensities are: they share a scale of colours with others of their kind alone.
  [[nodiscard]] std::string kind() const {
    return !is_foreign()
               ? pings.model() == "paper" ? "levels of the paper's model" : "intensities (dB re source at 1 m)"
           : pings.has_integers() ? fmt::format("counts from 0 to {:.0f}", pings.full_scale())
                                  : "numbers of its own";
  }

  std::filesystem::path file;
  RecordedPings pings;
  StoredTables tables;
  const StoredTable* labels = nullptr;
  std::optional<LocalGrid> own, chart;  // Its world and the chart's on the Earth, where both are known.
};

// What the cells lie on the Earth by: the option, else what the first file says.
std::optional<GeographicPoint> origin_of(const MosaicCommand& options, const std::vector<OpenLine>& lines) {
  const std::optional<GeographicPoint> origin =
      options.origin.empty() ? lines.front().pings.origin() : parsed_origin(options.origin);
  if (origin) {
    check_origin(*origin);
  }
  return origin;
}

void check_kinds(const std::vector<OpenLine>& lines) {
  for (const OpenLine& line : lines) {
    if (line.kind() != lines.front().kind()) {
      throw InputError(fmt::format("{} has {}, {} has {}: they cannot share a chart", lines.front().file.string(),
                                   lines.front().kind(), line.file.string(), line.kind()));
    }
  }
}

// Lays lines that say where they are on the Earth into the chart's world, that of `origin`.
void place_lines(const MosaicCommand& options, std::vector<OpenLine>& lines,
                 const std::optional<GeographicPoint>& origin) {
  const auto knows = [](const OpenLine& line) { return line.pings.origin().has_value(); };
  const auto unknown = std::ranges::find_if_not(lines, knows), known = std::ranges::find_if(lines, knows);
  if (options.origin.empty() && unknown != lines.end() && known != lines.end()) {
    throw InputError(fmt::format("{} says where it lies on the Earth, {} does not: --origin LAT,LON says it",
                                 known->file.string(), unknown->file.string()));
  }
  for (OpenLine& line : lines) {
    if (const std::optional<GeographicPoint> own = line.pings.origin(); own && origin) {
      line.own.emplace(*own);
      line.chart.emplace(*origin);
    } else if (line.is_foreign() && lines.size() > 1) {
      complain(
          fmt::format("note: {}: its places begin at its first ping; where that lies in the other recordings is "
                      "not known",
                      line.file.string()));
    }
  }
}

void tell_notes(const std::vector<OpenLine>& lines) {
  for (const OpenLine& line : lines) {
    for (const std::string& note : line.pings.notes()) {
      complain(fmt::format("note: {}: {}", line.file.string(), note));
    }
  }
}

PictureStyle style_of(const MosaicCommand& options, const OpenLine& line) {
  if (!line.is_foreign()) {
    return picture_style(options.pictures, line.pings.model() == "paper" ? EchoModel::kPaper : EchoModel::kCalibrated,
                         line.pings.receiver_config());
  }
  PictureStyle style = picture_style(options.pictures, EchoModel::kPaper, ReceiverConfig());
  style.display.of_counts = line.pings.has_integers() && style.display.scale == Scale::kLinear;
  return style;
}

void refuse_existing(const MosaicCommand& options) {
  std::vector<std::filesystem::path> files = options.data;
  files.push_back(options.file);
  for (const std::filesystem::path& file : files) {
    std::error_code ignored;
    if (!options.force && std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) {
      throw InputError(fmt::format("{} exists already: --force replaces it", file.string()));
    }
  }
  for (const std::filesystem::path& file : options.data) {
    const std::string ending = file.extension().string();
    if (ending != ".npz" && ending != ".tif" && ending != ".asc") {
      throw InputError(fmt::format("--data {}: must end in {}", file.string(), kMosaicEndings));
    }
  }
  if (options.file.extension() != ".png") {
    throw InputError(fmt::format("--output {}: must end in .png", options.file.string()));
  }
}

std::vector<OpenLine> open_lines(const MosaicCommand& options) {
  return checked_input([&] {
    std::vector<OpenLine> lines;
    for (const std::filesystem::path& file : options.recordings) {
      lines.emplace_back(file, options.sonar);
      lines.back().labels = lines.back().tables.find("instance");
      if (!is_side_looking(lines.back().pings.sonar_config())) {
        throw InputError(fmt::format("{}: {} is not a side-scan sonar", file.string(), lines.back().pings.sonar()));
      }
    }
    return lines;
  });
}

Mosaic mosaic_of(const MosaicCommand& options, const std::vector<OpenLine>& lines, double raised_per_decade) {
  return checked_input([&] {
    std::vector<MosaicLine> given;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const OpenLine& line = lines[i];
      const SonarConfig sonar = line.pings.sonar_config();
      given.push_back(
          {.sonar = sonar,
           .ping_count = line.pings.ping_count(),
           .ping = [&line, sonar, raised_per_decade](
                       std::uint64_t number) { return raised_by_range(line.ping(number), sonar, raised_per_decade); },
           .altitudes = altitudes_of(options.line, line.pings, options.recordings[i], options.sonar)});
    }
    return make_mosaic(given, {.cell = options.cell.value_or(0),
                               .rule = options.rule == "latest" ? MosaicRule::kLatest
                                       : options.rule == "mean" ? MosaicRule::kMean
                                                                : MosaicRule::kBest,
                               .normalised = options.line.normalised,
                               .bottom = bottom_options(options.line)});
  });
}

void write_world_file(const Mosaic& mosaic, const std::filesystem::path& picture,
                      const std::optional<GeographicPoint>& origin) {
  std::filesystem::path path = picture;
  path.replace_extension(".pgw");
  std::ofstream file(path, std::ios::binary);
  file << world_file_text(mosaic, origin);
  file.close();
  if (!file) {
    throw Error(fmt::format("{}: cannot write", path.string()));
  }
  say("{}\n", path.string());
}

int mosaic_command(const MosaicCommand& options) {
  refuse_existing(options);
  std::vector<OpenLine> lines = open_lines(options);
  check_kinds(lines);
  PictureStyle style = checked_input([&] { return style_of(options, lines.front()); });
  const std::optional<GeographicPoint> origin = checked_input([&] { return origin_of(options, lines); });
  checked_input([&] {
    place_lines(options, lines, origin);
    tell_notes(lines);
    return kDone;
  });
  const Mosaic mosaic = mosaic_of(options, lines, style.display.raised_per_decade);
  if (!style.fixed_levels) {
    style.display.full_scale = fitting_full_scale(mosaic);
  }
  std::uint64_t pings = 0;
  for (const OpenLine& line : lines) {
    pings += line.pings.ping_count();
  }
  const MosaicTitle title{
      options.recordings.front().stem().string(),
      fmt::format("{}   {}   cells of {:.3g} m", counted(static_cast<std::uint64_t>(mosaic.line_count), "line"),
                  counted(pings, "ping"), mosaic.cell),
      lines.front().tables.texts("instance_names")};
  write_png(options.file, draw_mosaic(mosaic, title, style.display));
  say("{}\n", options.file.string());
  if (options.pictures.plain && style.display.pixel_per_bin) {
    write_world_file(mosaic, options.file, origin);
  }
  for (const std::filesystem::path& file : options.data) {
    write_mosaic(mosaic, file, origin, title.instances);
    say("{}\n", file.string());
  }
  return kDone;
}

}  // namespace

void add_mosaic(const Command& program) {
  const Command command = program.add("mosaic", "Lay lines of side-scan sonars onto a chart of the bed");
  auto& options = command.keep<MosaicCommand>();
  command.argument("RECORDING", &options.recordings,
                   fmt::format("Lines of side-scan sonars: recordings ({}) or files of instruments ({})",
                               readable_recordings(), foreign_recordings()));
  command.option("-o,--output", "FILE", &options.file, "Picture of the chart, a .png",
                 not_empty("a file, such as mosaic.png"));
  command.require("--output");
  command.option("--data", "FILE", &options.data,
                 fmt::format("Also the cells, in the format of FILE's ending: {}; may be repeated", kMosaicEndings));
  command.option("--sonar", "NAME", &options.sonar, "Which sonar of recordings that have several");
  command.option("--cell", "M", &options.cell, "Side of a cell in metres [two bins]", number_within(above_to(0, 1e4)));
  command.option(
      "--rule", "NAME", &options.rule,
      "Which of several lines a cell shows: best (angle to the bed nearest to 30 degrees), latest or mean [best]",
      one_of({"best", "latest", "mean"}));
  command.option(
      "--origin", "LAT,LON", &options.origin,
      "Place of the chart's origin on the Earth, and of recordings that do not say theirs [what the first file "
      "says]",
      origin());
  command.flag("-f,--force", &options.force, "Replace existing files");
  add_line_options(command, options.line);
  add_picture_options(command.under("Pictures"), options.pictures);
  command.under("Pictures")
      .flag("--plain", &options.pictures.plain,
            "No title, axes and colour bar; without --height one pixel a cell, with a world file (.pgw)");
  command.footer(
      "x of the world is east, y north. Ground truth is drawn beside the mosaic where recordings have labels.\n\n"
      "Examples:\n"
      "  insonify mosaic out/sss.h5 -o mosaic.png\n"
      "  insonify mosaic line1.xtf line2.xtf -o wreck.png --data wreck.tif --normalise\n"
      "  insonify mosaic out/sss.h5 -o mosaic.png --data mosaic.npz --altitude true --cell 0.1");
  command.act([&options] { return mosaic_command(options); });
}

}  // namespace insonify
