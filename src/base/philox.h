// philox.h -- Philox, a counter-based random number generator: numbers depend on key and counter, not on call order.

#pragma once

#include <array>
#include <cstdint>

namespace insonify {

/// Purpose of a random number; part of the counter or key, so that different purposes use independent streams.
enum class RandomPurpose : std::uint32_t {
  kPaperNoise = 1,           // receiver/paper_receiver.cpp
  kSecondarySelection = 2,   // echo/model/flat_plan.cpp: where selection begins
  kRelief = 3,               // scene/make_relief.cpp: the surface's height
  kNoiseInPhase = 4,         // receiver/calibrated_receiver.cpp, real part
  kNoiseQuadrature = 5,      // ... and imaginary part
  kArrayElements = 6,        // sonar/array_pattern.cpp: errors of gain and phase
  kSpeckle = 7,              // receiver/speckle/scatterer_lattice.cpp: key of a bearing
  kClutter = 8,              // receiver/speckle/clutter.cpp: texture of K-distributed clutter
  kPointPhase = 9,           // echo/targets/point_echoes.cpp
  kInterference = 10,        // echo/targets/interference.cpp
  kScatterers = 11,          // receiver/speckle/sparse_scatterers.cpp
  kWaves = 12,               // echo/targets/point_ghosts.cpp: highlights of ghosts by waves
  kWalks = 13,               // echo/walks/random_walks.cpp
  kTransmitLeak = 14,        // receiver/transmit_leak.cpp: level and phase in each beam
  kThrusterInPhase = 15,     // receiver/noise/thruster_noise.cpp, real part
  kThrusterQuadrature = 16,  // ... and imaginary part
  kVehicleMotion = 17        // pattern/random_motion.cpp
};

using PhiloxCounter = std::array<std::uint32_t, 4>;
using PhiloxKey = std::array<std::uint32_t, 2>;
using PhiloxPair = std::array<std::uint32_t, 2>;

/// Philox 4x32-10: Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11 (2011).
/// Each counter gives four independent 32-bit words; equal counters and keys give equal words on every machine.
constexpr PhiloxCounter philox(PhiloxCounter counter, PhiloxKey key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{0xD2511F53} * counter[0];
    const std::uint64_t b = std::uint64_t{0xCD9E8D57} * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key = {key[0] + 0x9E3779B9U, key[1] + 0xBB67AE85U};
  }
  return counter;
}

/// Philox 2x32-10 of the same paper: two words, in a third of the time.
constexpr PhiloxPair philox(PhiloxPair counter, std::uint32_t key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product = std::uint64_t{0xD256D193} * counter[0];
    counter = {static_cast<std::uint32_t>(product >> 32) ^ counter[1] ^ key, static_cast<std::uint32_t>(product)};
    key += 0x9E3779B9U;
  }
  return counter;
}

/// Splits a 64-bit seed into a key.
constexpr PhiloxKey philox_key(std::uint64_t seed) {
  return {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
}

/// Uniform in (0, 1): never 0, so that its logarithm is finite.
constexpr float uniform_open(std::uint32_t word) {
  return (static_cast<float>(word >> 9) + 0.5F) * (1.0F / 8388608.0F);
}

}  // namespace insonify
