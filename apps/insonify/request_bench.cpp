// request_bench.cpp -- options of `insonify bench`.

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

  CLI::App* changes = command->add_subcommand("changes", "Sonars and objects that change while a simulator runs");
  add_common(*changes, options);
  changes->footer("Example:\n  insonify bench changes --triangles 1000 100000");
  changes->callback([&request, &options] { request.act = [&options] { return bench_changes(options); }; });
}

}  // namespace insonify
