// target_strength.cpp -- closed forms of the backscattering cross section of bodies of simple shape.

#include "insonify/acoustics/target_strength.h"

#include <cmath>
#include <numbers>
#include <string_view>

#include "acoustics/diffraction.h"
#include "acoustics/formula.h"
#include "base/square.h"

namespace insonify {
namespace {

void check_length(std::string_view function, std::string_view name, double value) {
  check_argument(function, name, "m", greater_than(0), value);
}

// As check_length(), but the value may be infinite.
void check_distance(std::string_view function, std::string_view name, double value) {
  if (value != kFarField) {
    check_length(function, name, value);
  }
}

// a r/(a + r), also if one of the two is infinite.
double joint_radius(double radius, double range) {
  return 1 / (1 / radius + 1 / range);
}

// Diffraction factor of a strip of finite length relative to an infinite one: 2 |C + i S|^2 at length/sqrt(lambda r).
double edge_gain(double length, double wavelength, double range) {
  return 2 * std::norm(fresnel_integral(length / std::sqrt(wavelength * range)));
}

}  // namespace

double target_strength_db(double cross_section) {
  check_argument("target_strength_db", "cross_section", "m^2", at_least(0), cross_section);
  return 10 * std::log10(cross_section);
}

double convex_cross_section(double radius1, double radius2, double range) {
  check_distance("convex_cross_section", "radius1", radius1);
  check_distance("convex_cross_section", "radius2", radius2);
  check_distance("convex_cross_section", "range", range);
  return joint_radius(radius1, range) * joint_radius(radius2, range) / 4;
}

double sphere_cross_section(double radius, double range) {
  check_length("sphere_cross_section", "radius", radius);
  check_distance("sphere_cross_section", "range", range);
  return square(joint_radius(radius, range)) / 4;
}

double cylinder_cross_section(double radius, double length, double wavelength, double range) {
  check_length("cylinder_cross_section", "radius", radius);
  check_length("cylinder_cross_section", "length", length);
  check_length("cylinder_cross_section", "wavelength", wavelength);
  check_distance("cylinder_cross_section", "range", range);
  if (range == kFarField) {
    return radius * square(length) / (2 * wavelength);
  }
  return joint_radius(radius, range) * range * edge_gain(length, wavelength, range) / 4;
}

double plate_cross_section(double width, double height, double wavelength, double range) {
  check_length("plate_cross_section", "width", width);
  check_length("plate_cross_section", "height", height);
  check_length("plate_cross_section", "wavelength", wavelength);
  check_distance("plate_cross_section", "range", range);
  if (range == kFarField) {
    return square(width * height / wavelength);
  }
  return square(range) / 4 * edge_gain(width, wavelength, range) * edge_gain(height, wavelength, range);
}

double lambert_sphere_cross_section(double mu, double radius) {
  check_argument("lambert_sphere_cross_section", "mu", "", at_least(0), mu);
  check_length("lambert_sphere_cross_section", "radius", radius);
  return 2 * std::numbers::pi * mu * square(radius) / 3;
}

double dihedral_cross_section(double width, double height, double wavelength) {
  check_length("dihedral_cross_section", "width", width);
  check_length("dihedral_cross_section", "height", height);
  check_length("dihedral_cross_section", "wavelength", wavelength);
  return 2 * square(width * height / wavelength);
}

double triangular_trihedral_cross_section(double edge, double wavelength) {
  check_length("triangular_trihedral_cross_section", "edge", edge);
  check_length("triangular_trihedral_cross_section", "wavelength", wavelength);
  return square(square(edge) / wavelength) / 3;
}

double square_trihedral_cross_section(double edge, double wavelength) {
  check_length("square_trihedral_cross_section", "edge", edge);
  check_length("square_trihedral_cross_section", "wavelength", wavelength);
  return 3 * square(square(edge) / wavelength);
}

}  // namespace insonify
