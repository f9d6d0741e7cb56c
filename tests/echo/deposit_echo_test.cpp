// deposit_echo_test.cpp -- deposit of single echoes: shares of bins, also at the ends of the range window, and labels.

#include <gtest/gtest.h>

#include <algorithm>

#include "echo/model/deposit.h"

namespace insonify::deposit_echo_test {
namespace {

constexpr float kEnergyError = 1e-6F;
constexpr float kShareError =
    1e-4F;  // FootprintSegments are a ten-thousandth of a bin longer: see least_half_length().

// A plan of two beams.
std::shared_ptr<const FlatPlan> plan_of(int bins) {
  FlatPlanSettings settings;
  settings.sonar.beam_count = 2;
  settings.sonar.bin_count = bins;
  settings.sonar.max_range = 4 + bins;
  settings.sonar.sampling.columns_per_beam = 1;
  settings.sonar.sampling.rows = 2;
  return make_flat_plan(settings);
}

// Share of the interval low..high [bins] that lies in a bin.
float share(float low, float high, int bin) {
  const auto edge = static_cast<float>(bin);
  return std::max(std::min(high, edge + 1) - std::max(low, edge), 0.0F) / (high - low);
}

// Cells are updated four at a time. Near the last bin, and with fewer than four bins, cells beyond must not be written.
TEST(DepositEchoTest, EveryBinGetsItsShareOfAnEcho) {
  for (const int bins : {1, 2, 3, 4, 5, 7, 8, 9}) {
    const auto plan = plan_of(bins);
    for (float middle = -0.75F; middle < static_cast<float>(bins) + 1; middle += 0.5F) {
      for (const float half : {0.3F, 0.9F, 2.4F, 5.1F}) {
        EchoGrid grid(2, bins, kPathOrders);
        Echo echo;
        echo.azimuth = 0.5F * (plan->lattice.azimuth[0]);
        echo.path_length = 2 * (plan->first_bin_at + middle / plan->bins_per_metre);
        echo.half_length = half / plan->bins_per_metre;
        echo.order = 2;
        echo.surface = surface_label(7, 3);
        echo.weight = 2;
        echo.power = 0.5F;
        echo.elevation = 0.1F;
        deposit(*plan, echo, grid);
        const int beam = plan->beam_of(echo.azimuth);
        for (int bin = 0; bin < bins; ++bin) {
          const float expected = share(middle - half, middle + half, bin);
          EXPECT_NEAR(grid.weight(2, beam)[bin], 2 * expected, 2 * kShareError) << bins << ' ' << middle << ' ' << half;
          EXPECT_NEAR(grid.energy(2, beam)[bin], expected, kShareError);
          EXPECT_EQ(grid.weight(2, 1 - beam)[bin], 0);
          EXPECT_EQ(grid.weight(1, beam)[bin], 0);
          if (expected > kShareError) {
            EXPECT_EQ(grid.label(beam, bin).instance, 7);
          }
          EXPECT_EQ(grid.label(1 - beam, bin).instance, kNoLabel);
        }
      }
    }
  }
}

// The label of a cell is the surface with most energy, in every SIMD lane of the vote.
TEST(DepositEchoTest, TheStrongestSurfaceLabelsEachCell) {
  constexpr int kBins = 11;
  const auto plan = plan_of(kBins);
  EchoGrid grid(2, kBins, kPathOrders);
  const auto add = [&](int instance, float first, float last, float power) {
    Echo echo;
    echo.azimuth = 0.5F * plan->lattice.azimuth[0];
    echo.path_length = 2 * plan->first_bin_at + (first + last) / plan->bins_per_metre;
    echo.half_length = 0.5F * (last - first) / plan->bins_per_metre;
    echo.order = 2;
    echo.surface = surface_label(static_cast<std::uint16_t>(instance), 0);
    echo.weight = last - first;
    echo.power = power;
    echo.elevation = 0.01F * static_cast<float>(instance);
    deposit(*plan, echo, grid);
  };
  add(1, 1, 9, 1);
  add(2, 4, 7, 3);
  add(3, 6, 11, 0.5F);
  const int beam = plan->beam_of(0.5F * plan->lattice.azimuth[0]);
  for (int bin = 1; bin < kBins; ++bin) {
    const int expected = bin >= 4 && bin < 7 ? 2 : bin < 9 ? 1 : 3;
    EXPECT_EQ(grid.label(beam, bin).instance, expected) << bin;
    EXPECT_NEAR(grid.label(beam, bin).elevation, 0.01F * static_cast<float>(expected), kEnergyError) << bin;
  }
}

}  // namespace
}  // namespace insonify::deposit_echo_test
