// bearing_cells_test.cpp -- number and directions of the bearing cells, and the energy that they leave out.

#include "receiver/array/bearing_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace insonify::bearing_cells_test {
namespace {

constexpr double kDegree = radians_from_degrees(1);
constexpr double kPi = std::numbers::pi;

// 64 beams over 60 degrees.
SonarConfig fan(double resolution_deg) {
  SonarConfig sonar;
  sonar.beam_count = 64;
  sonar.azimuth_aperture = 60 * kDegree;
  sonar.azimuth_resolution = resolution_deg * kDegree;
  return sonar;
}

ReceiverConfig with(BeamPattern pattern) {
  ReceiverConfig receiver;
  receiver.azimuth_pattern = pattern;
  return receiver;
}

// Share of the energy of a uniform line's beam, steered to u0, between the sines `low` and `high`; by quadrature. The
// integral of sinc^2 over all x is 1.
double share_between(double low, double high, double u0, double length) {
  double sum = 0;
  constexpr double kStep = 1.0 / 500;
  for (double x = length * (low - u0) + 0.5 * kStep; x < length * (high - u0); x += kStep) {
    const double sinc = std::abs(x) < 1e-9 ? 1 : std::sin(kPi * x) / (kPi * x);
    sum += kStep * sinc * sinc;
  }
  return sum;
}

TEST(BearingCellsTest, TopHatBeamsAreCells) {
  const BearingCells cells(fan(2), with(BeamPattern::kTopHat));
  EXPECT_EQ(cells.grid.count(), 64);
  EXPECT_EQ(cells.firsts[0], 0);
  EXPECT_EQ(cells.per_beam, 1);
}

// 2 % of sinc^2 lie beyond x = 2.526 on one side. A beam of 2.5 degrees has D / wavelength = 0.88589 / (2 sin 1.25 deg)
// = 20.305, so that beam 0 at 29.531 degrees needs cells up to asin(0.49290 + 2.526 / 20.305) = 38.12 degrees: 17.3
// cells of 0.46875 degrees beyond the edge at 30. For a Hann window it is x = 1.162 and 1.44059 / (2 sin 1.5 deg) =
// 27.517: 32.37 degrees, 5.1 cells. A beam of 3.2 degrees has 25.798: 32.54 degrees, 2.7 cells of 0.9375.
TEST(BearingCellsTest, GuardCellsReachWhereTheOutermostBeamHears) {
  const BearingCells uniform(fan(2.5), with(BeamPattern::kRectangular));
  EXPECT_EQ(uniform.firsts[0], 18);
  EXPECT_EQ(uniform.grid.count(), 2 * (64 + 18));
  EXPECT_NEAR(uniform.grid.extent() / kDegree, 60 + 36 * 0.46875, 1e-9);
  for (int half = 0; half < 128; ++half) {  // Those within the fan are halves of its beams, as ever.
    EXPECT_NEAR(uniform.grid.centres[18 + half], 60 * kDegree * (0.5 - (half + 0.5) / 128), 1e-12);
  }
  const BearingCells hann(fan(3), with(BeamPattern::kHann));
  EXPECT_EQ(hann.firsts[0], 6);
  EXPECT_EQ(hann.grid.count(), 2 * (64 + 6));
  const BearingCells dense(fan(3.2), with(BeamPattern::kHann));
  EXPECT_EQ(dense.firsts[0], 3);
  EXPECT_EQ(dense.grid.count(), 64 + 6);
}

// Beams 0.9375 degrees apart: a cell of 0.3 beam widths at most needs a width of 3.125 degrees. The edges of the middle
// beams' slices are 2 sin(0.46875 deg) apart, sin(3.125 deg) = 0.0545158 allows 0.0163547.
TEST(BearingCellsTest, FansThatOverlapMuchHaveOneCellABeam) {
  EXPECT_EQ(BearingCells(fan(3.12), with(BeamPattern::kTaylor)).per_beam, 2);
  const BearingCells cells(fan(3.13), with(BeamPattern::kTaylor));
  EXPECT_EQ(cells.per_beam, 1);
  EXPECT_EQ(cells.columns, Sampling::kColumns);  // As many rays as with two cells.
  EXPECT_NEAR(cells.grid.centres[cells.firsts[0] + 5], fan(3.13).beam_azimuth(5), 1e-12);
  SonarConfig head = fan(30);
  head.type = SonarType::kMechanicallyScanned;
  head.beam_count = 1;
  head.azimuth_aperture = 2 * kDegree;
  EXPECT_EQ(BearingCells(head, with(BeamPattern::kTaylor)).per_beam, 8);
}

TEST(BearingCellsTest, OutermostBeamsLoseLessThanTwoPercent) {
  for (const double resolution : {0.7, 1.9, 4.1}) {
    const SonarConfig sonar = fan(resolution);
    const BearingCells cells(sonar, with(BeamPattern::kRectangular));
    const double length = 0.8858929413781328 / (2 * std::sin(0.5 * resolution * kDegree));
    const double u0 = std::sin(sonar.beam_azimuth(0)), end = 0.5 * cells.grid.extent();
    const double cell = cells.grid.extent() / cells.grid.count();
    // Half of the energy lies to port of the beam.
    EXPECT_GT(share_between(u0, std::sin(end), u0, length), 0.48) << resolution;
    EXPECT_LT(share_between(u0, std::sin(end - cell), u0, length), 0.48) << resolution;
  }
}

TEST(BearingCellsTest, GuardCellsEndNinetyDegreesOff) {
  SonarConfig sonar = fan(8);
  sonar.azimuth_aperture = 160 * kDegree;  // Cells of 1.25 degrees: 7 of them up to 88.75 degrees.
  const BearingCells cells(sonar, with(BeamPattern::kRectangular));
  EXPECT_EQ(cells.firsts[0], 7);
  EXPECT_NEAR(cells.grid.extent() / kDegree, 177.5, 1e-9);
  sonar.azimuth_aperture = 180 * kDegree;
  EXPECT_EQ(BearingCells(sonar, with(BeamPattern::kRectangular)).firsts[0], 0);
}

// Slices of 8, 9, 6.5 and 3 degrees, from 34 to 7.5, in three cells each, so that none is wider than half a beam in u:
// the outermost cells are 8/3 and 1 degree wide. D / wavelength is 8.459 for 6 degrees: asin(sin 30 + 0.29865) = 53.0
// degrees, and asin(0.29865 - sin 9) = 8.2 degrees to starboard.
TEST(BearingCellsTest, ExplicitBeamsHaveGuardCellsAsWideAsTheOutermost) {
  SonarConfig sonar = fan(6);
  sonar.beam_azimuths = {30 * kDegree, 22 * kDegree, 12 * kDegree, 9 * kDegree};
  sonar.beam_count = 4;
  const std::vector<double> edges = sonar.bearings().edges();
  ASSERT_NEAR(edges.front() / kDegree, 34, 1e-9);
  ASSERT_NEAR(edges.back() / kDegree, 7.5, 1e-9);
  const BearingCells cells(sonar, with(BeamPattern::kRectangular));
  EXPECT_EQ(cells.per_beam, 3);
  EXPECT_EQ(cells.firsts[0], 8);               // (53.0 - 34) / (8 / 3) = 7.1
  EXPECT_EQ(cells.grid.count(), 8 + 12 + 16);  // (8.2 + 7.5) / 1 = 15.7
  EXPECT_NEAR(cells.grid.centres[7] / kDegree, 34 + 4.0 / 3, 1e-9);
  EXPECT_NEAR(cells.grid.centres[8] / kDegree, 34 - 4.0 / 3, 1e-9);
  EXPECT_NEAR(cells.grid.centres[19] / kDegree, 8, 1e-9);
  EXPECT_NEAR(cells.grid.centres[20] / kDegree, 7, 1e-9);
  EXPECT_NEAR(cells.grid.centres[35] / kDegree, -8, 1e-9);
  // The fan's own edges stay.
  EXPECT_NEAR(cells.grid.edges()[8] / kDegree, 34, 1e-9);
  EXPECT_NEAR(cells.grid.edges()[20] / kDegree, 7.5, 1e-9);
}

// Dead elements raise side lobes everywhere; the cells stay those of the array without faults.
TEST(BearingCellsTest, FaultsDoNotChangeTheCells) {
  ReceiverConfig receiver = with(BeamPattern::kTaylor);
  receiver.elements = 64;
  const BearingCells perfect(fan(2), receiver);
  receiver.dead_elements = {3, 17, 40};
  receiver.element_error = 0.5;
  EXPECT_EQ(BearingCells(fan(2), receiver).grid.count(), perfect.grid.count());
  EXPECT_GT(perfect.firsts[0], 0);
}

SonarConfig head(double width_deg) {
  SonarConfig sonar = fan(width_deg);
  sonar.type = SonarType::kMechanicallyScanned;
  sonar.beam_count = 1;
  sonar.azimuth_aperture = width_deg * kDegree;
  return sonar;
}

TEST(BearingCellsTest, HeadsWithLowSideLobesHaveTwoNeighboursOnEitherSide) {
  const BearingCells cells(head(3), with(BeamPattern::kHann));
  EXPECT_EQ(cells.grid.count(), 8 * 5);
  EXPECT_EQ(cells.firsts[0], 8 * 2);
  EXPECT_EQ(cells.per_beam, 8);
  EXPECT_NEAR(cells.grid.extent() / kDegree, 15, 1e-9);
  EXPECT_TRUE(cells.edge_sines.empty());
}

// sinc^4 is above -60 dB up to x = 9.5975: with D / wavelength = 0.88589 / (2 sin 1.5 deg) = 16.9212 up to 34.55
// degrees. Narrow cells end at 4.5 x 3 = 13.5 degrees; the wide ones at 13.6875 + 1.5 + n x 3, n = 7 being the least.
TEST(BearingCellsTest, HeadsHearTheirSideLobesDownToSixtyDecibels) {
  const BearingCells cells(head(3), with(BeamPattern::kRectangular));
  EXPECT_EQ(cells.grid.count(), 8 * 9 + 2 * 8);
  EXPECT_EQ(cells.firsts[0], 8 * 4 + 8);
  const std::vector<double> edges = cells.grid.edges();
  EXPECT_NEAR(edges.front() / kDegree, 13.6875 + 1.5 + 7 * 3, 1e-9);
  EXPECT_NEAR(edges[7] / kDegree, 13.6875 + 1.5, 1e-9);
  EXPECT_NEAR(edges[8] / kDegree, 13.5, 1e-9);
  EXPECT_NEAR(edges[9] / kDegree, 13.125, 1e-9);
  EXPECT_NEAR(edges[cells.firsts[0]] / kDegree, 1.5, 1e-9);
  EXPECT_NEAR(edges[cells.firsts[0] + 8] / kDegree, -1.5, 1e-9);
  EXPECT_NEAR(edges.back(), -edges.front(), 1e-12);
  ASSERT_EQ(cells.edge_sines.size(), edges.size());
  EXPECT_NEAR(cells.edge_sines[8], std::sin(13.5 * kDegree), 1e-12);
}

// 30 degrees wide: side lobes reach 90 degrees off, cells must not.
TEST(BearingCellsTest, CellsOfWideHeadsEndNinetyDegreesOff) {
  const BearingCells cells(head(30), with(BeamPattern::kRectangular));
  const std::vector<double> edges = cells.grid.edges();
  EXPECT_LE(edges.front(), BearingCells::kGuardEnd);
  EXPECT_GT(edges.front(), radians_from_degrees(70));
  EXPECT_NEAR(edges[cells.firsts[0]] / kDegree, 15, 1e-9);
}

TEST(BearingCellsTest, BeamOfAHeadMayPointAside) {
  SonarConfig aside = head(2);
  aside.beam_azimuths = {25 * kDegree};
  const BearingCells cells(aside, with(BeamPattern::kHann));
  ASSERT_EQ(cells.grid.centres.size(), 40U);
  EXPECT_NEAR(cells.grid.edges()[cells.firsts[0]] / kDegree, 26, 1e-9);
  EXPECT_NEAR(cells.grid.edges()[cells.firsts[0] + 8] / kDegree, 24, 1e-9);
}

}  // namespace
}  // namespace insonify::bearing_cells_test
