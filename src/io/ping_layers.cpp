// ping_layers.cpp -- names, types, units and meanings of the tables of a ping.

#include "io/ping_layers.h"

#include <algorithm>
#include <iterator>
#include <type_traits>

namespace insonify {
namespace {

const PingLayer kLayers[] = {
    {"intensity", &Ping::intensity, GroundTruth::kNone, 0, {"1", "Echo intensity."}},
    {"instance",
     &Ping::instance,
     GroundTruth::kLabels,
     0,
     {"1", "Row of instance_names that gave most of the echo; 65535 where nothing echoed."}},
    {"material",
     &Ping::material,
     GroundTruth::kLabels,
     0,
     {"1", "Row of material_names of the same; 65535 where nothing echoed."}},
    {"elevation",
     &Ping::elevation,
     GroundTruth::kLabels,
     0,
     {"rad", "Mean elevation of the same, positive up; NaN where nothing echoed."}},
    {"strongest_instance",
     &Ping::strongest_instance,
     GroundTruth::kFull,
     kStrongestCount,
     {"1", "Rows of instance_names that gave most of the echo, the strongest first; 65535 beyond the last."}},
    {"strongest_share",
     &Ping::strongest_share,
     GroundTruth::kFull,
     kStrongestCount,
     {"1", "What each of them gave of the energy of the bin's echoes, 0 to 1; 0 beyond the last."}},
    {"elevation_spread",
     &Ping::elevation_spread,
     GroundTruth::kFull,
     0,
     {"rad", "Standard deviation of elevation over the echo of instance; NaN where nothing echoed."}},
    {"path_order",
     &Ping::path_order,
     GroundTruth::kFull,
     0,
     {"1", "Surfaces met by the paths that gave most of the echo, 1 to 3; 0 where nothing echoed."}},
    {"shadow",
     &Ping::shadow,
     GroundTruth::kFull,
     0,
     {"1",
      "Share of the beam that nearer surfaces hide, 0 to 1, in bins that no direct echo comes from; 0 in all others."}},
    {"direct_intensity",
     &Ping::direct_intensity,
     GroundTruth::kFull,
     0,
     {"1", "Echo intensity by paths that meet one surface, without noise, speckle and reverberation of the water."}},
};
static_assert(std::size(kLayers) == kMostPingLayers);

}  // namespace

hid_t PingLayer::type() const {
  return std::visit(
      [](auto member) -> hid_t {
        if constexpr (std::is_same_v<decltype(member), std::vector<float> Ping::*>) {
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
  return std::visit([&](auto member) { return (ping.*member).size(); }, table);
}

std::span<const std::byte> PingLayer::bytes(const Ping& ping) const {
  return std::visit([&](auto member) { return std::as_bytes(std::span(ping.*member)); }, table);
}

std::vector<PingLayer> ping_layers(GroundTruth ground_truth) {
  std::vector<PingLayer> layers;
  std::ranges::copy_if(kLayers, std::back_inserter(layers),
                       [&](const PingLayer& layer) { return layer.least <= ground_truth; });
  return layers;
}

}  // namespace insonify
