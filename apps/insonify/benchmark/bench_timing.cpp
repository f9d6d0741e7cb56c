// bench_timing.cpp -- clocks, medians and output of the benchmarks.

#include "benchmark/bench_timing.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "insonify/error.h"

namespace insonify {

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * kMilliseconds;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.flush();
  if (!file) {
    throw Error(fmt::format("{}: cannot be written", path.string()));
  }
}

void write_rows(const std::filesystem::path& path, const nlohmann::json& rows) {
  write_text(path, rows.dump(2) + '\n');
}

}  // namespace insonify
