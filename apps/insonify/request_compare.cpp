// request_compare.cpp -- options of `insonify compare`.

#include <limits>

#include "console/validators.h"
#include "request.h"

namespace insonify {

void add_compare(CLI::App& app, Request& request) {
  CLI::App* command = app.add_subcommand("compare", "Compare two recordings or two grey pictures");
  CompareOptions& options = request.compare;
  command->add_option("A", options.a, "Recording (.h5, .mcap), folder of recordings, or grey picture (.png)")
      ->required();
  command->add_option("B", options.b, "The same, of the same shape, compared with A")->required();
  command->add_option("--sonar", options.sonar, "Which recording of a folder, or which sonar of an .mcap file")
      ->type_name("NAME");
  command->add_option("--ping", options.pings, "Ping to compare, from 0; may be repeated [all that both have]")
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->type_name("N")
      ->expected(1)
      ->take_all();
  command
      ->add_option("--full-scale", options.full_scale,
                   "Intensity that counts as 1 [the loudest of both where the calibrated model made them, else 1]")
      ->check(number_within({.least = 0, .most = 1e30, .least_allowed = false}))
      ->type_name("X");
  command
      ->add_option("--scale", options.scale,
                   "How intensities count: linear or db [db where the calibrated model made them]")
      ->check(one_of({"linear", "db"}))
      ->type_name("NAME");
  command->add_option("--floor-db", options.floor_db, "Level that counts as 0 on a decibel scale [-50]")
      ->check(number_within({.least = -300, .most = 0, .most_allowed = false}))
      ->type_name("DB");
  command->add_flag("--counts", options.counts,
                    "Compare the counts of recordings, as the instrument delivers them: linear, up to the greatest");
  command->add_flag("--no-ms-ssim", request.no_ms_ssim, "Skip MS-SSIM (always skipped below 176 x 176)");
  command->add_flag("--json", options.json, "As JSON, with the numbers of each ping");
  command->footer(
      "Prints MSE, PSNR, SSIM, MS-SSIM, correlation and the distance of the histograms, as means over the pings; "
      "below\n"
      "them what worthless pictures score against A: a flat grey, A's mean range profile, A's pixels shuffled.\n\n"
      "Examples:\n"
      "  insonify compare real.h5 simulated.h5 --ping 0 --ping 5\n"
      "  insonify compare out_a out_b --sonar fls --json\n"
      "  insonify compare real.png simulated.png");
  command->callback([&request, &options] {
    options.ms_ssim = !request.no_ms_ssim;
    request.act = [&options] { return compare(options); };
  });
}

}  // namespace insonify
