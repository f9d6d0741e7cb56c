// request_bench.cpp -- options of `insonify bench`.

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "console/validators.h"
#include "request.h"

namespace insonify {
namespace {

// Options shared by all benchmarks.
void add_common(CLI::App& command, BenchOptions& options) {
  command.add_option("--triangles", options.triangles, "About how many triangles each scene has [1000 100000 1000000]")
      ->check(whole_number(1, 100'000'000))
      ->type_name("N ...");
  command.add_option("--repetitions", options.repetitions, "Timed pings of each row [40]")
      ->check(whole_number(1, 1'000'000))
      ->type_name("N");
  command.add_option("--json", options.json, "Write the rows to this file too")->type_name("FILE");
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

CLI::Validator a_sampling() {
  return CLI::Validator(
      [](const std::string& text) {
        return sampling_from(text) ? std::string()
                                   : fmt::format(
                                         "{} must be columns per beam, from 1 to 256, and rows, from 2 to 8192, "
                                         "such as 4x200",
                                         text);
      },
      "");
}

void add_sampling_bench(CLI::App& bench, Request& request) {
  SamplingBenchOptions& options = request.sampling_bench;
  CLI::App* command =
      bench.add_subcommand("sampling", "The error of a ping's finite sampling against its computing time");
  command
      ->add_option("SCENARIO", options.scenarios, "Scenarios of the calibrated model, besides the benchmarks' scenes")
      ->type_name("FILE ...");
  command->add_option("--triangles", options.triangles, "Sizes of the benchmarks' scenes; 0 for none [1000 100000]")
      ->check(whole_number(0, 100'000'000))
      ->type_name("N ...");
  command
      ->add_option_function<std::vector<std::string>>(
          "--sampling",
          [&options](const std::vector<std::string>& texts) {
            options.samplings.clear();
            for (const std::string& text : texts) {
              options.samplings.push_back(sampling_from(text).value());
            }
          },
          "Samples of a beam to compare, columns x rows [2x100 4x100 2x200 4x200 4x400 8x400]")
      ->check(a_sampling())
      ->type_name("CxR ...");
  command
      ->add_option_function<std::string>(
          "--converged", [&options](const std::string& text) { options.converged = sampling_from(text).value(); },
          "Samples of the pings they are compared with [32x1600]")
      ->check(a_sampling())
      ->type_name("CxR");
  command->add_option("--pings", options.pings, "Pings of each scene, spread over the scenario's [3]")
      ->check(whole_number(1, 1'000))
      ->type_name("N");
  command->add_option("--repetitions", options.repetitions, "Times that each is timed [7]")
      ->check(whole_number(1, 1'000'000))
      ->type_name("N");
  command->add_option("--threads", options.threads, "Worker threads [2]")->check(whole_number(1, 1024))->type_name("N");
  command->add_option("--json", options.json, "Write the rows to this file too")->type_name("FILE");
  command->footer(
      "Example:\n  insonify bench sampling scenes/ferry_calibrated.yaml --triangles 1000 --sampling 4x100 4x200");
  command->callback([&request, &options] {
    std::erase(options.triangles, 0);
    request.act = [&options] { return bench_sampling(options); };
  });
}

}  // namespace

void add_bench(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("bench", "Measure how fast this machine is");
  command->require_subcommand(1);
  command->footer("Help on one: insonify bench engine --help");
  BenchOptions& options = request.bench;

  CLI::App* engine = command->add_subcommand("engine", "Whole pings against the bare traversal of their rays");
  add_common(*engine, options);
  engine->add_option("--threads", options.threads, "Worker threads [1 2]")
      ->check(whole_number(1, 1024))
      ->type_name("N ...");
  engine->footer("Example:\n  insonify bench engine --triangles 1000 100000 --threads 1 --json rows.json");
  engine->callback([&request, &options] { request.act = [&options] { return bench_engine(options); }; });

  CLI::App* paper = command->add_subcommand("paper", "The paper's tables of computing times, on its workload");
  PaperBenchOptions& of_paper = request.paper_bench;
  paper->add_option("--samples", of_paper.samples, "Scenes of each row [500]")
      ->check(whole_number(1, 1'000'000))
      ->type_name("N");
  paper->add_option("--scene", request.bench_scene, "random, or filled: one that fills the fan [random]")
      ->check(one_of({"random", "filled"}))
      ->type_name("NAME");
  paper->add_option("--threads", of_paper.threads, "Worker threads [2]")->check(whole_number(1, 1024))->type_name("N");
  paper->add_option("--json", of_paper.json, "Write the rows to this file too")->type_name("FILE");
  paper->add_option("--markdown", of_paper.markdown, "Write them as a table to this file too")->type_name("FILE");
  paper->footer("Example:\n  insonify bench paper --samples 50 --json rows.json");
  paper->callback([&request, &of_paper] {
    of_paper.filled = request.bench_scene == "filled";
    request.act = [&of_paper] { return bench_paper(of_paper); };
  });

  CLI::App* primary = command->add_subcommand("primary", "Primary echoes that rays trace against drawn ones");
  add_common(*primary, options);
  primary->footer("Example:\n  insonify bench primary --triangles 1000 10000 100000");
  primary->callback([&request, &options] { request.act = [&options] { return bench_primary(options); }; });

  CLI::App* batch = command->add_subcommand("batch", "Batches of pings against the same pings one by one");
  add_common(*batch, options);
  batch->add_option("--threads", options.threads, "Worker threads [1 2]")
      ->check(whole_number(1, 1024))
      ->type_name("N ...");
  batch->footer("Example:\n  insonify bench batch --triangles 1000 --threads 2");
  batch->callback([&request, &options] { request.act = [&options] { return bench_batch(options); }; });

  CLI::App* changes = command->add_subcommand("changes", "Sonars and objects that change while a simulator runs");
  add_common(*changes, options);
  changes->footer("Example:\n  insonify bench changes --triangles 1000 100000");
  changes->callback([&request, &options] { request.act = [&options] { return bench_changes(options); }; });

  add_sampling_bench(*command, request);
}

}  // namespace insonify
