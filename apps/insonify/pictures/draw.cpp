// draw.cpp -- insonify draw: draws pictures of a recording's pings.

#include "pictures/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_formats.h"
#include "insonify/recording_info.h"
#include "insonify/stored_tables.h"
#include "pictures/output_folder.h"
#include "pictures/pictures.h"

namespace insonify {
namespace {

PictureChoice choice_of(const DrawOptions& options, const RecordedPings& recording) {
  PictureChoice choice = PictureChoice::parse(options.pictures.pictures);
  for (const std::uint64_t ping : options.pings) {
    if (ping >= recording.ping_count()) {
      throw InputError(fmt::format("{}: --ping {} must be below {}, the number of its pings",
                                   options.recording.string(), ping, recording.ping_count()));
    }
  }
  choice.only = options.pings;
  return choice;
}

EchoModel model_of(const RecordedPings& pings, const std::filesystem::path& file) {
  if (pings.model() != "calibrated" && pings.model() != "paper") {
    throw InputError(
        fmt::format("{}: its attribute model is \"{}\", must be calibrated or paper", file.string(), pings.model()));
  }
  return pings.model() == "paper" ? EchoModel::kPaper : EchoModel::kCalibrated;
}

// Whether an instrument or another program has written them: without settings of the simulator.
bool is_foreign(const RecordedPings& pings) {
  return pings.model().empty() && !pings.foreign_format().empty();
}

// Numbers are drawn as they are: counts of 8 bits from 0 to 255, others up to the greatest of those drawn.
PictureStyle foreign_style(const DrawOptions& options, const RecordedPings& pings, const PictureChoice& choice) {
  if (options.pictures.counts && !pings.has_integers()) {
    throw InputError(
        fmt::format("{}: --counts: there are none in it, its numbers are floating-point", options.recording.string()));
  }
  PictureStyle style = picture_style(options.pictures, EchoModel::kPaper, ReceiverConfig());
  style.waterfall = true;
  if (style.fixed_levels) {
    return style;
  }
  constexpr double kEightBits = 255;
  double greatest = pings.full_scale() == kEightBits ? kEightBits : 0;
  for (std::uint64_t ping = 0; ping < pings.ping_count() && pings.full_scale() != kEightBits; ++ping) {
    if (pings.beam_count() == 1 || choice.takes(ping, pings.ping_count())) {
      greatest = std::max(greatest, std::ranges::max(pings.intensity(ping)));
    }
  }
  style.fixed_levels = true;
  style.display.of_counts = pings.has_integers() && style.display.scale == Scale::kLinear;
  style.display.full_scale = greatest > 0 && std::isfinite(greatest) ? greatest : 1;
  return style;
}

void tell_of_foreign(const RecordedPings& pings, const std::filesystem::path& file) {
  for (const std::vector<std::string>& texts : {pings.notes(), pings.assumed()}) {
    for (const std::string& text : texts) {
      complain(fmt::format("note: {}: {}", file.string(), text));
    }
  }
}

// Labels of a recording that has them.
struct Labels {
  explicit Labels(const DrawOptions& options) : tables(options.recording, options.sonar) {
    if (tables.find("instance") == nullptr || tables.find("material") == nullptr) {
      throw InputError(fmt::format(
          "{}: --masks: there are no labels in it; HDF5 recordings of a scenario with ground_truth: labels have them",
          options.recording.string()));
    }
  }

  [[nodiscard]] std::vector<std::uint16_t> of(const char* layer, std::uint64_t ping) const {
    const StoredTable& table = *tables.find(layer);
    std::vector<std::uint16_t> labels(table.shape.at(1) * table.shape.at(2));
    const std::array<TableSlice, 3> slices{{{ping, 1}, {0, table.shape[1]}, {0, table.shape[2]}}};
    tables.read(table, slices, std::as_writable_bytes(std::span(labels)));
    return labels;
  }

  // Bits that hold every label.
  [[nodiscard]] int bits() const {
    constexpr std::size_t kMostOfEight = 255;
    return std::max(tables.texts("instance_names").size(), tables.texts("material_names").size()) > kMostOfEight ? 16
                                                                                                                 : 8;
  }

