// main.cpp -- parses the command line, runs the command and sets the exit status.

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/engine.h"
#include "insonify/files.h"
#include "insonify/version.h"

namespace insonify {
namespace {

int version() {
  const auto engines = engine_names();
  say("insonify {}\nengines: {}\ndevices of engine gpu: {}\n", kVersion, fmt::format("{}", fmt::join(engines, ", ")),
      fmt::format("{}", fmt::join(device_texts(), "; ")));
  return kDone;
}

// insonify version, and --version.
void add_version(const Command& program) {
  program.print_flag(
      "--version", [] { (void)version(); }, "Print the version");
  const Command command = program.add("version", "Print the version, the built-in engines and the graphics cards");
  command.footer("Example:\n  insonify version");
  command.act(version);
}

int run_program(std::vector<std::string> words) {
  if (std::erase(words, "--in-process") > 0) {
    read_files_in_process();
  }
  CommandLine program("insonify", "insonify -- what imaging sonars would show of a 3-D scene");
  program.footer(
      "Start with:  insonify run sphere\n"
      "In a browser: insonify serve ferry_calibrated\n"
      "Help on one: insonify run --help\n"
      "For debuggers, anywhere: --in-process reads files without insonify-read, which keeps crashes apart");
  add_run(program);
  add_serve(program);
  add_emulate(program);
  add_bridge(program, words);
  add_draw(program);
  add_replay(program);
  add_info(program);
  add_export(program);
  add_mosaic(program);
  add_grid(program);
  add_scenes(program);
  add_sonars(program);
  add_describe(program);
  add_compare(program);
  add_survey(program);
  add_bench(program);
  add_version(program);
  add_completion(program);
  add_manual(program);
  return program.parse(words) ? program.run() : kDone;
}

}  // namespace
}  // namespace insonify

int main(int argc, char** argv) {
  return insonify::run_guarded([&] { return insonify::run_program({argv + (argc > 0 ? 1 : 0), argv + argc}); });
}
