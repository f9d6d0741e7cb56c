// bench.h -- benchmarks of `insonify bench`, part of the program so that anyone can repeat them.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "insonify/sonar_config.h"

namespace insonify {

class BenchRows;

struct BenchOptions {
  std::vector<int> triangles = {1'000, 100'000, 1'000'000};
  std::vector<int> threads = {1, 2};
  int repetitions = 40;        ///< Timed pings per row, after a warm-up.
  std::string device;          ///< See Scenario::device; for bench_device().
  std::filesystem::path json;  ///< Also write the rows to this file; empty for none.
};

/// insonify bench engine: times a ping and the bare traversal of its rays on scenes of growing size, then both models.
int bench_engine(const BenchOptions& options);

/// Times both models, the second table of bench engine; appends its rows to `rows`.
void bench_models(const BenchOptions& options, BenchRows& rows);

struct PaperBenchOptions {
  int samples = 500;  ///< Scenes per row.
  int threads = 2;
  bool filled = false;                   ///< Use the scene that fills the fan instead of random ones.
  std::filesystem::path json, markdown;  ///< Also write the rows to these files; empty for none.
};

/// insonify bench paper: reproduces the paper's tables of computing times, on its workload.
int bench_paper(const PaperBenchOptions& options);

/// insonify bench batch: times batches of pings against the same pings one by one.
int bench_batch(const BenchOptions& options);

/// insonify bench survey: pings of side-scan sonars and multibeams beside the instruments' own rates.
int bench_survey(const BenchOptions& options);

/// insonify bench device: times pings of engine gpu, one by one and in batches, beside those of engine cpu.
int bench_device(const BenchOptions& options);

/// insonify bench changes: times changes of sonars and objects while a simulator runs.
int bench_changes(const BenchOptions& options);

/// insonify bench primary: times traced and rasterised primary echoes and the choice of `primary: auto`, on one thread.
int bench_primary(const BenchOptions& options);

struct SamplingBenchOptions {
  std::vector<std::filesystem::path> scenarios;   ///< Scenarios of the calibrated model, after the benchmarks' scenes.
  std::vector<int> triangles = {1'000, 100'000};  ///< Sizes of the benchmarks' scenes.
  std::vector<Sampling> samplings = {{2, 100}, {4, 100}, {2, 200}, {4, 200}, {4, 400}, {8, 400}};
  Sampling converged = {32, 1600};
  int pings = 3;        ///< Pings of each scene, spread over those of its scenario.
  int repetitions = 7;  ///< Times that the pings are timed, after a warm-up.
  int threads = 2;
  std::filesystem::path json;  ///< Also write the rows to this file; empty for none.
};

/// insonify bench sampling: prints the sampling error of pings beside their computing times.
int bench_sampling(const SamplingBenchOptions& options);

struct GrowthBenchOptions {
  std::vector<std::string> grows;  ///< Some of growth_names(); empty: all.
  int doublings = 3;               ///< Rows of each after the first.
  int divided_by = 1;              ///< Divides the sizes of the first rows.
  int repetitions = 3;             ///< Simulators of each row, and timed pings of each of them.
  int threads = 2;
  std::filesystem::path json;  ///< Also write the rows to this file; empty for none.
};

/// insonify bench growth: times set-up and ping while one quantity of a scenario grows, with local exponents.
int bench_growth(const GrowthBenchOptions& options);

/// What bench_growth() can let grow.
[[nodiscard]] std::vector<std::string> growth_names();

}  // namespace insonify
