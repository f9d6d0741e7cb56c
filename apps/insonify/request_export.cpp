// request_export.cpp -- options of `insonify export` and `insonify info`.

#include "console/validators.h"
#include "request.h"

namespace insonify {

void add_export(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("export", "Write recordings in a format that other tools read");
  ExportCommand& options = request.exported;
  command->add_option("RECORDING", options.recordings, "Recordings (.h5, .mcap) of one run")->required();
  command->add_option("-o,--output", options.file, "File to write; its extension is the format")
      ->required()
      ->check(not_empty("a file, such as run.mcap"))
      ->type_name("FILE");
  command->add_option("--sonar", options.sonar, "Only this sonar of a recording that has several [all]")
      ->type_name("NAME");
  command->add_flag("-f,--force", options.force, "Replace FILE if it exists");
  auto* bits =
      command->add_option("--bits", request.bits, "Bits of the values of sonar images in .mcap and .bag, 8 or 16 [16]")
          ->check(one_of({"8", "16"}))
          ->type_name("N");
  add_message_choice(*command, options.messages, "in .mcap and .bag", "[that of the recordings, else 1970]");
  command->add_flag("--store", options.store, "Do not compress .npz");
  auto* rate = command
                   ->add_option("--rate", request.rate,
                                "Frames per second of a video [as fast as the pings were made, at most 50]")
                   ->check(number_within(above_to(0, 120)))
                   ->type_name("N");
  const std::string pictures = "Pictures";
  add_picture_options(*command, options.pictures, pictures);
  for (const char* name : {"--scale", "--floor-db"}) {
    command->remove_option(command->get_option(name));
  }
  command->footer(
      "Formats, by the extension of FILE:\n"
      "  .mcap         ROS 2 messages of all sonars, for Foxglove and ros2 bag\n"
      "  .bag          ROS 1 messages of all sonars, for rosbag\n"
      "  .npz          NumPy arrays: numpy.load(FILE)[\"intensity\"]\n"
      "  .zarr         a folder of chunked arrays, one chunk a ping\n"
      "  .mp4, .gif    the fan of one sonar, by the program ffmpeg\n"
      "--colour-map, --levels and --height act on videos. In .mcap and .bag --levels acts on the values of sonar\n"
      "images and on fan pictures, --colour-map on those.\n\n"
      "Examples:\n"
      "  insonify export out/fls.h5 out/profiler.h5 -o out/run.mcap\n"
      "  insonify export run.mcap --sonar fls -o fls.npz\n"
      "  insonify export out/fls.h5 -o fls.gif --levels -90:-40 --height 480");
  command->callback([&request, &options, command, bits, rate] {
    for (const char* name : {"--bits", "--store", "--rate", "--height", "--colour-map", "--levels"}) {
      if (*command->get_option(name)) {
        options.given.emplace_back(name);
      }
    }
    for (const std::string& name : options.messages.given()) {
      options.given.push_back(name);
    }
    options.bits = *bits && request.bits == "8" ? 8 : 16;
    if (*rate) {
      options.rate = request.rate;
    }
    request.act = [&options] { return export_command(options); };
  });
}

void add_info(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("info", "Describe recordings");
  InfoOptions& options = request.info;
  command->add_option("RECORDING", options.recordings, "Recordings (.h5, .mcap), also unfinished ones (.new)")
      ->required();
  command->add_flag("--json", options.json, "As JSON, a list with an object for each");
  command->footer(
      "Examples:\n"
      "  insonify info out/fls.h5 run.mcap\n"
      "  insonify info out/fls.h5.1f2e3d4c.new --json");
  command->callback([&request, &options] { request.act = [&options] { return info(options); }; });
}

}  // namespace insonify
