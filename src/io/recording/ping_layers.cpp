// ping_layers.cpp -- names, types, units and meanings of the tables of a ping.

#include "io/recording/ping_layers.h"

#include <algorithm>
#include <iterator>
#include <type_traits>

namespace insonify {
namespace {

bool always(const Scenario&, const SonarConfig&) {
  return true;
}
bool with_field(const Scenario& scenario, const SonarConfig& sonar) {
  return scenario.receiver_of(sonar).field;
}
bool with_counts(const Scenario& scenario, const SonarConfig& sonar) {
  return scenario.receiver_of(sonar).counts;
}
bool labelled(const Scenario& scenario, const SonarConfig&) {
  return scenario.ground_truth != GroundTruth::kNone;
}
bool in_full(const Scenario& scenario, const SonarConfig&) {
  return scenario.ground_truth == GroundTruth::kFull;
}

const PingLayer kLayers[] = {
    {"intensity", &Ping::intensity, always, 0, "", {"1", "Echo intensity."}},
    {"field",
     &Ping::field,
     with_field,
     2,
     "part",
     {"1", "What intensity is the squared magnitude of: real and imaginary part, phase re the carrier."}},
    {"counts",
     &Ping::counts,
     with_counts,
     0,
     "",
     {"1", "What the instrument delivers: 0 to 2^bits - 1, by settings/sonar/mapping and receiver/full_scale_db."}},
    {"instance",
     &Ping::instance,
     labelled,
     0,
     "",
     {"1", "Row of instance_names that gave most of the echo; 65535 where nothing echoed."},
     true},
    {"material",
     &Ping::material,
     labelled,
     0,
     "",
     {"1", "Row of material_names of the same; 65535 where nothing echoed."},
     true},
    {"elevation",
     &Ping::elevation,
     labelled,
     0,
     "",
     {"rad", "Mean elevation of the same, positive up; NaN where nothing echoed."}},
    {"strongest_instance",
     &Ping::strongest_instance,
     in_full,
     kStrongestCount,
     "rank",
     {"1", "Rows of instance_names that gave most of the echo, the strongest first; 65535 beyond the last."},
     true},
    {"strongest_share",
     &Ping::strongest_share,
     in_full,
     kStrongestCount,
     "rank",
     {"1", "What each of them gave of the energy of the bin's echoes, 0 to 1; 0 beyond the last."}},
    {"elevation_spread",
     &Ping::elevation_spread,
     in_full,
     0,
     "",
     {"rad", "Standard deviation of elevation over the echo of instance; NaN where nothing echoed."}},
    {"path_order",
     &Ping::path_order,
     in_full,
     0,
     "",
     {"1", "Surfaces met by the paths that gave most of the echo, 1 to 3; 0 where nothing echoed."}},
    {"shadow",
     &Ping::shadow,
     in_full,
     0,
     "",
     {"1",
      "Share of the beam that nearer surfaces hide, 0 to 1, in bins that no direct echo comes from; 0 in all others."}},
    {"direct_intensity",
     &Ping::direct_intensity,
     in_full,
     0,
     "",
     {"1", "Echo intensity by paths that meet one surface, without noise, speckle and reverberation of the water."}},
};

}  // namespace

hid_t PingLayer::type() const {
  return std::visit(
      [](auto member) -> hid_t {
        if constexpr (std::is_same_v<decltype(member), std::vector<float> Ping::*> ||
                      std::is_same_v<decltype(member), std::vector<std::complex<float>> Ping::*>) {
          return H5T_IEEE_F32LE;
        } else if constexpr (std::is_same_v<decltype(member), std::vector<std::uint16_t> Ping::*>) {
          return H5T_STD_U16LE;
        } else {
          return H5T_STD_U8LE;
        }
      },
      table);
}

std::size_t PingLayer::count(const Ping& ping) const {
  const std::size_t complex_parts = std::holds_alternative<std::vector<std::complex<float>> Ping::*>(table) ? 2 : 1;
  return complex_parts * std::visit([&](auto member) { return (ping.*member).size(); }, table);
}

std::span<const std::byte> PingLayer::bytes(const Ping& ping) const {
  return std::visit([&](auto member) { return std::as_bytes(std::span(ping.*member)); }, table);
}

std::vector<PingLayer> ping_layers(const Scenario& scenario, const SonarConfig& sonar) {
  std::vector<PingLayer> layers;
  std::ranges::copy_if(kLayers, std::back_inserter(layers),
                       [&](const PingLayer& layer) { return layer.recorded(scenario, sonar); });
  return layers;
}

}  // namespace insonify
