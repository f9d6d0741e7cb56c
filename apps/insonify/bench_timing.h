// bench_timing.h -- what the benches share: clocks, medians, rows.

#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace insonify {

inline constexpr double kMilliseconds = 1e3;  // In a second.

[[nodiscard]] double median(std::vector<double> values);
[[nodiscard]] double milliseconds_since(std::chrono::steady_clock::time_point start);

/// @throws Error when it cannot be written.
void write_text(const std::filesystem::path& path, const std::string& text);

/// Writes a list of rows.  @throws Error
void write_rows(const std::filesystem::path& path, const nlohmann::json& rows);

}  // namespace insonify
