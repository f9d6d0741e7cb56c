// emulate_ping360.cpp -- insonify emulate ping360.

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "emulate/emulate.h"
#include "emulate/ping360_server.h"

namespace insonify {

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
  flush_output();
  server.run();
  if (!options.quiet) {
    say("{}\n", server.report().text());
  }
  return kDone;
}

}  // namespace insonify
