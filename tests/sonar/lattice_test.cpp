// lattice_test.cpp -- solid angles, rows and directions of the sampling lattice.

#include "sonar/lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "receiver/array/line_array.h"

namespace insonify::lattice_test {
namespace {

constexpr double kDegree = radians_from_degrees(1);

SonarConfig fan(double azimuth_deg = 120) {
  SonarConfig sonar;
  sonar.beam_count = 60;
  sonar.azimuth_aperture = azimuth_deg * kDegree;
  sonar.elevation_aperture = 20 * kDegree;
  sonar.elevation_center = -8 * kDegree;
  sonar.sampling = {3, 50};
  return sonar;
}

ElevationPattern pattern_of(const SonarConfig& sonar) {
  return {line_array(BeamPattern::kRectangular, -30, sonar.elevation_aperture), sonar.elevation_aperture,
          sonar.elevation_center};
}

// With the pattern of pattern_of(), or a top hat.
Lattice lattice_of(const SonarConfig& sonar, BeamShape shape = BeamShape::kWedge, bool has_pattern = false) {
  BearingGrid beams = sonar.bearings();
  beams.shape = shape;
  ElevationWay way{.aperture = sonar.elevation_aperture};
  if (has_pattern) {
    way.array = line_array(BeamPattern::kRectangular, -30, sonar.elevation_aperture);
  }
  return {beams, *sonar.sampling.columns_per_beam, sonar, ElevationPatterns(way, {}, sonar.elevation_center)};
}

// Solid angle of a fan weighted by |p|^(2 power), by brute force over elevation: `power` is 1 for transmission, 2 for
// transmission and reception.
double angle_by_sum(const SonarConfig& sonar, BeamShape shape, const ElevationPattern* pattern, int power) {
  const double low = pattern != nullptr ? pattern->low() : sonar.elevation_center - sonar.elevation_aperture / 2;
  const double high = pattern != nullptr ? pattern->high() : sonar.elevation_center + sonar.elevation_aperture / 2;
  constexpr int kSteps = 4000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double elevation = low + (i + 0.5) / kSteps * (high - low);
    // Half the width of the fan in azimuth; for cones, of the azimuths with |sin(azimuth) cos(elevation)| < sin(half).
    const double half = 0.5 * sonar.azimuth_aperture;
    const double reach =
        shape == BeamShape::kWedge ? half : std::asin(std::min(1.0, std::sin(half) / std::cos(elevation)));
    const double received = pattern != nullptr ? std::pow(pattern->intensity(elevation), power) : 1;
    sum += 2 * reach * std::cos(elevation) * received * (high - low) / kSteps;
  }
  return sum;
}

double total_received(const Lattice& lattice) {
  double sum = 0;
  for (int beam = 0; beam * lattice.columns_per_beam < lattice.columns; ++beam) {
    sum += lattice.beam_angle(beam);
  }
  return sum;
}

double total_sent(const Lattice& lattice) {
  double sum = 0;
  for (int column = 0; column < lattice.columns; ++column) {
    for (int row = 0; row < lattice.rows; ++row) {
      sum += double{lattice.shares(column)[row]} * lattice.column_measure[column];
    }
  }
  return sum;
}

TEST(LatticeTest, SolidAnglesFillTheSector) {
  for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
    for (const double azimuth : {40.0, 120.0, 180.0}) {
      for (const bool has_pattern : {false, true}) {
        SonarConfig sonar = fan(azimuth);
        std::optional<ElevationPattern> pattern;
        if (has_pattern) {
          pattern = pattern_of(sonar);
        }
        const ElevationPattern* given = pattern ? &*pattern : nullptr;
        for (const int rows : {2, 50}) {
          sonar.sampling.rows = rows;
          const Lattice lattice = lattice_of(sonar, shape, has_pattern);
          // With cones the edges of columns approximate the edge of the sector in steps.
          const double tolerance = shape == BeamShape::kWedge ? 1e-5 : 1e-3;
          const double received = angle_by_sum(sonar, shape, given, 2), sent = angle_by_sum(sonar, shape, given, 1);
          EXPECT_NEAR(total_received(lattice) / received, 1, tolerance) << azimuth << has_pattern << rows;
          EXPECT_NEAR(total_sent(lattice) / sent, 1, tolerance) << azimuth << has_pattern << rows;
        }
      }
    }
  }
}

