// bench_command.cpp -- options of `insonify bench`.

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "benchmark/bench.h"
#include "console/commands.h"

namespace insonify {
namespace {

constexpr const char* kJson = "Write the rows to this file too";

// Adds a benchmark of scenes of growing size.
// @param with  What it can be timed with besides: several numbers of threads, a graphics card, or neither.
enum class BenchWith { kNothing, kThreads, kDevice };
void add_bench_of_scenes(const Command& bench, const char* name, const char* help, const char* example, BenchWith with,
                         int (*run)(const BenchOptions&)) {
  const Command command = bench.add(name, help);
  auto& options = command.keep<BenchOptions>();
  command.option("--triangles", "N ...", &options.triangles,
                 "About how many triangles each scene has [1000 100000 1000000]", whole_number(1, 100'000'000));
  command.option("--repetitions", "N", &options.repetitions, "Timed pings of each row [40]",
                 whole_number(1, 1'000'000));
  command.option("--json", "FILE", &options.json, kJson);
  if (with == BenchWith::kThreads) {
    command.option("--threads", "N ...", &options.threads, "Worker threads [1 2]", whole_number(1, 1024));
  }
  if (with == BenchWith::kDevice) {
    command.option("--device", "NAME", &options.device, "Graphics card: a part of its name, or its index");
  }
  command.footer(fmt::format("Example:\n  insonify bench {} {}", name, example));
  command.act([&options, run] { return run(options); });
}

void add_paper_bench(const Command& bench) {
  const Command command = bench.add("paper", "The paper's tables of computing times, on its workload");
  auto& options = command.keep<PaperBenchOptions>();
  auto& scene = command.keep<std::string>();
  command.option("--samples", "N", &options.samples, "Scenes of each row [500]", whole_number(1, 1'000'000));
  command.option("--scene", "NAME", &scene, "random, or filled: one that fills the fan [random]",
                 one_of({"random", "filled"}));
  command.option("--threads", "N", &options.threads, "Worker threads [2]", whole_number(1, 1024));
  command.option("--json", "FILE", &options.json, kJson);
  command.option("--markdown", "FILE", &options.markdown, "Write them as a table to this file too");
  command.footer("Example:\n  insonify bench paper --samples 50 --json rows.json");
  command.act([&options, &scene] {
    options.filled = scene == "filled";
    return bench_paper(options);
  });
}

// "4x200" as columns per beam and rows; none if it is not of that form or out of their limits.
std::optional<Sampling> sampling_from(const std::string& text) {
  int columns = 0, rows = 0;
  const char* const end = text.data() + text.size();
  const auto [cross, no_columns] = std::from_chars(text.data(), end, columns);
  if (no_columns != std::errc() || cross == end || *cross != 'x') {
    return {};
  }
  const auto [rest, no_rows] = std::from_chars(cross + 1, end, rows);
  const bool good = no_rows == std::errc() && rest == end;
  return good && columns >= 1 && columns <= 256 && rows >= 2 && rows <= 8192 ? std::optional(Sampling{columns, rows})
                                                                             : std::nullopt;
}

void add_sampling_bench(const Command& bench) {
  const Command command = bench.add("sampling", "The error of a ping's finite sampling against its computing time");
  auto& options = command.keep<SamplingBenchOptions>();
  auto& samplings = command.keep<std::vector<std::string>>();
  const Check a_sampling = {[](const std::string& text) {
    return sampling_from(text)
               ? std::string()
               : text + " must be columns per beam, from 1 to 256, and rows, from 2 to 8192, such as 4x200";
  }};
  command.option("SCENARIO", "FILE ...", &options.scenarios,
                 "Scenarios of the calibrated model, besides the benchmarks' scenes");
  command.option("--triangles", "N ...", &options.triangles,
                 "Sizes of the benchmarks' scenes; 0 for none [1000 100000]", whole_number(0, 100'000'000));
  command.option("--sampling", "CxR ...", &samplings,
                 "Samples of a beam to compare, columns x rows [2x100 4x100 2x200 4x200 4x400 8x400]", a_sampling);
  command.option(
      "--converged", "CxR", [&options](const std::string& text) { options.converged = sampling_from(text).value(); },
      "Samples of the pings they are compared with [32x1600]", a_sampling);
  command.option("--pings", "N", &options.pings, "Pings of each scene, spread over the scenario's [3]",
                 whole_number(1, 1'000));
  command.option("--repetitions", "N", &options.repetitions, "Times that each is timed [7]",
                 whole_number(1, 1'000'000));
  command.option("--threads", "N", &options.threads, "Worker threads [2]", whole_number(1, 1024));
  command.option("--json", "FILE", &options.json, kJson);
  command.footer(
      "Example:\n  insonify bench sampling scenes/ferry_calibrated.yaml --triangles 1000 --sampling 4x100 4x200");
  command.act([&options, &samplings] {
    std::erase(options.triangles, 0);
    if (!samplings.empty()) {
      options.samplings.clear();
    }
    for (const std::string& text : samplings) {
      options.samplings.push_back(sampling_from(text).value());
    }
    return bench_sampling(options);
  });
}

void add_growth_bench(const Command& bench) {
  const Command command = bench.add("growth", "How set-up and ping grow with each quantity of a scenario");
  auto& options = command.keep<GrowthBenchOptions>();
  command.option("WHAT", "NAME ...", &options.grows,
                 fmt::format("What grows: {} [all]", fmt::join(growth_names(), ", ")), one_of(growth_names()));
  command.option("--doublings", "N", &options.doublings, "Rows of each, each twice as large as the last [3]",
                 whole_number(1, 10));
  command.option("--divided-by", "N", &options.divided_by, "Divides the sizes of the first rows, for a quick look [1]",
                 whole_number(1, 1000));
  command.option("--repetitions", "N", &options.repetitions, "Set-ups and pings of each row [3]",
                 whole_number(1, 1'000));
  command.option("--threads", "N", &options.threads, "Worker threads [2]", whole_number(1, 1024));
  command.option("--json", "FILE", &options.json, kJson);
  command.footer("Example:\n  insonify bench growth beams focus --doublings 4 --json rows.json");
  command.act([&options] { return bench_growth(options); });
}

}  // namespace

void add_bench(const Command& program) {
  const Command bench = program.add("bench", "Measure how fast this machine is");
  bench.footer("Help on one: insonify bench engine --help");
  add_bench_of_scenes(bench, "engine", "Whole pings against the bare traversal of their rays",
                      "--triangles 1000 100000 --threads 1 --json rows.json", BenchWith::kThreads, bench_engine);
  add_paper_bench(bench);
  add_bench_of_scenes(bench, "primary", "Primary echoes that rays trace against drawn ones",
                      "--triangles 1000 10000 100000", BenchWith::kNothing, bench_primary);
  add_bench_of_scenes(bench, "batch", "Batches of pings against the same pings one by one",
                      "--triangles 1000 --threads 2", BenchWith::kThreads, bench_batch);
  add_bench_of_scenes(bench, "survey", "Side-scan sonars and multibeams beside the instruments' own rates",
                      "--triangles 100000 --threads 2", BenchWith::kThreads, bench_survey);
  add_bench_of_scenes(bench, "device", "Pings of engine gpu on a graphics card, beside those of engine cpu",
                      "--triangles 1000 100000 --device 0", BenchWith::kDevice, bench_device);
  add_bench_of_scenes(bench, "changes", "Sonars and objects that change while a simulator runs",
                      "--triangles 1000 100000", BenchWith::kNothing, bench_changes);
  add_sampling_bench(bench);
  add_growth_bench(bench);
}

}  // namespace insonify
