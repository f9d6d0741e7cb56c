// survey.cpp -- insonify survey plan: what a survey's pattern will fly and cover, before it is run.

#include <fmt/format.h>

#include <cmath>

#include "console/commands.h"
#include "console/console.h"
#include "console/outcome.h"
#include "insonify/files.h"
#include "insonify/recording_formats.h"
#include "insonify/survey_plan.h"

namespace insonify {
namespace {

struct PlanOptions {
  std::filesystem::path scenario;
  std::filesystem::path picture;      // Empty: none.
  int height = 900;                   // Of the picture [pixels].
  std::vector<std::string> settings;  // "key=value", in order.
};

std::string time_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::llround(seconds));
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string span_text(double least, double most, const char* unit) {
  const std::string low = fmt::format("{:.3g}", least), high = fmt::format("{:.3g}", most);
  return low == high ? fmt::format("{} {}", low, unit) : fmt::format("{} to {} {}", low, high, unit);
}

std::string length_text(double metres) {
  constexpr double kLong = 10'000, kKilometre = 1000;
  return metres < kLong ? fmt::format("{:.5g} m", metres) : fmt::format("{:.4g} km", metres / kKilometre);
}

void print_lines(const SurveyPlan& plan) {
  std::vector<Row> rows = {{"line", "from x, y", "to x, y", "begins", "ends", "altitude"}};
  for (std::size_t i = 0; i < plan.lines.size(); ++i) {
    const PlannedLine& line = plan.lines[i];
    const auto point = [](const PlanPoint& at) {
      const auto rounded = [](double value) {
        return std::round(value * 10) / 10 + 0;
      };  // Adding zero turns -0 into 0.
      return fmt::format("{:.1f}, {:.1f}", rounded(at.x()), rounded(at.y()));
    };
    rows.push_back(
        {fmt::to_string(i + 1), point(line.begin), point(line.end), time_text(line.begin_time),
         time_text(line.end_time),
         std::isfinite(line.least_altitude) ? span_text(line.least_altitude, line.most_altitude, "m") : "-"});
  }
  print_table(rows);
}

void print_whole(const SurveyPlan& plan) {
  say("\n{}{}: {} on lines, {} with turns, {} at {:.3g} m/s; steepest {:.3g} deg; {}\n\n",
      counted(plan.lines.size(), "line"),
      plan.spacing > 0 ? fmt::format(", {:.4g} m apart", plan.spacing) : std::string(), length_text(plan.line_length),
      length_text(plan.length), time_text(plan.duration), plan.length / plan.duration,
      std::round(10 * degrees_from_radians(plan.steepest)) / 10,
      plan.pings_on_turns ? "pings on turns too" : "no pings on turns");
}

void print_sonars(const SurveyPlan& plan, const Scenario& scenario) {
  std::vector<Row> rows = {{"sonar", "pings", "every", "recording", "swath", "overlap", "covers"}};
  for (std::size_t i = 0; i < plan.sonars.size(); ++i) {
    const PlannedSonar& sonar = plan.sonars[i];
    const auto percent = [](const std::optional<double>& share) {
      return share ? fmt::format("{:.3g} %", std::round(1000 * *share) / 10 + 0) : "-";  // Without -0 and 1e-06.
    };
    rows.push_back({sonar.name, fmt::to_string(sonar.pings), fmt::format("{:.2g} m", sonar.ping_distance),
                    bytes_text(recording_bytes(scenario, scenario.sonars[i], sonar.pings)),
                    sonar.least_swath ? span_text(*sonar.least_swath, *sonar.most_swath, "m") : "none",
                    percent(sonar.overlap), percent(sonar.covered)});
  }
  print_table(rows);
}

int plan(const PlanOptions& options) {
  if (!options.picture.empty() && options.picture.extension() != ".png") {
    throw InputError(fmt::format("--output {}: must end in .png", options.picture.string()));
  }
  return checked_input([&] {
    const Scenario scenario = load_scenario(options.scenario, options.settings, log_to_user(false));
    const Scene scene = load_scene(scenario, log_to_user(false));
    const SurveyPlan plan = plan_survey(scenario, scene);
    print_lines(plan);
    print_whole(plan);
    print_sonars(plan, scenario);
    for (const PlannedSonar& sonar : plan.sonars) {
      if (scenario.pattern->lines.height && sonar.overlap && *sonar.overlap < 0) {  // Else the reader has said so.
        complain(fmt::format("warning: lines are {:.4g} m apart, the swath of {} is {}: there are gaps between them",
                             plan.spacing, sonar.name, span_text(*sonar.least_swath, *sonar.most_swath, "m wide")));
      }
    }
    if (!options.picture.empty()) {
      write_png(options.picture, draw_survey_plan(plan, options.height));
      say("\n{}\n", options.picture.string());
    }
    return kDone;
  });
}

}  // namespace

void add_survey(const Command& program) {
  const Command survey = program.add("survey", "Plan surveys");
  const Command command =
      survey.add("plan", "Show what the pattern of a scenario will fly and cover, before it is run");
  auto& options = command.keep<PlanOptions>();
  command.argument("SCENARIO", &options.scenario, "Scenario file (YAML) with a pattern");
  command.option("-o,--output", "FILE", &options.picture, "Draw the plan into this PNG file");
  command.option("--height", "N", &options.height, "Height of the picture [900]", whole_number(240, 8192));
  command.option("--set", "KEY=VALUE", &options.settings,
                 "Change a key of the scenario, such as pattern.lines.altitude=8; may be repeated");
  command.footer(
      "Prints lines, times, pings, sizes of recordings, swaths and what they cover.\n\n"
      "Example:\n"
      "  insonify survey plan survey -o plan.png");
  command.act([&options] { return plan(options); });
}

}  // namespace insonify
