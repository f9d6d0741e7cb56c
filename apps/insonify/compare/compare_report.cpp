// compare_report.cpp -- prints a comparison as tables and writes it as JSON.

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/comparison.h"
#include "console/console.h"
#include "insonify/printable.h"

namespace insonify {
namespace {

// Score of two identical pictures.
constexpr Similarity kEqual = {.mse = 0,
                               .psnr_db = std::numeric_limits<double>::infinity(),
                               .ssim = 1,
                               .ms_ssim = 1,
                               .correlation = 1,
                               .ks_distance = 0};

struct Measure {
  Field field;
  double value;
};

std::vector<Measure> measures(const Similarity& similarity) {
  std::vector<Measure> list;
  Similarity::visit_fields(similarity, [&](const Field& field, double value) { list.push_back({field, value}); });
  return list;
}

struct Control {
  const char* name;  // In tables.
  const char* key;   // In JSON.
  const char* meaning;
  Similarity similarity;
};

std::array<Control, 3> named(const ControlSimilarities& controls) {
  return {{{"flat grey", "flat_grey", "its mean everywhere", controls.flat_grey},
           {"range profile", "range_profile", "the mean of each row", controls.range_profile},
           {"pixel shuffle", "pixel_shuffle", "its pixels in random order", controls.pixel_shuffle}}};
}

std::string number(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.4g}", value);
}

// Turns "Local structure." into its form in the middle of a sentence.
std::string words(std::string_view help) {
  std::string text(help.substr(0, help.size() - 1));
  text.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
  return text;
}

std::string meaning(const Measure& measure, const Comparison& comparison) {
  if (measure.field.name != "ms_ssim" || comparison.ms_ssim_scales == 0) {
    return words(measure.field.help);
  }
  return comparison.ms_ssim_scales == kMsSsimScales
             ? "structure at five scales"
             : fmt::format("structure at {} of five scales: the pictures are small", comparison.ms_ssim_scales);
}

std::string heading(const Comparison& comparison) {
  const std::string shape =
      fmt::format("{} x {}", counted(comparison.columns, "column"), counted(comparison.rows, "row"));
  std::string text = fmt::format("{} and {}", comparison.a, comparison.b);
  if (!comparison.sonar.empty()) {
    text += ", sonar " + comparison.sonar;
  }
  if (comparison.pings.empty()) {
    return text + ": " + shape;
  }
  const std::size_t count = comparison.pings.size();
  text += fmt::format(": {} ping{}", count, count == 1 ? "" : "s");
  if (!comparison.unmatched.empty()) {
    text += fmt::format(" that both have ({})", comparison.unmatched);
  }
  if (comparison.is_scan) {
    const bool one = comparison.columns == static_cast<int>(count);
    return text + fmt::format(" of {}, side by side: ", one ? "one beam" : "two beams") + shape;
  }
  return text + " of " + fmt::format("{} x {}", counted(comparison.columns, "beam"), counted(comparison.rows, "bin")) +
         (count > 1 ? "; each number is the mean over them" : "");
}

// The intensities mapped to 0 and 1, unless they are fractions of full scale.
std::string levels_line(const Comparison& comparison) {
  const Display& levels = comparison.levels;
  if (comparison.pings.empty() || (levels.scale == Scale::kLinear && levels.full_scale == 1)) {
    return "";
  }
  if (levels.scale == Scale::kLinear) {
    return fmt::format("levels from 0 to 1 are intensities from 0 to {:.4g}", levels.full_scale);
  }
  return fmt::format("levels from 0 to 1 are decibels from {:.4g} to 0 re an intensity of {:.4g}", levels.floor_db,
                     levels.full_scale);
}

void print_similarity(const Comparison& comparison) {
  const NormalisedSimilarity& normal = comparison.normalised;
  const std::array normalised = {number(normal.mse), number(normal.psnr), number(normal.ssim), number(normal.ms_ssim)};
  const std::vector<Measure> equal = measures(kEqual);
  std::vector<Row> rows = {{"measure", "value", "0 to 1", "if equal", "meaning"}};
  for (const Measure& measure : measures(comparison.similarity)) {
    const std::size_t i = rows.size() - 1;
    rows.push_back({std::string(measure.field.name), number(measure.value), i < normalised.size() ? normalised[i] : "",
                    number(equal[i].value), meaning(measure, comparison)});
  }
  print_table(rows);
}

// Marks scores of a control that are at least as good as the comparison's.
Row control_row(const Control& control, const Similarity& ours) {
  const std::vector<Measure> own = measures(ours), equal = measures(kEqual);
  Row row = {control.name};
  for (const Measure& measure : measures(control.similarity)) {
    const std::size_t i = row.size() - 1;
    const bool less_is_better = equal[i].value == 0;
    const bool no_worse = less_is_better ? measure.value <= own[i].value : measure.value >= own[i].value;
    row.push_back(number(measure.value) + (no_worse ? " *" : ""));
  }
  row.emplace_back(control.meaning);
  return row;
}

void print_controls(const Comparison& comparison) {
  say("\nScores of controls made from {}, without content of the scene:\n\n", comparison.a);
  std::vector<Row> rows = {{"picture"}, {comparison.b}};
  for (const Measure& measure : measures(comparison.similarity)) {
    rows[0].emplace_back(measure.field.name);
    rows[1].push_back(number(measure.value));
  }
  rows[0].emplace_back("is");
  rows[1].emplace_back("");
  bool marked = false;
  for (const Control& control : named(comparison.controls)) {
    rows.push_back(control_row(control, comparison.similarity));
    for (const std::string& cell : rows.back()) {
      marked = marked || cell.ends_with('*');
    }
  }
  print_table(rows);
  if (marked) {
    say("\n* no worse than {}: this number by itself says nothing for it.\n", comparison.b);
  }
}

// Infinite and omitted numbers become null.
nlohmann::ordered_json to_json(const Similarity& similarity) {
  nlohmann::ordered_json object;
  for (const Measure& measure : measures(similarity)) {
    object[std::string(measure.field.name)] =
        std::isfinite(measure.value) ? nlohmann::ordered_json(measure.value) : nlohmann::ordered_json();
  }
  return object;
}

}  // namespace

