// emulate_oculus.cpp -- insonify emulate oculus.

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "emulate/emulate.h"
#include "emulate/oculus_server.h"

namespace insonify {
namespace {

void say_mode(const char* name, const OculusMode& mode) {
  say("{}: {:.4g} kHz, to {:.4g} m\n", name, mode.sonar.frequency / 1e3, mode.sonar.max_range);
}

}  // namespace

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
  flush_output();
  server.run();
  if (!options.quiet) {
    say("{}\n", server.report().text());
  }
  return kDone;
}

}  // namespace insonify
