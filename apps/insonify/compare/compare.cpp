// compare.cpp -- insonify compare: similarity of two recordings or two pictures.

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "compare/compare_source.h"
#include "compare/comparison.h"
#include "console/commands.h"
#include "console/outcome.h"
#include "insonify/recording_formats.h"

namespace insonify {
namespace {

struct CompareOptions {
  std::filesystem::path a, b;        // Recordings, folders of them, or pictures.
  std::string sonar;                 // Sonar whose recording is used in a folder; "" if the folder has only one.
  std::vector<std::uint64_t> pings;  // Numbers from 0; empty: all that both recordings have.
  std::string scale;                 // linear or db; "" for db with recordings of the calibrated model, else linear.
  double floor_db = -50;             // [dB]
  // When absent: the largest intensity of both recordings in the calibrated model, else 1.
  std::optional<double> full_scale;
  bool counts = false;      // Compare the counts of recordings, linear from 0 to the greatest.
  bool no_ms_ssim = false;  // Do not compute MS-SSIM.
  bool json = false;
};

// The requested pings, or all that both recordings have.
std::vector<std::uint64_t> chosen_pings(const CompareSource& a, const CompareSource& b,
                                        const std::vector<std::uint64_t>& wanted) {
  std::uint64_t common = std::numeric_limits<std::uint64_t>::max();
  for (const CompareSource* source : {&a, &b}) {
    if (!source->is_recording()) {
      continue;
    }
    common = std::min(common, source->ping_count());
    for (const std::uint64_t ping : wanted) {
      if (ping >= source->ping_count()) {
        throw Error(fmt::format("{}: there is no ping {}; it has {}, counted from 0", source->name(), ping,
                                source->ping_count()));
      }
    }
    if (source->ping_count() == 0) {
      throw Error(fmt::format("{}: there are no pings in it", source->name()));
    }
  }
  if (!wanted.empty()) {
    return wanted;
  }
  std::vector<std::uint64_t> all(common);
  std::iota(all.begin(), all.end(), std::uint64_t{0});
  return all;
}

// Raw intensities of the calibrated model are small and span many decades: unless requested otherwise, they are
// compared in decibels below the largest intensity of both recordings.
Display levels_of(const CompareOptions& options, const CompareSource& a, const CompareSource& b,
                  const std::vector<std::uint64_t>& pings) {
  const bool calibrated = a.is_calibrated() && b.is_calibrated() && !options.counts;
  Display display;
  display.scale = options.scale == "db" || (options.scale.empty() && calibrated) ? Scale::kDecibel : Scale::kLinear;
  display.floor_db = options.floor_db;
  const double loudest = calibrated && !options.full_scale ? std::max(a.loudest(pings), b.loudest(pings)) : 0;
  display.full_scale = loudest > 0 ? loudest : options.full_scale.value_or(1);
  display.validate();
  return display;
}

// Pings of a side-scan are columns of one picture, which must be as wide as SSIM's window.
void check_columns(const CompareSource& a, const CompareSource& b, const std::vector<std::uint64_t>& wanted) {
  constexpr std::size_t kWindow = 11;
  for (const CompareSource* source : {&a, &b}) {
    if (source->is_scan() && !wanted.empty() && wanted.size() * source->beam_count() < kWindow) {
      throw Error(fmt::format("{}: its pings are columns of one picture, which needs {}: compare all, without --ping",
                              source->name(), kWindow));
    }
  }
}

std::string unmatched(const CompareSource& a, const CompareSource& b) {
  if (!a.is_recording() || !b.is_recording() || a.ping_count() == b.ping_count()) {
    return "";
  }
  const CompareSource& longer = a.ping_count() > b.ping_count() ? a : b;
  return fmt::format("{} has {}", longer.name(), longer.ping_count());
}

// Pictures are compared bin by bin and beam by beam, wherever these lie.
std::string differing(const CompareSource& a, const CompareSource& b) {
  const std::optional<SonarConfig> of_a = a.sonar_config(), of_b = b.sonar_config();
  if (!of_a || !of_b) {
    return "";
  }
  constexpr double kSlack = 1e-6;
  const auto differ = [](double x, double y) { return std::abs(x - y) > kSlack * std::max(std::abs(x), std::abs(y)); };
  std::vector<std::string> texts;
  if (differ(of_a->min_range, of_b->min_range) || differ(of_a->max_range, of_b->max_range)) {
    texts.push_back(fmt::format("ranges of {:.6g} to {:.6g} m and {:.6g} to {:.6g} m", of_a->min_range, of_a->max_range,
                                of_b->min_range, of_b->max_range));
  }
  if (differ(of_a->azimuth_aperture, of_b->azimuth_aperture)) {
    texts.push_back(fmt::format("azimuth apertures of {:.6g} and {:.6g} deg",
                                degrees_from_radians(of_a->azimuth_aperture),
                                degrees_from_radians(of_b->azimuth_aperture)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

// Counts are amplitude or decibels on a scale of the instrument's, and intensities are power: of unequal kinds, levels
// differ even where the echoes agree. The paper's model makes levels.
std::string hint(const CompareSource& a, const CompareSource& b, const std::vector<std::uint64_t>& pings) {
  constexpr double kSixteenBits = 65535;
  for (const CompareSource* source : {&a, &b}) {
    const double greatest = source->greatest_integer();
    if (greatest > kSixteenBits && source->loudest(pings) <= kSixteenBits) {
      return fmt::format(
          "{} has integers up to {:.0f}, compared as fractions of {:.3g}, the greatest of their type; as "
          "counts of 8 or 16 bits they would be fractions of 255 or 65535",
          source->name(), source->loudest(pings), greatest);
    }
  }
  if (a.has_counts() == b.has_counts() || a.is_of_the_paper() || b.is_of_the_paper()) {
    return "";
  }
  const CompareSource& counts = a.has_counts() ? a : b;
  const CompareSource& intensities = a.has_counts() ? b : a;
  return fmt::format("{} has counts, {} intensities: their levels differ even where echoes agree; {}", counts.name(),
                     intensities.name(),
                     intensities.has_both() ? "--counts compares the counts of both"
                     : intensities.is_calibrated()
                         ? "--counts compares counts, which receiver.counts: true adds to a simulation"
                         : "compare counts with counts, or intensities with intensities");
}

// Mean of each measure.
template <typename Measures>
Measures mean(const std::vector<Measures>& all) {
  Measures result = all.front();
  std::vector<double*> sums;
  Measures::visit_fields(result, [&](const Field&, double& sum) { sums.push_back(&sum); });
  for (auto one = all.begin() + 1; one != all.end(); ++one) {
    auto sum = sums.begin();
    Measures::visit_fields(*one, [&](const Field&, double value) { **sum++ += value; });
  }
  for (double* sum : sums) {
    *sum /= static_cast<double>(all.size());
  }
  return result;
}

// Accumulates the similarity of pairs of pictures.
class Tally {
 public:
  Tally(Comparison& comparison, bool ms_ssim) : comparison_(comparison), options_{.ms_ssim = ms_ssim} {}

  void add(const GreyPicture& a, const GreyPicture& b) {
    const Similarity found = compare_pictures(a, b, options_);
    const ControlSimilarities controls = compare_controls(a, options_);
    comparison_.columns = a.columns;
    comparison_.rows = a.rows;
    comparison_.ms_ssim_scales = options_.ms_ssim ? ms_ssim_scales(a.columns, a.rows) : 0;
    comparison_.each.push_back(found);
    normalised_.push_back(normalised(found));
    flat_grey_.push_back(controls.flat_grey);
    range_profile_.push_back(controls.range_profile);
    pixel_shuffle_.push_back(controls.pixel_shuffle);
  }

  void finish() {
    comparison_.similarity = mean(comparison_.each);
    comparison_.normalised = mean(normalised_);
    comparison_.controls = {mean(flat_grey_), mean(range_profile_), mean(pixel_shuffle_)};
  }

 private:
  Comparison& comparison_;
  SimilarityOptions options_;
  std::vector<NormalisedSimilarity> normalised_;
  std::vector<Similarity> flat_grey_, range_profile_, pixel_shuffle_;
};

Comparison compared(const CompareOptions& options) {
  CompareSource a(options.a, options.sonar);
  CompareSource b(options.b, options.sonar);
  if (options.counts) {
    for (CompareSource* source : {&a, &b}) {
      source->use_counts();
    }
  }
  Comparison comparison;
  comparison.a = a.name();
  comparison.b = b.name();
  comparison.sonar = a.sonar().empty() ? b.sonar() : a.sonar();
  for (const CompareSource* source : {&a, &b}) {
    const std::vector<std::string> notes = source->notes();
    comparison.notes.insert(comparison.notes.end(), notes.begin(), notes.end());
  }
  Tally tally(comparison, !options.no_ms_ssim);
  if (!a.is_recording() && !b.is_recording()) {
    if (!options.sonar.empty() || !options.pings.empty()) {
      throw Error(fmt::format("{} and {} are pictures; --sonar and --ping choose from recordings", a.name(), b.name()));
    }
    tally.add(a.picture(0), b.picture(0));
  } else {
    check_columns(a, b, options.pings);
    comparison.pings = chosen_pings(a, b, options.pings);
    comparison.unmatched = options.pings.empty() ? unmatched(a, b) : "";
    comparison.differing = differing(a, b);
    comparison.hint = hint(a, b, comparison.pings);
    comparison.levels = levels_of(options, a, b, comparison.pings);
    a.set_levels(comparison.levels);
    b.set_levels(comparison.levels);
    comparison.is_scan = a.is_scan() || b.is_scan();
    if (comparison.is_scan) {
      tally.add(a.scan(comparison.pings), b.scan(comparison.pings));
    } else {
      for (const std::uint64_t ping : comparison.pings) {
        tally.add(a.picture(ping), b.picture(ping));
      }
    }
  }
  tally.finish();
  return comparison;
}

}  // namespace

void add_compare(const Command& program) {
  const Command command = program.add("compare", "Compare two recordings, instruments' files or grey pictures");
  auto& options = command.keep<CompareOptions>();
  command.argument("A", &options.a,
                   fmt::format("Recording ({}), folder of recordings, file of an instrument or arrays ({}), or grey "
                               "picture ({})",
                               readable_recordings(), foreign_recordings(), kPictureEndings));
  command.argument("B", &options.b, "The same, of the same shape, compared with A");
  command.option("--sonar", "NAME", &options.sonar,
                 "Which recording of a folder, or which sonar of a recording that has several");
  command.option("--ping", "N", &options.pings, "Ping to compare, from 0; may be repeated [all that both have]",
                 whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command.option("--full-scale", "X", &options.full_scale,
                 "Intensity that counts as 1 [the loudest of both where the calibrated model made them, else 1]",
                 number_within({.least = 0, .most = 1e30, .least_allowed = false}));
  command.option("--scale", "NAME", &options.scale,
                 "How intensities count: linear or db [db where the calibrated model made them]",
                 one_of({"linear", "db"}));
  command.option("--floor-db", "DB", &options.floor_db, "Level that counts as 0 on a decibel scale [-50]",
                 number_within({.least = -300, .most = 0, .most_allowed = false}));
  command.flag("--counts", &options.counts,
               "Compare the counts of recordings, as the instrument delivers them: linear, up to the greatest");
  command.flag("--no-ms-ssim", &options.no_ms_ssim, "Skip MS-SSIM (below 176 x 176 it has fewer than five scales)");
  command.flag("--json", &options.json, "As JSON, with the numbers of each ping");
  command.footer(
      "Prints MSE, PSNR, SSIM, MS-SSIM, correlation and the distance of the histograms, as means over the pings; "
      "below\n"
      "them what worthless pictures score against A: a flat grey, A's mean range profile, A's pixels shuffled.\n\n"
      "Examples:\n"
      "  insonify compare real.h5 simulated.h5 --ping 0 --ping 5\n"
      "  insonify compare out_a out_b --sonar fls --json\n"
      "  insonify compare dive.raw out/fls.h5 --counts --ping 0\n"
      "  insonify compare real.png simulated.png");
  command.act([&options] {
    return checked_input([&] {
      const Comparison comparison = compared(options);
      options.json ? print_comparison_json(comparison) : print_comparison(comparison);
      return kDone;
    });
  });
}

}  // namespace insonify
