// main.cpp -- insonify-bridge-dds: publishes a scenario's pings as ROS 2 topics.

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "console/console.h"
#include "console/outcome.h"
#include "console/stop.h"
#include "dds/dds_configuration.h"
#include "dds/dds_inputs.h"
#include "dds/dds_transport.h"
#include "transport/bridge_program.h"

namespace insonify {
namespace {

// Joins CycloneDDS's log output, which arrives in pieces, into lines.
void pass_on(void* whole, const dds_log_data_t* piece) {
  std::string& line = *static_cast<std::string*>(whole);
  line.append(piece->message, piece->size);
  if (line.ends_with('\n')) {
    line.pop_back();
    complain("CycloneDDS: " + line);
    line.clear();
  }
}

int run(const BridgeRequest& request) {
  end_when_asked(IgnoredInterrupt::kEnds);
  const DdsOptions options = with_environment(request.dds);
  const auto domain_id = static_cast<dds_domainid_t>(options.domain.value_or(0));
  static std::string line;
  dds_set_log_sink(pass_on, &line);
  const bool has_uri = std::getenv("CYCLONEDDS_URI") != nullptr;
  const DdsEntity domain(
      dds_create_domain(domain_id, dds_configuration(options).c_str()),
      fmt::format("enter DDS domain {}{}", domain_id, has_uri ? " with what CYCLONEDDS_URI says" : ""));
  const DdsEntity participant(dds_create_participant(domain_id, nullptr, nullptr),
                              fmt::format("enter DDS domain {}", domain_id));

  BridgeOptions bridge_options = request.bridge;
  bridge_options.live.on_request = bridge_options.lossless = !request.ping_at.empty();
  bridge_options.live.driven = bridge_options.live.on_request || !request.odometry.empty() || !request.tf.empty();
  bridge_options.live.clocked = request.clock == "simulated";
  bridge_options.messages.raw = bridge_options.messages.live = true;  // Encoded only for topics with readers.
  DdsTransport transport(participant.get(), options.best_effort, bridge_options.lossless);
  Bridge bridge(bridge_options, transport, MessageForm::kRos2);
  DdsInputs inputs(participant.get(),
                   {.odometry = request.odometry,
                    .tf = request.tf,
                    .ping_at = request.ping_at,
                    .world_frame = bridge_options.messages.world_frame,
                    .clock = bridge_options.live.clocked,
                    .set_topic = options.set_topic},
                   bridge.loop());
  note_when_asked(IgnoredInterrupt::kEnds);
  bridge.start();
  inputs.start();
  if (!request.bridge.quiet) {
    say("topics of ROS 2 in domain {}{}; settings by {}\n", domain_id, options.local ? " on this machine" : "",
        options.set_topic);
    flush_output();
  }
  report_until_stopped(bridge.report());
  inputs.end();
  bridge.end();
  transport.finish();
  if (!request.bridge.quiet) {
    say("{}\n", bridge.report().text());
  }
  return kDone;
}

}  // namespace
}  // namespace insonify

int main(int argc, char** argv) {
  return insonify::run_bridge(
      "dds", argc, argv, [](const insonify::BridgeRequest& request, int&, char**) { return insonify::run(request); });
}
