// request_bridge.cpp -- options of `insonify bridge`.

#include "bridge/bridge_command.h"
#include "request.h"

namespace insonify {

void add_bridge(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("bridge", "Publish pings live to ROS 1, ROS 2 or Gazebo");
  command->require_subcommand(1);
  command->footer("Help on one: insonify bridge ros1 --help");
  for (const BridgeKind& kind : bridge_kinds()) {
    CLI::App* bridge = command->add_subcommand(kind.name, kind.help);
    add_bridge_options(*bridge, kind, request.bridges.emplace_back());
    bridge->callback([&request, &kind, bridge] {
      check_other_words(*bridge, kind);
      request.act = [&request, &kind]() -> int {
        become_bridge(kind, {request.words.begin() + 2, request.words.end()});
      };
    });
  }
}

}  // namespace insonify
