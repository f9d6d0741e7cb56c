// request_texts.cpp -- options of the commands that only print text: sonars, describe and version.

#include "about/about.h"
#include "request.h"

namespace insonify {

void add_sonars(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("sonars", "List the instruments with presets, or describe one");
  command->add_option("PRESET", request.preset, "Instrument to describe, with the source of each number");
  command->add_option("--mode", request.mode, "Mode of it, such as low or high")->type_name("MODE");
  command->footer(
      "Examples:\n"
      "  insonify sonars\n"
      "  insonify sonars blueprint-oculus-m750d --mode high\n\n"
      "Folders of your own presets, named in INSONIFY_PRESETS (separated by colons), add to the shipped ones.");
  command->callback([&request] { request.act = [&request] { return sonars(request.preset, request.mode); }; });
}

void add_describe(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("describe", "List every key of a scenario: unit, limits, default, meaning");
  command->add_option("SECTION", request.section, "One section only: water, sonars, paper ...");
  command->add_flag("--markdown", request.markdown, "As a page of the manual");
  command->footer("Examples:\n  insonify describe\n  insonify describe sonars");
  command->callback([&request] { request.act = [&request] { return describe(request.section, request.markdown); }; });
}

void add_version(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("version", "Print the version and the built-in engines");
  command->footer("Example:\n  insonify version");
  command->callback([&request] { request.act = version; });
}

}  // namespace insonify
