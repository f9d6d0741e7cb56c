// choose_engine.cpp -- the cost model of `auto`, and the search for a device.

#include "echo/choose_engine.h"

#include <fmt/format.h>

#include <cmath>

#include "insonify/error.h"

namespace insonify {
namespace {

// "16 threads"
std::string threads_text(int threads) {
  return fmt::format("{} thread{}", threads, threads == 1 ? "" : "s");
}

}  // namespace

// Fitted to bench/README.md, "On a graphics card": 256 beams of 800 samples on an H200 and on 16 threads. There the
// samples of a ping of the paper's model take the threads
//
//     triangles             802    98 454   991 632   9 971 462
//     measured [ms]         0.4       2.1       4.4         7.9
//     the formula [ms]      0.4       1.8       3.8         8.3
//
// as the cube root of the triangles, and the card 0.6 to 1.6 ms with the way to it and back.
ExpectedTimes expected_times(const PingLoad& load) {
  constexpr double kHostSample = 3e-9, kDevicePing = 0.4e-3, kDeviceSample = 3e-9;  // [s]
  return {.host = kHostSample * std::cbrt(load.triangles) * load.samples / load.threads,
          .device = kDevicePing + kDeviceSample * load.samples};
}

std::optional<std::string> against_device(const PingLoad& load) {
  constexpr double kDeviceStart = 0.3;  // To open the drivers and to compile the kernels [s].
  if (load.bends_rays) {
    return "water.profile bends rays, which a graphics card does not trace";
  }
  if (load.beams == 1) {
    return "the single beam of a scanning head is too little work for a graphics card";
  }
  const ExpectedTimes times = expected_times(load);
  if (times.host <= times.device) {
    return fmt::format("{} make{} the samples of a ping in about {:.2g} ms, a graphics card in {:.2g} ms",
                       threads_text(load.threads), load.threads == 1 ? "s" : "", 1e3 * times.host, 1e3 * times.device);
  }
  if (load.pings > 0 && static_cast<double>(load.pings) * (times.host - times.device) < kDeviceStart) {
    return fmt::format("{} too few to start a graphics card for",
                       load.pings == 1 ? "1 ping is" : fmt::format("{} pings are", load.pings));
  }
  return {};
}

EngineChoice choose_engine(const PingLoad& load, std::string_view device) {
  const auto on_host = [](std::string_view why) {
    return EngineChoice{&engine_kind("cpu"), fmt::format("engine: cpu, since {}", why)};
  };
  if (const std::optional<std::string> why = against_device(load)) {
    return on_host(*why);
  }
  std::string why;
  for (const EngineKind* kind : kinds_on_devices()) {
    try {
      const std::string name = kind->find_hardware(device);
      const ExpectedTimes times = expected_times(load);
      return {kind, fmt::format("engine: {} on {}, expected to make the samples of a ping {:.2g} times as fast as {}",
                                kind->name, name, times.host / times.device, threads_text(load.threads))};
    } catch (const Error& error) {
      why = error.what();
    }
  }
  return on_host(why);
}

}  // namespace insonify
