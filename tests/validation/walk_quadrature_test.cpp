// walk_quadrature_test.cpp -- random walks against sums over all paths between the patches of small scenes, with
// absorption, an elevation pattern and mirrors.
//
// The sums are independent of the walks: they have no random numbers, and compute the sound that each patch sends to
// each other patch and to the sonar from the laws of acoustics/backscatter.h.

#include <numbers>

#include "insonify/acoustics/backscatter.h"
#include "validation/walk_scene.h"

namespace insonify::validation::walk_quadrature_test {
namespace {

constexpr double kPi = std::numbers::pi;

struct Patch {
  Vec3 place, normal;
  double area;
  int plate;
};

/// A square plate in a scene, and the patches it is divided into.
struct Plate {
  Vec3 normal, middle;
  double side;
  Material material;
};

std::vector<Patch> patches_of(const std::vector<Plate>& plates, int along) {
  std::vector<Patch> patches;
  for (std::size_t plate = 0; plate < plates.size(); ++plate) {
    const Mesh mesh = make_plane(plates[plate].normal, plates[plate].side, plates[plate].side);
    const Vec3 corner = mesh.vertices[0].cast<double>(), first = mesh.vertices[1].cast<double>() - corner,
               second = mesh.vertices[3].cast<double>() - corner;
    for (int i = 0; i < along * along; ++i) {
      const Vec3 place = corner + (i % along + 0.5) / along * first + (i / along + 0.5) / along * second;
      patches.push_back({plates[plate].middle + place, plates[plate].normal, std::pow(plates[plate].side / along, 2),
                         static_cast<int>(plate)});
    }
  }
  return patches;
}

Scene scene_of_plates(const std::vector<Plate>& plates) {
  std::vector<Scene> scenes;
  for (const Plate& plate : plates) {
    scenes.push_back(
        scene_of(make_plane(plate.normal, plate.side, plate.side), plate.material, {.position = plate.middle}));
  }
  return scene_of_all(std::move(scenes));
}

// @param lowest, highest  Elevations [deg].
SonarConfig sonar_over(double azimuths, double lowest, double highest) {
  SonarConfig sonar;
  sonar.frequency = 400e3;
  sonar.beam_count = 40;
  sonar.azimuth_aperture = azimuths * kDegree;
  sonar.elevation_aperture = (highest - lowest) * kDegree;
  sonar.elevation_center = 0.5 * (highest + lowest) * kDegree;
  sonar.min_range = 0;
  sonar.max_range = 60;
  sonar.bin_count = 300;
  sonar.sampling = {8, 400};
  return sonar;
}

constexpr double kAbsorption = 0.4;                             // [dB/m]
constexpr double kLoss = 2 * kAbsorption * 0.1151292546497023;  // Loss of intensity, one way [1/m].
const Water kLossyWater{.absorption_db_per_m = kAbsorption};

// Energy of order 2, and of 3 and more, of walks: means over pings.
std::pair<Mean, Mean> energies(const std::vector<Plate>& plates, const FlatPlanSettings& settings, const Vec3& sonar) {
  WalkScene walks("cpu", scene_of_plates(plates), settings, sonar, 100'000);
  Mean two, more;
  for (int ping = 0; ping < 80; ++ping) {
    walks.ping(ping);
    two.add(walks.energy(2));
    more.add(walks.energy(3));
  }
  return {two, more};
}

// Four standard errors, and the error of the sum over patches.
void expect_mean(const Mean& found, double expected, double of_patches) {
  EXPECT_NEAR(found.value(), expected, 4 * found.error() + of_patches * expected);
  EXPECT_LT(4 * found.error(), 0.08 * expected);  // So the test can fail.
}

// Three faces of a box that do not touch, and a sonar at none of their axes.
TEST(WalkQuadratureTest, DiffuseSurfacesGiveTheSumOverAllPaths) {
  const std::vector<Plate> plates = {{Vec3::UnitZ(), {2.9, 0.1, -1.1}, 1.8, diffuse(-8)},
                                     {-Vec3::UnitX(), {4.1, 0, 0.2}, 1.7, diffuse(-6.5)},
                                     {-Vec3::UnitY(), {2.6, 1.3, 0.1}, 1.6, diffuse(-7)}};
  const Vec3 sonar(0.1, -0.2, 0.15);
  const FlatPlanSettings settings{
      .sonar = sonar_over(100, -45, 45), .water = kLossyWater, .elevation_array = ArraySettings{}};
  const auto [two, more] = energies(plates, settings, sonar);

  const std::vector<Patch> patches = patches_of(plates, 24);
  const ElevationPattern pattern(*settings.elevation_array, settings.sonar.elevation_aperture,
                                 settings.sonar.elevation_center);
  const auto count = static_cast<Eigen::Index>(patches.size());
  Eigen::VectorXd sent(count),
      received(count);  // Energy that falls on a patch; of what it scatters, that which comes back.
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Patch& here = patches[i];
    const double mu = std::pow(10, plates[here.plate].material.lambert_db / 10);
    const Vec3 there = here.place - sonar;
    const double range = there.norm(), facing = -there.dot(here.normal) / range;
    const double gain = pattern.intensity(std::asin(there.z() / range)) * std::exp(-kLoss * range) / (range * range);
    sent[i] = gain * facing * here.area;
    received[i] = gain * mu * facing;
    for (Eigen::Index j = 0; j < count; ++j) {
      const Vec3 on = patches[j].place - here.place;
      const double length = on.norm();
      if (patches[j].plate != here.plate) {
        exchange(i, j) = mu * here.normal.dot(on) * -patches[j].normal.dot(on) * patches[j].area *
                         std::exp(-kLoss * length) / std::pow(length, 4);
      }
    }
  }
  Eigen::VectorXd field = exchange.transpose() * sent;
  expect_mean(two, received.dot(field), 0.01);
  double expected = 0;
  for (int order = 3; order < 12; ++order) {
    field = exchange.transpose() * field;
    expected += received.dot(field);
  }
  expect_mean(more, expected, 0.01);
}

// Share of facets that are not masked: Smith's function exactly, 2 / (1 + erf(a) + exp(-a^2) / (a sqrt(pi))) with
// a = cot(incidence) / (sqrt(2) slope).
double not_masked(double cosine, double slope) {
  const double a = cosine / (std::sqrt(1 - cosine * cosine) * std::numbers::sqrt2 * slope);
  return 2 / (1 + std::erf(a) + std::exp(-a * a) / (a * std::sqrt(kPi)));
}

// Two plates with lobes: paths of three surfaces go from one to the other and back to the first, which is one mirror.
// So order 3 lacks mirrored-anything-mirrored, which secondary echoes have. Of the lobes of rough plates secondary
// echoes have the coherent share alone, exp(-4 k^2 h^2 cos^2).
// Facets reflect at their own angle of incidence, where |R| depends on it as that of sand and gravel does.
struct Lobes {
  double rms_height;
  bool by_angle = false;
};
class WalkMirrorTest : public testing::TestWithParam<Lobes> {};

TEST_P(WalkMirrorTest, MirroredSoundIsCountedWhereSecondaryEchoesLeaveItOut) {
  Material first = glinting(0.7, 0.45), second = glinting(0.72, 0.5);
  first.lambert_db = -10;
  second.lambert_db = -9;
  first.rms_height = second.rms_height = GetParam().rms_height;
  if (GetParam().by_angle) {
    first.reflection = second.reflection = {};
    first.density = 1900, first.sound_speed = 2600, first.loss = 0.02;
    second.density = 1800, second.sound_speed = 2400, second.loss = 0.02;
  }
  const std::vector<Plate> plates = {{Vec3::UnitZ(), {2.6, 0.2, -1.2}, 1.6, first},
                                     {-Vec3::UnitX(), {4.2, 0, 0.3}, 1.8, second}};
  const Vec3 sonar(0.1, -0.2, 0.4);
  const FlatPlanSettings settings{.sonar = sonar_over(80, -50, 20), .water = kLossyWater};
  const auto [two, more] = energies(plates, settings, sonar);

  constexpr int kAlong = 10, kEach = kAlong * kAlong;
  const std::vector<Patch> patches = patches_of(plates, kAlong);
  const std::array<Scattering, 2> laws = {first.scattering(400e3), second.scattering(400e3)};
  const auto lobe = [&](const Patch& at, const Vec3& from, const Vec3& to) {
    const Material& material = plates[at.plate].material;
    const Vec3 in = (from - at.place).normalized(), out = (to - at.place).normalized();
    const double cosine = at.normal.dot(in);
    // And what facets reflect into the surface, from where it comes out again: the image of `out` in the surface.
    const Vec3 into = out - 2 * out.dot(at.normal) * at.normal;
    const auto by_facet = [&](const Vec3& leaving) {
      const double reflectance = laws[at.plate].reflectance(in.dot((in + leaving).normalized()));
      return facet_scatter(std::sqrt(reflectance), material.rms_slope, half_vector_tilt(at.normal, in, leaving));
    };
    return (by_facet(out) + by_facet(into)) * not_masked(cosine, material.rms_slope) / cosine;
  };
  const auto lambert = [&](const Patch& at, const Vec3& to) {
    return std::pow(10, plates[at.plate].material.lambert_db / 10) * at.normal.dot((to - at.place).normalized());
  };
  const auto coherent = [&](const Patch& at, const Vec3& from) {
    const double phase = 2 * kPi * 400e3 / 1500 * GetParam().rms_height * at.normal.dot((from - at.place).normalized());
    return std::exp(-4 * phase * phase);
  };
  const auto arriving = [&](const Patch& at, const Vec3& from) {  // Share of a steradian that a patch fills.
    const Vec3 there = at.place - from;
    const double length = there.norm();
    return -at.normal.dot(there) * at.area / std::pow(length, 3) * std::exp(-kLoss * length);
  };
  const auto back = [&](const Patch& at) {
    const double range = (at.place - sonar).norm();
    return std::exp(-kLoss * range) / (range * range);
  };
  // Energy that goes from patch i of one plate to patch j of the other, after a first bounce that was diffuse or
  // incoherent (0) or mirrored (1).
  std::array<Eigen::MatrixXd, 2> going[2];  // [plate of i][kind](i, j)
  double expected_two = 0;
  for (int plate = 0; plate < 2; ++plate) {
    for (Eigen::MatrixXd& of_kind : going[plate]) {
      of_kind.resize(kEach, kEach);
    }
    for (int i = 0; i < kEach; ++i) {
      const Patch& here = patches[plate * kEach + i];
      const double sent = arriving(here, sonar);
      for (int j = 0; j < kEach; ++j) {
        const Patch& next = patches[(1 - plate) * kEach + j];
        const double met = sent * arriving(next, here.place);
        const double mirrored = coherent(here, sonar), glint = lobe(here, sonar, next.place);
        going[plate][0](i, j) = met * (lambert(here, next.place) + (1 - mirrored) * glint);
        going[plate][1](i, j) = met * mirrored * glint;
        expected_two += going[plate][0](i, j) * back(next) *
                        (lambert(next, sonar) + (1 - coherent(next, here.place)) * lobe(next, here.place, sonar));
      }
    }
  }
  expect_mean(two, expected_two, 0.01);

  // What patch j of the other plate, met from patch i of a plate, scatters towards that plate's patch k, [plate][j](i,
  // k).
  std::array<std::array<Eigen::MatrixXd, kEach>, 2> scattered;
  for (int plate = 0; plate < 2; ++plate) {
    for (int j = 0; j < kEach; ++j) {
      const Patch& here = patches[(1 - plate) * kEach + j];
      scattered[plate][j].resize(kEach, kEach);
      for (int k = 0; k < kEach; ++k) {
        const Vec3& next = patches[plate * kEach + k].place;
        for (int i = 0; i < kEach; ++i) {
          scattered[plate][j](i, k) = lambert(here, next) + lobe(here, patches[plate * kEach + i].place, next);
        }
      }
    }
  }
  double expected_more = 0;
  for (int order = 3; order < 6; ++order) {
    std::array<Eigen::MatrixXd, 2> after[2];
    for (int plate = 0; plate < 2; ++plate) {
      for (Eigen::MatrixXd& of_kind : after[1 - plate]) {
        of_kind = Eigen::MatrixXd::Zero(kEach, kEach);
      }
      for (int j = 0; j < kEach; ++j) {
        const Patch& here = patches[(1 - plate) * kEach + j];
        for (int k = 0; k < kEach; ++k) {
          const Patch& next = patches[plate * kEach + k];
          const double met = arriving(next, here.place);
          const double ends_diffuse = lambert(next, sonar), ends_mirrored = lobe(next, here.place, sonar);
          for (int kind = 0; kind < 2; ++kind) {
            const double sum = going[plate][kind].col(j).dot(scattered[plate][j].col(k));
            after[1 - plate][kind](j, k) = met * sum;
            const double left_out = order == 3 && kind == 1 ? coherent(next, here.place) : 0;
            expected_more += met * sum * (ends_diffuse + (1 - left_out) * ends_mirrored) * back(next);
          }
        }
      }
    }
    going[0] = after[0];
    going[1] = after[1];
  }
  expect_mean(more, expected_more, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Lobes, WalkMirrorTest,
                         testing::Values(Lobes{0}, Lobes{1.7e-4}, Lobes{4e-4}, Lobes{4e-4, true}));

}  // namespace
}  // namespace insonify::validation::walk_quadrature_test
