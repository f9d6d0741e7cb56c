// dds_configuration.cpp -- reads ROS 2's environment variables and writes CycloneDDS's configuration.

#include "dds/dds_configuration.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "console/outcome.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

constexpr int kHighestDomain = 232;  // Higher domains would need ports above 65535.

// "" if it is not set.
std::string_view environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view() : value;
}

int domain_of(std::string_view text) {
  int domain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error != std::errc() || end != text.data() + text.size() || domain < 0 || domain > kHighestDomain) {
    throw InputError(
        fmt::format("ROS_DOMAIN_ID = {} must be a whole number from 0 to {}", printable(text), kHighestDomain));
  }
  return domain;
}

bool is_local(std::string_view range) {
  constexpr std::string_view kKnown[] = {"", "SUBNET", "LOCALHOST", "SYSTEM_DEFAULT"};
  if (std::ranges::find(kKnown, range) == std::end(kKnown)) {
    throw InputError(fmt::format("ROS_AUTOMATIC_DISCOVERY_RANGE = {} must be SUBNET, LOCALHOST or SYSTEM_DEFAULT{}",
                                 printable(range), range == "OFF" ? ": with OFF nobody would find the bridge" : ""));
  }
  return range == "LOCALHOST";
}

std::string in_xml(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

}  // namespace

DdsOptions with_environment(DdsOptions options) {
  if (const std::string_view domain = environment("ROS_DOMAIN_ID"); !options.domain && !domain.empty()) {
    options.domain = domain_of(domain);
  }
  options.local = is_local(environment("ROS_AUTOMATIC_DISCOVERY_RANGE")) || environment("ROS_LOCALHOST_ONLY") == "1" ||
                  options.local;
  for (std::string_view peers = environment("ROS_STATIC_PEERS"); !peers.empty();) {
    const std::size_t end = std::min(peers.find(';'), peers.size());
    if (end > 0) {
      options.peers.emplace_back(peers.substr(0, end));
    }
    peers.remove_prefix(std::min(end + 1, peers.size()));
  }
  return options;
}

std::string dds_configuration(const DdsOptions& options) {
  // Large fragments: with CycloneDDS's default of 1.3 kB a reader requests each lost fragment one by one, and a message
  // of 2 MB takes so long to complete that newer ones push it out of the writer's history. SendPace says why readers
  // lose fragments, docs/how-to/ros2.md what readers can do about it.
  std::string text =
      "<CycloneDDS><Domain><General><FragmentSize>65000B</FragmentSize><MaxMessageSize>65500B</MaxMessageSize>"
      "</General></Domain></CycloneDDS>";
  if (options.local) {
    text +=
        ",<CycloneDDS><Domain><General><Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
        "<AllowMulticast>false</AllowMulticast></General></Domain></CycloneDDS>";
  }
  std::string peers;
  for (const std::string& peer : options.peers) {
    peers += fmt::format("<Peer address=\"{}\"/>", in_xml(peer));
  }
  if (options.local) {
    peers += "<Peer address=\"127.0.0.1\"/>";
  }
  if (!peers.empty()) {
    // Number of participants to look for on each peer.
    text += fmt::format(
        ",<CycloneDDS><Domain><Discovery><ParticipantIndex>auto</ParticipantIndex>"
        "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex><Peers>{}</Peers></Discovery></Domain></CycloneDDS>",
        peers);
  }
  const std::string_view user = environment("CYCLONEDDS_URI");
  return user.empty() ? text : fmt::format("{},{}", text, user);
}

}  // namespace insonify
