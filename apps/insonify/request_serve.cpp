// request_serve.cpp -- options of `insonify serve`.

#include "console/levels.h"
#include "console/validators.h"
#include "request.h"

namespace insonify {

void add_server_options(CLI::App& command, PageServerOptions& options, const std::string& group) {
  command.add_option("--port", options.port, "Port; 0: any free port [8765]")
      ->check(whole_number(0, 65535))
      ->type_name("N")
      ->group(group);
  command
      .add_option("--address", options.address, "Address to listen on; others than loopback need --token [127.0.0.1]")
      ->type_name("IP")
      ->group(group);
  command.add_option("--token", options.token, "Secret that every connection must send")
      ->check(not_empty("a secret"))
      ->type_name("T")
      ->group(group);
  command.add_option("--allow-origin", options.origins, "Web page of another origin that may connect; may be repeated")
      ->type_name("ORIGIN")
      ->expected(1)
      ->take_all()
      ->group(group);
  command.add_flag("-q,--quiet", options.quiet, "Print only the address, warnings and errors")->group(group);
  command.add_option("--page", options.page, "Serve the page from this folder")->type_name("DIR")->group("");
}

void add_serve(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("serve", "Make pings while you watch and steer in a browser");
  ServeOptions& options = request.serve;
  command->add_option("SCENARIO", options.scenario, "Scenario file (YAML, or Stonefish's .scn)")->required();
  add_server_options(*command, options.server, "Options");
  command->add_option("--record", options.recording, "Record from the start into this file (.h5, .mcap)")
      ->type_name("FILE");
  command
      ->add_option("--levels", options.levels,
                   "Levels of the darkest and the brightest value in .mcap and for Foxglove, such as -90:-40 [dB]")
      ->check(levels())
      ->type_name("LOW:HIGH");
  command->add_flag("-f,--force", options.force, "Replace earlier recordings of the same names");
  command->add_option("--rate", options.rate, "Limit of pings per second of each sonar; time slows down accordingly")
      ->check(number_within(above_to(0, 1e6)))
      ->type_name("N");
  command->add_option("--threads", options.threads, "Worker threads; 0: one per processor [0]")
      ->check(whole_number(0, 1024))
      ->type_name("N");
  command->add_option("--set", options.settings, "Change a key of the scenario, such as max_range=20; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  command->add_flag("--strict", request.strict, "End with an error if a part of the world is missing");
  command->add_flag("--paused", options.paused, "Start paused");
  command->footer(
      "Prints the address of a page that shows the sonar's picture and steers the vehicle. Foxglove connects to the\n"
      "same port. Ctrl-C ends it.\n\n"
      "Examples:\n"
      "  insonify serve scenes/ferry_calibrated.yaml\n"
      "  insonify serve scenes/tank.yaml --port 9000 --rate 10 --record tank.h5\n"
      "  insonify serve scenes/tank.yaml --address 0.0.0.0 --token \"$(openssl rand -hex 16)\"");
  command->callback([&request, &options] {
    if (request.strict) {
      options.settings.emplace_back("--strict=true");
    }
    if (const auto levels = parsed_levels(options.levels)) {
      options.server.messages.low_db = levels->first;
      options.server.messages.high_db = levels->second;
    }
    request.act = [&options] { return serve(options); };
  });
}

}  // namespace insonify
