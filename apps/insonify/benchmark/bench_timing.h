// bench_timing.h -- clocks, medians and output of rows, shared by the benchmarks.

#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace insonify {

inline constexpr double kMilliseconds = 1e3;  // Per second.

[[nodiscard]] double median(std::vector<double> values);
[[nodiscard]] double milliseconds_since(std::chrono::steady_clock::time_point start);

/// @throws Error if the file cannot be written.
void write_text(const std::filesystem::path& path, const std::string& text);

/// Writes a list of rows as JSON.  @throws Error
void write_rows(const std::filesystem::path& path, const nlohmann::json& rows);

}  // namespace insonify