TEST(LatticeTest, HalfTheRowsLieInTheMainLobeAndTheRestInSideLobes) {
  const SonarConfig sonar = fan();
  const ElevationPattern pattern = pattern_of(sonar);
  const Lattice lattice = lattice_of(sonar, BeamShape::kWedge, true);
  int in_aperture = 0, in_main_lobe = 0;
  for (int row = 0; row < lattice.rows; ++row) {
    const double off = std::abs(lattice.elevations(0)[row] + 8 * kDegree) / kDegree;
    in_aperture += off < 10 ? 1 : 0;
    in_main_lobe += off < 23 ? 1 : 0;  // sin(23 deg) = lambda / L
  }
  EXPECT_GT(in_aperture, 0.3 * lattice.rows);
  EXPECT_GT(in_main_lobe, 0.55 * lattice.rows);
  EXPECT_LT(in_main_lobe, 0.85 * lattice.rows);
  for (int row = 1; row < lattice.rows; ++row) {
    EXPECT_GT(lattice.elevations(0)[row], lattice.elevations(0)[row - 1]);
    EXPECT_LT(lattice.elevations(0)[row] - lattice.elevations(0)[row - 1], 12 * kDegree);
  }
}

TEST(LatticeTest, RowsHoldThePatternAtTheirElevations) {
  const SonarConfig sonar = fan();
  const ElevationPattern pattern = pattern_of(sonar);
  for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
    const Lattice lattice = lattice_of(sonar, shape, true);
    for (const int column : {0, 70, 179}) {
      for (int row = 0; row < lattice.rows; ++row) {
        EXPECT_NEAR(lattice.pattern_in(column)[row], pattern.intensity(lattice.elevations(column)[row]), 1e-5);
      }
    }
  }
  EXPECT_EQ(lattice_of(sonar).pattern_in(0)[7], 1);
}

// With cones, every row of a column has the same bearing, and an elevation within the sector.
TEST(LatticeTest, ConesHaveAConstantSineOfBearing) {
  const SonarConfig sonar = fan();
  const Lattice lattice = lattice_of(sonar, BeamShape::kCone);
  EXPECT_FALSE(lattice.even_rows);
  for (int column = 0; column < lattice.columns; ++column) {
    const double cosine = lattice.cos_azimuth[column], sine = lattice.sin_azimuth[column];
    for (int row = 0; row < lattice.rows; ++row) {
      const double elevation = lattice.elevations(column)[row];
      const Vec3 direction(cosine * lattice.cosines(column)[row], sine, cosine * lattice.sines(column)[row]);
      EXPECT_NEAR(direction.norm(), 1, 1e-6);
      EXPECT_NEAR(direction.z(), std::sin(elevation), 1e-6);
      const double azimuth = std::atan2(direction.y(), direction.x());
      EXPECT_NEAR(bearing_sine(BeamShape::kCone, azimuth, elevation), std::sin(lattice.azimuth[column]), 1e-6);
      EXPECT_GE(elevation, -18 * kDegree);
      EXPECT_LE(elevation, 2 * kDegree);
    }
  }
}

// Cones far to the side are so narrow that they do not reach the sector, 30 to 50 degrees up.
TEST(LatticeTest, ConesThatMissTheSectorHaveNoSolidAngle) {
  SonarConfig sonar = fan(170);
  sonar.elevation_center = 40 * kDegree;
  const Lattice lattice = lattice_of(sonar, BeamShape::kCone);
  EXPECT_EQ(lattice.beam_angle(0), 0);
  EXPECT_GT(lattice.beam_angle(30), 0);
  for (int row = 0; row < lattice.rows; ++row) {
    EXPECT_TRUE(std::isfinite(lattice.elevations(0)[row]));
  }
}

TEST(LatticeTest, MirroredColumnsHaveTheSameRows) {
  const SonarConfig sonar = fan();
  const ElevationPattern pattern = pattern_of(sonar);
  for (const BeamShape shape : {BeamShape::kWedge, BeamShape::kCone}) {
    const Lattice lattice = lattice_of(sonar, shape, true);
    for (int column = 0; column < lattice.columns; ++column) {
      for (int row = 0; row < lattice.rows; ++row) {
        EXPECT_NEAR(lattice.elevations(column)[row], lattice.elevations(lattice.columns - 1 - column)[row], 1e-6);
      }
    }
  }
  const Lattice lattice = lattice_of(sonar, BeamShape::kWedge, true);
  EXPECT_GT(std::abs(lattice.elevations(0)[20] - lattice.elevations(1)[20]), 0.01 * kDegree);
}

}  // namespace
}  // namespace insonify::lattice_test
