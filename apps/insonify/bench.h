// bench.h -- timings, made by the program itself so that anyone can repeat them.

#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace insonify {

struct BenchOptions {
  std::vector<int> triangles = {1'000, 100'000, 1'000'000};
  std::vector<int> threads = {1, 2};
  int repetitions = 40;        ///< Timed pings of each row, after a warm-up.
  std::filesystem::path json;  ///< Where the rows are written too; empty for nowhere.
};

/// insonify bench engine: a ping, and the bare traversal of its rays, on scenes of growing size; then both models.
int bench_engine(const BenchOptions& options);

/// The second of its tables; its rows are added to `rows`.
void bench_models(const BenchOptions& options, nlohmann::json& rows);

struct PaperBenchOptions {
  int samples = 500;  ///< Scenes of each row.
  int threads = 2;
  bool filled = false;                   ///< The scene that fills the fan, instead of random ones.
  std::filesystem::path json, markdown;  ///< Where the rows are written too; empty for nowhere.
};

/// insonify bench paper: the paper's tables of computing times, on its workload.
int bench_paper(const PaperBenchOptions& options);

/// insonify bench changes: sonars and objects that change while a simulator runs.
int bench_changes(const BenchOptions& options);

/// insonify bench primary: primaries traced and drawn, and the choice of `primary: auto`; on one thread.
int bench_primary(const BenchOptions& options);

}  // namespace insonify
