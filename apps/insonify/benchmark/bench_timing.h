// bench_timing.h -- clocks, medians and output of rows, shared by the benchmarks.

#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "insonify/simulator.h"

namespace insonify {

inline constexpr double kMilliseconds = 1e3;  // Per second.

[[nodiscard]] double median(std::vector<double> values);
[[nodiscard]] double milliseconds_since(std::chrono::steady_clock::time_point start);

/// Median of the ratios of corresponding elements.
[[nodiscard]] double median_ratio(const std::vector<double>& above, const std::vector<double>& below);

/// Times of some pings of the first sonar [ms], after kWarmUpPings others.
/// @param number  Number of the next ping.
[[nodiscard]] std::vector<double> time_pings(Simulator& simulator, int count, std::uint64_t& number, Ping& ping);
inline constexpr int kWarmUpPings = 2;

/// Writes nothing if the path is empty.
/// @throws Error if the file cannot be written.
void write_text(const std::filesystem::path& path, const std::string& text);

/// Writes a list of rows as JSON, likewise.
void write_rows(const std::filesystem::path& path, const nlohmann::json& rows);

}  // namespace insonify
