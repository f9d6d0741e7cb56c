// bench_timing.h -- clocks, medians and output of rows, shared by the benchmarks.

#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "console/console.h"
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

/// Rows of a benchmark: each is printed at once, all are written as JSON at the end.
class BenchRows {
 public:
  /// Begins a table.
  /// @param name    Value of "table" in each of its rows; empty for none.
  /// @param format  Of a printed row. Values behind the last that it prints are in the JSON only.
  /// @param keys    Names of a row's values in the JSON.
  void begin(std::string name, std::string format, std::vector<std::string> keys);

  /// @param values  As many as there are keys.
  /// @return  The row as it will be written, to add more to it.
  template <typename... Values>
  nlohmann::json& add(const Values&... values) {
    say_text(fmt::format(fmt::runtime(format_), values...));
    flush_output();
    return add_json({nlohmann::json(values)...});
  }

  /// Writes nothing if the path is empty.
  /// @throws Error if the file cannot be written.
  void write(const std::filesystem::path& path) const;

 private:
  nlohmann::json& add_json(const std::vector<nlohmann::json>& values);

  std::string name_, format_;
  std::vector<std::string> keys_;
  nlohmann::json rows_ = nlohmann::json::array();
};

}  // namespace insonify
