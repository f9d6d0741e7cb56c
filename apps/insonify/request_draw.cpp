// request_draw.cpp -- options of `insonify draw`.

#include <limits>

#include "console/validators.h"
#include "request.h"

namespace insonify {
void add_draw_options(CLI::App& command, DrawOptions& options) {
  command.add_option("-o,--output", options.folder, "Folder for the pictures, made if missing [RECORDING's own]")
      ->check(not_empty("a folder, or . for this one"))
      ->type_name("DIR");
  command.add_option("--pictures", options.pictures.pictures, "Pings to draw: all, last, none or how many [20]")
      ->type_name("N");
  command.add_option("--ping", options.pings, "Ping to draw, from 0; may be repeated [those of --pictures]")
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("N")
      ->expected(1)
      ->take_all();
  command.add_flag("-f,--force", options.force, "Replace existing pictures of this sonar");
  add_picture_options(command, options.pictures, "Pictures");
  add_counts_option(command, options.pictures, "Pictures");
}

void add_draw(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("draw", "Draw pictures of a recording's pings");
  DrawOptions& options = request.draw;
  command->add_option("RECORDING", options.recording, "Recording (.h5, .mcap) that insonify run or export has made")
      ->required();
  command->add_option("--sonar", options.sonar, "Which sonar of a recording that has several")->type_name("NAME");
  add_draw_options(*command, options);
  command->footer(
      "Draws the pictures that insonify run draws, without simulating anything: NAME_fan_0000.png and\n"
      "NAME_polar_0000.png of a fan, NAME_scan.png and NAME_polar.png of a scanning sonar.\n\n"
      "Examples:\n"
      "  insonify draw out/fls.h5 -o pictures --levels -90:-40\n"
      "  insonify draw out/fls.mcap -o pictures --ping 3 --colour-map copper --height 1080");
  command->callback([&request, &options] { request.act = [&options] { return draw(options); }; });
}

}  // namespace insonify
