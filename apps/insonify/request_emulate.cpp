// request_emulate.cpp -- options of `insonify emulate`.

#include <fmt/format.h>

#include "console/validators.h"
#include "request.h"

namespace insonify {
namespace {

void add_common(CLI::App& command, EmulateOptions& options, int port) {
  options.port = port;
  command.add_option("SCENARIO", options.scenario, "Scenario file (YAML)")->required();
  command.add_option("--sonar", options.sonar, "Sonar of the scenario, by its name; the first of the right type")
      ->check(not_empty("a sonar's name"))
      ->type_name("NAME");
  command.add_option("--port", options.port, fmt::format("Port; 0: any free port [{}]", port))
      ->check(whole_number(0, 65535))
      ->type_name("N");
  command.add_option("--address", options.address, "Address to listen on [127.0.0.1]")->type_name("IP");
  command.add_option("--threads", options.threads, "Worker threads; 0: one per processor [0]")
      ->check(whole_number(0, 1024))
      ->type_name("N");
  command.add_option("--set", options.settings, "Change a key of the scenario, such as min_range=0.5; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  command.add_flag("-q,--quiet", options.quiet, "Print only addresses, warnings and errors");
}

void add_oculus(CLI::App& emulate, Request& request) {
  CLI::App* command =
      emulate.add_subcommand("oculus", "Blueprint Subsea Oculus: images over TCP, status over UDP port 52102");
  EmulateOptions& options = request.emulate_oculus;
  add_common(*command, options, 52100);
  command->add_option("--high", options.high, "Sonar of the scenario for the high frequency mode [the preset's]")
      ->check(not_empty("a sonar's name"))
      ->type_name("NAME");
  command->footer(
      "Its range, frequency mode, gain, ping rate and sound speed are as fire messages say; the rest is the\n"
      "scenario's. Drivers find it by its status messages, and expect port 52100. Ctrl-C ends it; SIGUSR1 prints rate\n"
      "and latency.\n\n"
      "Example:\n  insonify emulate oculus dive.yaml");
  command->callback([&request, &options] { request.act = [&options] { return emulate_oculus(options); }; });
}

}  // namespace

void add_emulate(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("emulate", "Emulate an instrument for its own drivers");
  command->require_subcommand(1);
  command->footer("Help on one: insonify emulate ping360 --help");

  add_oculus(*command, request);
  CLI::App* ping360 = command->add_subcommand("ping360", "Blue Robotics Ping360: the ping protocol over UDP");
  EmulateOptions& options = request.emulate_ping360;
  add_common(*ping360, options, 9092);
  ping360->add_flag("--pty", options.serial, "Open a serial line too (a pseudo terminal), and print its path");
  ping360->footer(
      "Its range, frequency, gain, pulse and head are as its commands say; the rest is the scenario's. Ctrl-C ends "
      "it;\n"
      "SIGUSR1 prints rate and latency.\n\n"
      "Example:\n  insonify emulate ping360 scan.yaml --port 9092");
  ping360->callback([&request, &options] { request.act = [&options] { return emulate_ping360(options); }; });
}

}  // namespace insonify