  StoredTables tables;
};

struct Recorded {
  RecordedPings pings;
  std::optional<Labels> labels;
  SonarConfig sonar;
  PictureStyle style;
  PictureChoice choice;
  std::filesystem::path folder;  // For the pictures.
};

// Options that have no effect on the pictures of a sonar.
void check_effects(const DrawOptions& options, const RecordedPings& pings, const SonarConfig& sonar) {
  const PictureOptions& given = options.pictures;
  const PictureOptions usual;
  if (sonar.product() == Product::kWaterfall ||
      (is_foreign(pings) && sonar.beam_count == 1 && sonar.product() != Product::kLine)) {
    if (given.pictures != usual.pictures && given.pictures != "all" && given.pictures != "none") {
      complain(fmt::format("note: --pictures {} has no effect on {}: a waterfall shows all pings; --ping chooses them",
                           given.pictures, sonar.name));
    }
    return;
  }
  const std::pair<bool, const char*> waterfalls[] = {{given.corrected, "--corrected"},
                                                     {given.to_scale, "--to-scale"},
                                                     {given.along != usual.along, "--along"},
                                                     {given.line.normalised, "--normalise"},
                                                     {given.line.altitude != usual.line.altitude, "--altitude"},
                                                     {given.line.first_return.has_value(), "--first-return"}};
  for (const auto& [is_given, name] : waterfalls) {
    if (is_given) {
      throw InputError(fmt::format("{} has no effect on {}, only on waterfalls of side-scan sonars", name, sonar.name));
    }
  }
}

// Opens and checks all input; every failure here is an input error.
Recorded open_recording(const DrawOptions& options) {
  const std::filesystem::path& file = options.recording;
  return checked_input([&] {
    RecordedPings pings(file, options.sonar);
    std::optional<Labels> labels;
    if (options.pictures.masks) {
      labels.emplace(options);
    }
    const SonarConfig sonar = pings.sonar_config();
    check_effects(options, pings, sonar);
    const PictureChoice choice = choice_of(options, pings);
    PictureStyle style = is_foreign(pings)
                             ? foreign_style(options, pings, choice)
                             : picture_style(options.pictures, model_of(pings, file), pings.receiver_config(), sonar);
    style.mask_bits = labels ? labels->bits() : 0;
    if (is_side_looking(sonar)) {
      style.waterfall_options.altitudes = altitudes_of(options.pictures.line, pings, file, options.sonar);
    }
    if (!is_foreign(pings) && style.display.of_counts && pings.greatest_count() == 0) {
      throw InputError(fmt::format(
          "{}: --counts: there are none in it; MCAP recordings hold levels only, HDF5 ones both", file.string()));
    }
    if (pings.ping_count() == 0) {
      throw InputError(fmt::format("{}: there is no ping in it", file.string()));
    }
    if (is_foreign(pings)) {
      tell_of_foreign(pings, file);
    } else if (const std::string text = unfinished_text(file, recording_info(file)); !text.empty()) {
      complain("warning: " + text);
    }
    const std::filesystem::path beside = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    const std::filesystem::path folder = output_folder(options.folder.empty() ? beside : options.folder, file);
    if (!options.force) {
      refuse_earlier_pictures(folder, sonar.name);
    }
    return Recorded{std::move(pings), std::move(labels), sonar, style, choice, folder};
  });
}

// Damage that only the ping itself shows is wrong input too.
Ping ping_of(const Recorded& recorded, std::uint64_t number) {
  return checked_input([&] {
    Ping ping = recorded.pings.ping(number);
    if (recorded.style.display.of_counts && !is_foreign(recorded.pings)) {
      const std::vector<double> counts = recorded.pings.counts(number);
      ping.counts.assign(counts.begin(), counts.end());
    }
    if (recorded.labels) {
      ping.instance = recorded.labels->of("instance", number);
      ping.material = recorded.labels->of("material", number);
    }
    return ping;
  });
}

// The first ping of a fan sets the scale for all; a picture of a scan shows all pings so far.
void draw_pings(const Recorded& recorded, PingPictures& pictures) {
  const std::uint64_t count = recorded.pings.ping_count();
  const bool scans = recorded.sonar.product() == Product::kLine;
  const bool side_by_side =
      recorded.sonar.product() == Product::kWaterfall || (recorded.style.waterfall && recorded.sonar.beam_count == 1);
  const bool all = scans || (side_by_side && recorded.choice.only.empty());
  for (std::uint64_t number = 0; number < count; ++number) {
    if (all || (number == 0 && !side_by_side) || recorded.choice.takes(number, count)) {
      pictures.add(0, ping_of(recorded, number));
    }
  }
  pictures.close();
}

// The names of masks' pixels: the first, of 0, is null.
void write_names(const std::filesystem::path& path, const Labels& labels) {
  nlohmann::ordered_json names;
  for (const char* layer : {"instance", "material"}) {
    names[layer] = {nullptr};
    for (const std::string& name : labels.tables.texts(layer + std::string("_names"))) {
      names[layer].push_back(name);
    }
  }
  constexpr bool kAscii = false;
  std::ofstream file(path, std::ios::binary);
  file << names.dump(2, ' ', kAscii, nlohmann::ordered_json::error_handler_t::replace) << '\n';
  file.close();
  if (!file) {
    throw Error(fmt::format("{}: cannot write", path.string()));
  }
}

void draw_sonar(const DrawOptions& options) {
  const Recorded recorded = open_recording(options);
  const std::string& name = recorded.sonar.name;
  make_output_folder(recorded.folder);
  PictureFolder into(recorded.folder, {name});
  PingPictures pictures(into, recorded.sonar, recorded.style, recorded.choice, recorded.pings.ping_count());
  draw_pings(recorded, pictures);
  into.put_in_place();
  if (recorded.labels) {
    write_names(recorded.folder / (name + "_labels.json"), *recorded.labels);
  }
  for (const std::filesystem::path& file : pictures.files()) {
    say("{}\n", file.string());
  }
  if (const std::string text = pictures.darkness_text(); !text.empty()) {
    complain("warning: " + text);
  }
}

}  // namespace

int draw(const DrawOptions& options) {
  std::vector<std::string> sonars;  // All of a foreign file, unless one is chosen.
  if (options.sonar.empty() && is_foreign_recording(options.recording)) {
    sonars = checked_input([&] { return RecordedPings(options.recording).sonars(); });
  }
  if (sonars.empty()) {
    sonars.push_back(options.sonar);
  }
  for (DrawOptions one = options; const std::string& sonar : sonars) {
    one.sonar = sonar;
    draw_sonar(one);
  }
  return kDone;
}

void add_draw_options(const Command& command, DrawOptions& options) {
  command.option("-o,--output", "DIR", &options.folder, "Folder for the pictures, made if missing [RECORDING's own]",
                 not_empty("a folder, or . for this one"));
  command.option("--pictures", "N", &options.pictures.pictures, "Pings to draw: all, last, none or how many [20]");
  command.option("--ping", "N", &options.pings, "Ping to draw, from 0; may be repeated [those of --pictures]",
                 whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command.flag("-f,--force", &options.force, "Replace existing pictures of this sonar");
  add_picture_options(command.under("Pictures"), options.pictures);
  add_counts_option(command.under("Pictures"), options.pictures);
  add_waterfall_options(command.under("Waterfalls of side-scan sonars"), options.pictures);
  command.under("Pictures")
      .flag("--plain", &options.pictures.plain, "No title, axes and colour bar; without --height one pixel a bin");
  command.under("Pictures")
      .flag("--masks", &options.pictures.masks,
            "Plain pictures, and beside each the instance and the material of every pixel");
}

void add_draw(const Command& program) {
  const Command command = program.add("draw", "Draw the pings of a recording or of an instrument's file");
  auto& options = command.keep<DrawOptions>();
  command.argument("RECORDING", &options.recording,
                   fmt::format("Recording ({}) that insonify run or export has made, file of an instrument or arrays "
                               "({}), or grey picture ({})",
                               readable_recordings(), foreign_recordings(), kPictureEndings));
  command.option("--sonar", "NAME", &options.sonar, "Which sonar of a recording that has several");
  add_draw_options(command, options);
  command.footer(
      std::string(kDrawOrReplay) +
      "\nDraws the pictures that insonify run draws, without simulating anything: NAME_fan_0000.png and\n"
      "NAME_polar_0000.png of a fan, NAME_scan.png and NAME_polar.png of a scanning sonar, NAME_waterfall.png of a\n"
      "side-scan sonar. With --masks also NAME_instance_fan_0000.png, NAME_material_fan_0000.png and so on: grey,\n"
      "0 for no echo, else the number of a name in NAME_labels.json.\n\n"
      "Examples:\n"
      "  insonify draw out/fls.h5 -o pictures --levels -90:-40\n"
      "  insonify draw dive.raw -o pictures --ping 0\n"
      "  insonify draw line.xtf -o pictures --corrected --altitude stored --to-scale\n"
      "  insonify draw out/fls.h5 -o plain --plain --pictures all\n"
      "  insonify draw out/fls.h5 -o labelled --masks --height 480 --colour-map grey\n"
      "  insonify draw out/fls.mcap -o pictures --ping 3 --colour-map copper --height 1080");
  command.act([&options] { return draw(options); });
}

}  // namespace insonify
