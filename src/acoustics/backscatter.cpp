// backscatter.cpp -- the two scattering laws of a rough surface: Lambert's (diffuse) and Kirchhoff's facets (specular).

#include "insonify/acoustics/backscatter.h"

#include <cmath>
#include <numbers>

#include "acoustics/formula.h"
#include "base/square.h"

namespace insonify {
namespace {

// Cosine of incidence, and exactly 0 from 90 degrees on: the cosine of the double nearest to pi/2 is not 0.
double visible_cosine(double incidence) {
  return incidence < std::numbers::pi / 2 ? std::cos(incidence) : 0;
}

}  // namespace

double lambert_scatter(double mu, double incidence_in, double incidence_out) {
  check_argument("lambert_scatter", "mu", "", at_least(0), mu);
  return mu * visible_cosine(incidence_in) * visible_cosine(incidence_out);
}

double lambert_backscatter(double mu, double incidence) {
  return lambert_scatter(mu, incidence, incidence);
}

double facet_scatter(double reflection, double rms_slope, double half_tilt) {
  check_argument("facet_scatter", "reflection", "", from_to(-1, 1), reflection);
  check_argument("facet_scatter", "rms_slope", "", greater_than(0), rms_slope);
  const double cosine = visible_cosine(half_tilt);
  const double density = std::exp(-square(std::tan(half_tilt) / rms_slope) / 2);  // Density of facets with this tilt.
  if (cosine == 0 || density == 0) {
    return 0;
  }
  return square(reflection / (rms_slope * square(cosine))) / (8 * std::numbers::pi) * density;
}

double facet_backscatter(double reflection, double rms_slope, double incidence) {
  return facet_scatter(reflection, rms_slope, incidence);
}

// Computed by atan2, because acos loses half of its digits at small angles.
double half_vector_tilt(const Vec3& normal, const Vec3& towards_source, const Vec3& towards_receiver) {
  const Vec3 half = towards_source + towards_receiver;
  return std::atan2(normal.cross(half).norm(), normal.dot(half));
}

}  // namespace insonify
