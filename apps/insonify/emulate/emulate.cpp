// emulate.cpp -- insonify emulate: its options, and what each instrument prints.

#include "emulate/emulate.h"

#include <fmt/format.h>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "console/validators.h"
#include "emulate/oculus_server.h"
#include "emulate/ping360_server.h"
#include "emulate/sonar3d15_server.h"
#include "emulate/streaming_server.h"

namespace insonify {
namespace {

void say_mode(const char* name, const OculusMode& mode) {
  say("{}: {:.4g} kHz, to {:.4g} m\n", name, mode.sonar.frequency / 1e3, mode.sonar.max_range);
}

// Serves until SIGINT or SIGTERM.
template <typename Server>
int serve_until_stopped(Server& server, const EmulateOptions& options) {
  flush_output();
  server.run();
  if (!options.quiet) {
    say("{}\n", server.report().text());
  }
  return kDone;
}

int emulate_oculus(const EmulateOptions& options) {
  end_when_asked(IgnoredInterrupt::kEnds);
  EmulatedSonar sonar(options, Product::kImage, "oculus");
  OculusServer server(options, sonar);
  say("Oculus {} on TCP {}, status to UDP {}\n", sonar.given().name, server.address(), server.status_address());
  if (!options.quiet) {
    say_mode("mode 1 (low)", server.modes().low);
    if (server.modes().high) {
      say_mode("mode 2 (high)", *server.modes().high);
    }
  }
  return serve_until_stopped(server, options);
}

int emulate_ping360(const EmulateOptions& options) {
  end_when_asked(IgnoredInterrupt::kEnds);
  EmulatedSonar sonar(options, Product::kLine, "ping360");
  Ping360Server server(options, sonar);
  if (sonar.scenario().model == EchoModel::kPaper) {
    complain("warning: in the paper's model transmit_duration has no effect");
  }
  say("Ping360 {} on UDP {}\n", sonar.given().name, server.address());
  if (options.serial) {
    say("and on the serial line {}\n", server.serial_path());
  }
  return serve_until_stopped(server, options);
}

// @param pulse  The setting of the pulse's duration.
int emulate_streamer(const EmulateOptions& options, const char* instrument, const char* title, const char* pulse,
                     std::unique_ptr<PingStreamer> streamer, bool one_beam) {
  end_when_asked(IgnoredInterrupt::kEnds);
  EmulatedSonar sonar(options, Product::kImage, instrument);
  if (one_beam && sonar.given().beam_count != 1) {
    throw InputError(fmt::format("{} has {} beams; emulate {} needs a sonar with one", printable(sonar.given().name),
                                 sonar.given().beam_count, instrument));
  }
  StreamingServer server(options, sonar, std::move(streamer));
  if (sonar.scenario().model == EchoModel::kPaper) {
    complain(fmt::format("warning: in the paper's model {} has no effect", pulse));
  }
  say("{} {} on TCP and UDP {}\n", title, sonar.given().name, server.address());
  return serve_until_stopped(server, options);
}

int emulate_omniscan450(const EmulateOptions& options) {
  return emulate_streamer(options, "omniscan450", "Omniscan 450", "pulse_len_percent", make_omniscan450(), true);
}

int emulate_surveyor240(const EmulateOptions& options) {
  return emulate_streamer(options, "surveyor240", "Surveyor 240-16", "pulse_len_steps", make_surveyor240(), false);
}

int emulate_sonar3d15(const EmulateOptions& options) {
  end_when_asked(IgnoredInterrupt::kEnds);
  EmulatedSonar sonar(options, Product::kImage, "sonar3d15");
  Sonar3d15Server server(options, sonar);
  say("Sonar 3D-15 {} to UDP {}: 256 x 64, {:.3g} Hz\n", sonar.given().name, server.destination(), server.rate());
  return serve_until_stopped(server, options);
}

// Adds the command of an instrument, and the options that all have.
EmulateOptions& add_instrument(const Command& command, int (*emulate)(const EmulateOptions&)) {
  auto& options = command.keep<EmulateOptions>();
  command.argument("SCENARIO", &options.scenario, "Scenario file (YAML)");
  command.option("--sonar", "NAME", &options.sonar, "Sonar of the scenario, by its name; the first of the right type",
                 not_empty("a sonar's name"));
  command.option("--threads", "N", &options.threads, "Worker threads; 0: one per processor [0]", whole_number(0, 1024));
  command.option("--set", "KEY=VALUE", &options.settings,
                 "Change a key of the scenario, such as min_range=0.5; may be repeated");
  command.flag("-q,--quiet", &options.quiet, "Print only addresses, warnings and errors");
  command.act([&options, emulate] { return emulate(options); });
  return options;
}

// Of one that listens.
EmulateOptions& add_server(const Command& command, int port, int (*emulate)(const EmulateOptions&)) {
  EmulateOptions& options = add_instrument(command, emulate);
  options.port = port;
  command.option("--port", "N", &options.port, fmt::format("Port; 0: any free port [{}]", port),
                 whole_number(0, 65535));
  command.option("--address", "IP", &options.address, "Address to listen on [127.0.0.1]");
  return options;
}

}  // namespace

void add_emulate(const Command& program) {
  const Command emulate = program.add("emulate", "Emulate an instrument for its own drivers");
  emulate.footer("Help on one: insonify emulate ping360 --help");

  const Command oculus = emulate.add("oculus", "Blueprint Subsea Oculus: images over TCP, status over UDP port 52102");
  EmulateOptions& oculus_options = add_server(oculus, 52100, emulate_oculus);
  oculus.option("--high", "NAME", &oculus_options.high,
                "Sonar of the scenario for the high frequency mode [the preset's]", not_empty("a sonar's name"));
  oculus.option("--silence", "SECONDS", &oculus_options.silence,
                "End the connection of a client that has sent nothing, not even a dummy message, for so long [30]",
                number_within(from_to(1, 1e6)));
  oculus.footer(
      "Its range, frequency mode, gain, ping rate and sound speed are as fire messages say; the rest is the\n"
      "scenario's. Drivers find it by its status messages, and expect port 52100. Ctrl-C ends it; SIGUSR1 prints rate\n"
      "and latency.\n\n"
      "Example:\n  insonify emulate oculus dive.yaml");

  const Command ping360 = emulate.add("ping360", "Blue Robotics Ping360: the ping protocol over UDP");
  EmulateOptions& ping360_options = add_server(ping360, kPing360Port, emulate_ping360);
  ping360.flag("--pty", &ping360_options.serial, "Open a serial line too (a pseudo terminal), and print its path");
  ping360.flag("--fast", &ping360_options.fast,
               "Turn the head and read samples out in no time, so that a ping takes as long as its sound travels");
  ping360.footer(
      "Its range, frequency, gain, pulse and head are as its commands say; the rest is the scenario's. On port 12345,\n"
      "clients that search for it by broadcast (UDP port 30303) find it. Ctrl-C ends it; SIGUSR1 prints rate and\n"
      "latency.\n\n"
      "Example:\n  insonify emulate ping360 scan.yaml --port 9092");

  const Command omniscan = emulate.add("omniscan450", "Cerulean Omniscan 450: profiles over TCP and UDP");
  add_server(omniscan, 51200, emulate_omniscan450);
  omniscan.footer(
      "A sonar with one beam, that looks to a side. It pings once os_ping_params asks it to. Ctrl-C ends it; SIGUSR1\n"
      "prints rate and latency.\n\n"
      "Example:\n  insonify emulate omniscan450 survey.yaml --sonar port");

  const Command surveyor = emulate.add("surveyor240", "Cerulean Surveyor 240-16: soundings over TCP and UDP");
  add_server(surveyor, 62312, emulate_surveyor240);
  surveyor.footer(
      "A fan that looks down. It pings once set_ping_parameters asks it to. Ctrl-C ends it; SIGUSR1 prints rate and\n"
      "latency.\n\n"
      "Example:\n  insonify emulate surveyor240 survey.yaml");

  const Command eye = emulate.add("sonar3d15", "Water Linked Sonar 3D-15: range images by UDP");
  EmulateOptions& eye_options = add_instrument(eye, emulate_sonar3d15);
  eye_options.port = 4747;
  eye.option("--to", "IP", &eye_options.destination, "Multicast group, or address, to send to [224.0.0.96]");
  eye.option("--port", "N", &eye_options.port, "UDP port to send to [4747]", whole_number(1, 65535));
  eye.option("--address", "IP", &eye_options.address,
             "This machine's address in the network that multicast goes to [127.0.0.1]");
  eye.footer(
      "It sends without being asked: the instrument's settings over HTTP are not emulated. Ctrl-C ends it; SIGUSR1\n"
      "prints rate and latency.\n\n"
      "Example:\n  insonify emulate sonar3d15 dive.yaml");
}

}  // namespace insonify
