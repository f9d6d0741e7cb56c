// colour_map.cpp -- the colour maps from weak to strong echoes.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "insonify/error.h"
#include "insonify/picture.h"

namespace insonify {
namespace {

// Each map is a list of evenly spaced colours, with linear interpolation between them.

// "inferno" of matplotlib (S. van der Walt and N. Smith, 2015; public domain, CC0): every eighth of its 256 colours,
// within 2/255 of the others.
constexpr std::array kInferno = {0x000004U, 0x040312U, 0x0b0724U, 0x150b37U, 0x210c4aU, 0x2e0a5aU, 0x3c0965U,
                                 0x4a0c6bU, 0x57106dU, 0x63146eU, 0x70196eU, 0x7d1e6dU, 0x89226aU, 0x962766U,
                                 0xa32b61U, 0xaf315cU, 0xbb3755U, 0xc63e4dU, 0xd14644U, 0xdb4f3bU, 0xe35932U,
                                 0xeb6528U, 0xf1711eU, 0xf67f14U, 0xf98d0aU, 0xfb9c06U, 0xfcab0fU, 0xfbba1fU,
                                 0xf9ca32U, 0xf5d949U, 0xf2e865U, 0xf3f586U, 0xfcffa4U};

// The usual copper: red 1.25 v (at most 1), green 0.7812 v, blue 0.4975 v.
constexpr std::array kCopper = {0x000000U, 0x402819U, 0x805033U, 0xbf784cU, 0xff9f65U, 0xffc77fU};

constexpr std::array kGrey = {0x000000U, 0xffffffU};

// Made for this project: dark blue to white, with evenly rising brightness.
constexpr std::array kBlue = {0x00030cU, 0x04173aU, 0x08306bU, 0x0b4b93U, 0x1669b5U,
                              0x2d89cfU, 0x52a8e0U, 0x83c5ebU, 0xb7def4U, 0xf2fbffU};

std::span<const unsigned> anchors_of(ColourMap map) {
  switch (map) {
    case ColourMap::kInferno:
      return kInferno;
    case ColourMap::kCopper:
      return kCopper;
    case ColourMap::kGrey:
      return kGrey;
    case ColourMap::kBlue:
      return kBlue;
  }
  return kGrey;
}

}  // namespace

Rgb colour(ColourMap map, double value) {
  const std::span<const unsigned> anchors = anchors_of(map);
  const double place = (value > 0 ? std::min(value, 1.0) : 0.0) * static_cast<double>(anchors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  const double share = place - static_cast<double>(below);
  const auto channel = [&](unsigned shift) {
    const double low = (anchors[below] >> shift) & 0xffU;
    const double high = (anchors[below + 1] >> shift) & 0xffU;
    return static_cast<std::uint8_t>(std::lround(low + share * (high - low)));
  };
  return {channel(16), channel(8), channel(0)};
}

ColourMap colour_map_from_name(std::string_view name) {
  constexpr std::array kNames = {"inferno", "copper", "grey", "blue"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) {
      return static_cast<ColourMap>(i);
    }
  }
  throw Error(fmt::format("colour map \"{}\" must be one of inferno, copper, grey, blue", name));
}

}  // namespace insonify
