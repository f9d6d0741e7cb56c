// bench_timing.cpp -- clocks, medians and output of the benchmarks.

#include "benchmark/bench_timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <utility>

#include "insonify/error.h"

namespace insonify {

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * kMilliseconds;
}

double median_ratio(const std::vector<double>& above, const std::vector<double>& below) {
  std::vector<double> ratios(above.size());
  std::ranges::transform(above, below, ratios.begin(), std::divides());
  return median(std::move(ratios));
}

std::vector<double> time_pings(Simulator& simulator, int count, std::uint64_t& number, Ping& ping) {
  std::vector<double> times;
  for (int i = -kWarmUpPings; i < count; ++i) {
    const auto start = std::chrono::steady_clock::now();
    simulator.ping(0, {.number = number++}, ping);
    if (i >= 0) {
      times.push_back(milliseconds_since(start));
    }
  }
  return times;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  if (path.empty()) {
    return;
  }
  std::ofstream file(path);
  file << text;
  file.flush();
  if (!file) {
    throw Error(fmt::format("{}: cannot be written", path.string()));
  }
}

void BenchRows::begin(std::string name, std::string format, std::vector<std::string> keys) {
  name_ = std::move(name);
  format_ = std::move(format);
  keys_ = std::move(keys);
}

nlohmann::json& BenchRows::add_json(const std::vector<nlohmann::json>& values) {
  nlohmann::json& row = rows_.emplace_back(nlohmann::json::object());
  if (!name_.empty()) {
    row["table"] = name_;
  }
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    row[keys_[i]] = values.at(i);
  }
  return row;
}

void BenchRows::write(const std::filesystem::path& path) const {
  write_text(path, rows_.dump(2) + '\n');
}

}  // namespace insonify
