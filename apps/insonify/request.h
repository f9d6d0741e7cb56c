// request.h -- parses the command line into the options of a command.

#pragma once

#include <CLI/CLI.hpp>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "benchmark/bench.h"
#include "compare/compare.h"
#include "emulate/emulate.h"
#include "export/export.h"
#include "info/info.h"
#include "pictures/draw.h"
#include "replay/replay.h"
#include "run/run.h"
#include "serve/serve.h"
#include "transport/bridge_options.h"

namespace insonify {

/// The parsed command line; `act` runs the requested command.
struct Request {
  RunOptions run;
  CompareOptions compare;
  DrawOptions draw;
  ExportCommand exported;
  InfoOptions info;
  ServeOptions serve;
  ReplayOptions replay;
  EmulateOptions emulate_oculus, emulate_ping360;
  int pings = 1;
  double duration = 0, turns = 0;
  std::uint64_t seed = 1;
  std::string engine;
  std::string record = "h5";
  std::string bits;
  double rate = 0;
  std::string preset, mode;
  std::string section;
  std::string shell;
  BenchOptions bench;
  PaperBenchOptions paper_bench;
  SamplingBenchOptions sampling_bench;
  std::string bench_scene;
  bool strict = false;
  bool markdown = false;
  bool in_viewer = false;
  bool no_pictures = false, no_view = false, no_ms_ssim = false;
  std::deque<BridgeRequest> bridges;  // One for each of bridge_kinds().
  std::vector<std::string> words;     // The command line, without the program.
  std::function<int()> act;
};

/// Options that two commands have: those that draw a recording's pings, and those that serve the viewer's page.
void add_draw_options(CLI::App& command, DrawOptions& options);
void add_server_options(CLI::App& command, PageServerOptions& options, const std::string& group);

/// Each adds one command to the program. Parsing it sets the request's `act`. The request must outlive the app.
void add_run(CLI::App& app, Request& request);
void add_sonars(CLI::App& app, Request& request);
void add_describe(CLI::App& app, Request& request);
void add_serve(CLI::App& app, Request& request);
void add_emulate(CLI::App& app, Request& request);
void add_bridge(CLI::App& app, Request& request);
void add_draw(CLI::App& app, Request& request);
void add_replay(CLI::App& app, Request& request);
void add_info(CLI::App& app, Request& request);
void add_export(CLI::App& app, Request& request);
void add_compare(CLI::App& app, Request& request);
void add_bench(CLI::App& app, Request& request);
void add_version(CLI::App& app, Request& request);
void add_completion(CLI::App& app, Request& request);
void add_manual(CLI::App& app, Request& request);

}  // namespace insonify
