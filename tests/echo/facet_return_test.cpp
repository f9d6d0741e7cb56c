// facet_return_test.cpp -- directions in which sound returns over a rough mirror, against sums over its facets.

#include <gtest/gtest.h>

#include "echo/laws/laws.h"

namespace insonify::facet_return_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Triple triple(const Vec3& v) {
  return triple_of(v.cast<float>());
}

// A mirror in the plane z = 0, at the origin of which a smooth one reflects sound from the sonar to a second surface.
struct Setting {
  double angle, out, across, slope;  // Angle of incidence [rad]; distances to sonar and second surface [m]; rms slope.
  Vec3 sonar = out * Vec3(-std::sin(angle), 0, std::cos(angle));
  Vec3 second = across * Vec3(std::sin(angle), 0, std::cos(angle));
  double rho = out * across / (out + across);

  // A side of a face about the origin; `lengths` in rms lengths of the glint.
  [[nodiscard]] FaceSide side(bool in_plane, double lengths) const {
    FaceSide side = face_side(0, 0, 0, static_cast<float>(in_plane ? std::sin(angle) : 0),
                              static_cast<float>(std::cos(angle)), static_cast<float>(slope));
    side.high = static_cast<float>(0.5 * lengths * rho) * side.spread;
    side.low = -side.high;
    return side;
  }
};

// Geometric mean of the variances, in and across the plane of incidence, of the direction in which the second surface
// sees the facets that return sound [rad^2]. Facets are weighted by the Gaussian density of the slopes that they need.
double seen_variance(const Setting& at, const FaceSide& along, const FaceSide& aside) {
  constexpr int kSteps = 400;
  const Vec3 towards = -at.second.normalized(), across = Vec3::UnitY().cross(towards);
  double sum = 0, in_plane = 0, out_of_plane = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Vec3 place(along.low + (i + 0.5) / kSteps * (along.high - along.low),
                       aside.low + (j + 0.5) / kSteps * (aside.high - aside.low), 0);
      const Vec3 normal = (at.sonar - place).normalized() + (at.second - place).normalized();
      const double slopes = (normal.x() * normal.x() + normal.y() * normal.y()) / (normal.z() * normal.z());
      const double weight = std::exp(-slopes / (2 * at.slope * at.slope));
      const Vec3 seen = (place - at.second).normalized();
      sum += weight;
      in_plane += weight * std::pow(seen.dot(across), 2);
      out_of_plane += weight * seen.y() * seen.y();
    }
  }
  return std::sqrt(in_plane * out_of_plane) / sum;
}

// The half vector is spread by half the angle of the way back. Mirrors large and small, straight on and at an angle.
TEST(FacetReturnTest, WayBackIsSpreadAsItsFacetsAre) {
  for (const double angle : {0.0, 40.0, 65.0}) {
    for (const auto& [out, across] : {std::pair{8.0, 3.0}, std::pair{2.0, 9.0}}) {
      const Setting at{.angle = angle * kDegree, .out = out, .across = across, .slope = 0.01};
      for (const double lengths : {1.0, 3.0, 6.0, 14.0}) {
        const FaceSide along = at.side(true, lengths), aside = at.side(false, lengths);
        const float held = held_on_face(along, aside, static_cast<float>(at.rho));
        const Triple on = triple(at.second.normalized());
        const FacetReturn back = facet_return({static_cast<float>(at.slope), 0, static_cast<float>(std::cos(at.angle)),
                                               static_cast<float>(out), static_cast<float>(across), held},
                                              on, on, on);
        EXPECT_NEAR(back.variance / (seen_variance(at, along, aside) / 4), 1, 0.06)
            << angle << ' ' << out << ' ' << lengths;
        EXPECT_FLOAT_EQ(back.glint, 1);
      }
    }
  }
}

// Where a facet turned the ray out, the way back is to the sonar's image all the same, or on a tiny face as the way
// out.
TEST(FacetReturnTest, WayBackIsThatToTheSonarsImage) {
  const Setting at{.angle = 30 * kDegree, .out = 5, .across = 4, .slope = 0.05};
  const Vec3 image = at.sonar.cwiseProduct(Vec3(1, 1, -1));
  for (const Vec3& met : {Vec3(0.3, -0.2, 0), Vec3(-0.5, 0.6, 0), Vec3(0, 0, 0)}) {
    const Vec3 out = met - at.sonar, on = at.second - met, normal = Vec3(0.3, -0.5, -1).normalized();
    const Vec3 smooth = out.cwiseProduct(Vec3(1, 1, -1)).normalized();
    for (const float held : {1.0F, 0.0F}) {
      const RoughMirror mirror{0.05F, 0.4F, 0.8F, static_cast<float>(out.norm()), static_cast<float>(on.norm()), held};
      const FacetReturn back = facet_return(mirror, triple(on.normalized()), triple(smooth), triple(normal));
      const Vec3 home = held > 0 ? Vec3((image - at.second).normalized()) : Vec3(-on.normalized());
      const Vec3 half = (home - on.normalized()).normalized();
      EXPECT_NEAR(back.glint, std::abs(half.dot(normal)), 1e-6) << met.transpose() << ' ' << held;
    }
  }
}

// With s = 0.05, cos = 0.8, 5 m of 9: (0.05 x 5/9)^2 x 0.8 = 6.1728e-4, for the share 0.6 alone.
TEST(FacetReturnTest, VarianceIsThatOfTheFacetsShare) {
  const FacetReturn back = facet_return({0.05F, 0.4F, -0.8F, 5, 4, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, -1});
  EXPECT_NEAR(back.variance, 6.1728e-4 / 0.6, 1e-7);
  EXPECT_EQ(back.coherence, 0.4F);
}

}  // namespace
}  // namespace insonify::facet_return_test