void print_comparison(const Comparison& comparison) {
  say("{}\n", heading(comparison));
  if (const std::string line = levels_line(comparison); !line.empty()) {
    say("{}\n", line);
  }
  for (const std::string& note : comparison.notes) {
    say("note: {}\n", note);
  }
  if (!comparison.hint.empty()) {
    say("hint: {}\n", comparison.hint);
  }
  if (!comparison.differing.empty()) {
    say("warning: different {}; pixels of the same bin and beam are compared all the same\n", comparison.differing);
  }
  say("\n");
  print_similarity(comparison);
  print_controls(comparison);
}

void print_comparison_json(const Comparison& comparison) {
  nlohmann::ordered_json json = {{"a", comparison.a},         {"b", comparison.b},
                                 {"sonar", comparison.sonar}, {"columns", comparison.columns},
                                 {"rows", comparison.rows},   {"pictures", comparison.each.size()},
                                 {"pings", comparison.pings}};
  if (!comparison.pings.empty()) {
    json["levels"] = {{"scale", comparison.levels.scale == Scale::kDecibel ? "db" : "linear"},
                      {"full_scale", comparison.levels.full_scale},
                      {"floor_db", comparison.levels.floor_db}};
  }
  if (!comparison.differing.empty()) {
    json["differing"] = comparison.differing;
  }
  if (!comparison.notes.empty()) {
    json["notes"] = comparison.notes;
  }
  if (!comparison.hint.empty()) {
    json["hint"] = comparison.hint;
  }
  json["ms_ssim_scales"] = comparison.ms_ssim_scales;
  json.update(to_json(comparison.similarity));
  NormalisedSimilarity::visit_fields(comparison.normalised, [&](const Field& field, double value) {
    json["normalised"][std::string(field.name)] =
        std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  });
  for (const Control& control : named(comparison.controls)) {
    json["controls"][control.key] = to_json(control.similarity);
  }
  for (const Similarity& one : comparison.each) {
    json["each"].push_back(to_json(one));
  }
  // Names may hold control characters and invalid UTF-8: ASCII output with escapes is valid JSON in every case.
  constexpr bool kAscii = true;
  say_text(json.dump(2, ' ', kAscii, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace insonify
