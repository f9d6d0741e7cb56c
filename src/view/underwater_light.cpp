// underwater_light.cpp -- colours chosen by eye for clear water in daylight and distinguishable materials.

#include "view/underwater_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "base/names.h"

namespace insonify {
namespace {

struct Tint {
  std::string_view part;  // Part of the material's name.
  unsigned rgb;
};

// The first entry whose part occurs in a name is used: "sandy_gravel" is gravel, "waterlogged_wood" wood.
constexpr std::array kTints = {
    Tint{"yellow", 0xd9a21b},  // Paint: subsea structures are yellow, whatever the steel beneath.
    Tint{"gravel", 0xa59a86},    Tint{"sand", 0xc2b394},      Tint{"silt", 0x9c8f73},     Tint{"mud", 0x83745a},
    Tint{"clay", 0x8f7a60},      Tint{"moraine", 0x968a76},   Tint{"basalt", 0x6a6a6e},   Tint{"granite", 0x9a918c},
    Tint{"limestone", 0xc9c2ad}, Tint{"chalk", 0xdedacb},     Tint{"rock", 0x8b867c},     Tint{"concrete", 0xb3b3ad},
    Tint{"iron", 0x94705a},      Tint{"stainless", 0xbfc5ca}, Tint{"steel", 0xa3673f},    Tint{"alumin", 0xccd2d6},
    Tint{"titanium", 0xb5b3ae},  Tint{"copper", 0xb87348},    Tint{"brass", 0xc2a04e},    Tint{"lead", 0x777b84},
    Tint{"wood", 0x8d6a45},      Tint{"rubber", 0x44484c},    Tint{"neoprene", 0x4a4e55}, Tint{"foam", 0xd9a441},
    Tint{"pvc", 0xc8cdd0},       Tint{"glass", 0x9fc4bd},     Tint{"acrylic", 0xb4cfd4},  Tint{"ice", 0xd6e8ee},
    Tint{"grp", 0xd5d2c4},       Tint{"bone", 0xd9d2bd},      Tint{"tissue", 0xc08a7c}};

// Tints of other names: each applies up to a density [kg/m^3].
struct DensityTint {
  double density;
  unsigned rgb;
};
constexpr std::array kDensityTints = {
    DensityTint{800, 0xcbb27a},  DensityTint{1150, 0x5d646b}, DensityTint{1500, 0xb9c0c4}, DensityTint{2250, 0xb5a789},
    DensityTint{2650, 0xa5a49c}, DensityTint{4800, 0xadb3b6}, DensityTint{1e9, 0x9c6b48}};

// Pseudo-random value in -1..1 at a grid point.
float value_at(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto bits = static_cast<std::uint32_t>(x) * 0x9e3779b1U + static_cast<std::uint32_t>(y) * 0x85ebca77U +
              static_cast<std::uint32_t>(z) * 0xc2b2ae3dU;
  bits = (bits ^ (bits >> 15U)) * 0x2c1b3c6dU;
  bits = (bits ^ (bits >> 12U)) * 0x297a2d39U;
  bits ^= bits >> 15U;
  return static_cast<float>(bits >> 8U) / 8388608.0F - 1;
}

float octave(const Vec3& point) {
  const double fx = std::floor(point.x());
  const double fy = std::floor(point.y());
  const double fz = std::floor(point.z());
  const auto x = static_cast<std::int64_t>(fx);
  const auto y = static_cast<std::int64_t>(fy);
  const auto z = static_cast<std::int64_t>(fz);
  const auto smooth = [](double share) {
    const auto s = static_cast<float>(share);
    return s * s * (3 - 2 * s);
  };
  const float sx = smooth(point.x() - fx);
  const float sy = smooth(point.y() - fy);
  const float sz = smooth(point.z() - fz);
  const auto mix = [](float low, float high, float share) { return low + share * (high - low); };
  const auto row = [&](std::int64_t j, std::int64_t k) { return mix(value_at(x, j, k), value_at(x + 1, j, k), sx); };
  return mix(mix(row(y, z), row(y + 1, z), sy), mix(row(y, z + 1), row(y + 1, z + 1), sy), sz);
}

}  // namespace

Vec3f linear_colour(unsigned rgb) {
  const auto channel = [&](unsigned shift) {
    return std::pow(static_cast<float>((rgb >> shift) & 0xffU) / 255.0F, 2.2F);
  };
  return {channel(16), channel(8), channel(0)};
}

Vec3f tint_of(const Material& material) {
  for (const Tint& tint : kTints) {
    if (material.name.find(tint.part) != std::string::npos) {
      return linear_colour(tint.rgb);
    }
  }
  const auto* tint = std::find_if(kDensityTints.begin(), kDensityTints.end() - 1,
                                  [&](const DensityTint& entry) { return material.density <= entry.density; });
  const std::uint32_t hash = name_hash(material.name);
  const auto vary = [&](unsigned shift) { return 0.8F + 0.4F * static_cast<float>((hash >> shift) & 0xffU) / 255.0F; };
  return vary(16) * linear_colour(tint->rgb).cwiseProduct(Vec3f(vary(8), 1, vary(0)));
}

Vec3f water_colour(const Vec3& direction) {
  static const Vec3f kBelow = linear_colour(0x051c2a);
  static const Vec3f kAhead = linear_colour(0x125a80);
  static const Vec3f kAbove = linear_colour(0x7fc4d2);
  const auto rise = static_cast<float>(direction.z());
  if (rise < 0) {
    const float share = 1 - (1 + rise) * (1 + rise);
    return kAhead + share * (kBelow - kAhead);
  }
  return kAhead + std::pow(rise, 1.3F) * (kAbove - kAhead);
}

Vec3f ambient_light(const Vec3& normal) {
  static const Vec3f kFromBelow{0.03F, 0.07F, 0.10F};
  static const Vec3f kFromAbove{0.09F, 0.20F, 0.28F};
  const auto share = static_cast<float>(0.5 + 0.5 * normal.z());
  return kFromBelow + share * (kFromAbove - kFromBelow);
}

Vec3f transmission(double distance) {
  const auto d = static_cast<float>(distance);
  return {std::exp(-1.5F * d), std::exp(-0.95F * d), std::exp(-0.85F * d)};
}

Vec3f screen_colour(const Vec3f& linear) {
  const auto channel = [](float value) {
    constexpr float kShoulder = 0.8F;  // Larger values are compressed towards 1.
    if (value > kShoulder) {
      value = 1 - (1 - kShoulder) * std::exp((kShoulder - value) / (1 - kShoulder));
    }
    return 255 * std::pow(std::max(value, 0.0F), 1 / 2.2F);
  };
  return {channel(linear.x()), channel(linear.y()), channel(linear.z())};
}

float value_noise(const Vec3& point, double size) {
  const Vec3 place = point / size;
  // Octaves are shifted against each other, so that their grids do not coincide.
  return (octave(place) + 0.5F * octave(2 * place + Vec3::Constant(0.37)) +
          0.25F * octave(4 * place + Vec3::Constant(0.71))) /
         1.75F;
}

}  // namespace insonify
