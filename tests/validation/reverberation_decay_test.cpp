// reverberation_decay_test.cpp -- the late part of random walks in closed spaces decays as theory says.
//
// After many diffuse reflections the energy in a space with walls of reflectance R2 decays as e^(-rate path), and the
// level of its reverberation by 20 / ln 10 x rate [dB per metre of range], range being half of the path.

#include <array>
#include <map>
#include <numbers>

#include "validation/walk_scene.h"

namespace insonify::validation::reverberation_decay_test {
namespace {

constexpr double kDecibelsPerRate = 20 / 2.302585092994046;

Material lambert_wall(double reflectance) {
  return diffuse(10 * std::log10(reflectance / std::numbers::pi));
}

// Path lengths between two points of the inside of a sphere that scatters after Lambert have the density l / (2 R^2),
// 0..2R, independently of each other. So the rate solves R2 times the integral of l / (2 R^2) e^(rate l) = 1; with x =
// 2 R rate: 2 R2 (e^x (x - 1) + 1) / x^2 = 1.
double rate_in_sphere(double radius, double reflectance) {
  double low = 1e-6, high = 50;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.5 * (low + high);
    (2 * reflectance * (std::exp(x) * (x - 1) + 1) / (x * x) < 1 ? low : high) = x;
  }
  return low / (2 * radius);
}

struct Patch {
  Vec3 place, normal, along, across;  // The last two from edge to edge.
  int face;
};

std::vector<Patch> patches_of_box(const Vec3& size, int count) {
  std::vector<Patch> patches;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double side = face % 2 == 0 ? -0.5 : 0.5;
    for (int i = 0; i < count * count; ++i) {
      Patch patch{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), face};
      patch.place[axis] = side * size[axis];
      patch.place[u] = size[u] * ((i % count + 0.5) / count - 0.5);
      patch.place[v] = size[v] * ((i / count + 0.5) / count - 0.5);
      patch.normal[axis] = side < 0 ? 1 : -1;
      patch.along[u] = size[u] / count;
      patch.across[v] = size[v] / count;
      patches.push_back(patch);
    }
  }
  return patches;
}

// Share of the sound that leaves a patch after Lambert which meets another, and the mean length of its way, from points
// of both patches.
struct Exchange {
  double share = 0, length = 0;
};

Exchange exchange_between(const Patch& from, const Patch& to) {
  constexpr int kPoints = 4;
  const auto point = [](const Patch& patch, int i) {
    return Vec3(patch.place + ((i % kPoints + 0.5) / kPoints - 0.5) * patch.along +
                ((i / kPoints + 0.5) / kPoints - 0.5) * patch.across);
  };
  Exchange exchange;
  for (int i = 0; i < kPoints * kPoints; ++i) {
    for (int j = 0; j < kPoints * kPoints; ++j) {
      const Vec3 there = point(to, j) - point(from, i);
      const double share =
          from.normal.dot(there) * -to.normal.dot(there) / (std::numbers::pi * std::pow(there.squaredNorm(), 2));
      exchange.share += share;
      exchange.length += share * there.norm();
    }
  }
  exchange.length /= exchange.share;
  exchange.share *= to.along.norm() * to.across.norm() / std::pow(kPoints, 4);
  return exchange;
}

/// Exchange between the patches of a box, [from, to].
struct BoxExchange {
  std::vector<Patch> patches;
  Eigen::MatrixXd share, length;
};

BoxExchange exchange_in_box(const Vec3& size) {
  BoxExchange box{patches_of_box(size, 7), {}, {}};
  const std::vector<Patch>& patches = box.patches;
  const auto area_of = [](const Patch& patch) { return patch.along.norm() * patch.across.norm(); };
  const auto count = static_cast<Eigen::Index>(patches.size());
  box.share = box.length = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (patches[i].face != patches[j].face) {
        const Exchange exchange = exchange_between(patches[i], patches[j]);
        box.length(i, j) = box.length(j, i) = exchange.length;
        box.share(i, j) = exchange.share;
        box.share(j, i) = exchange.share * area_of(patches[i]) / area_of(patches[j]);  // Reciprocity.
      }
    }
  }
  double area = 0, path = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    box.share.row(i) /= box.share.row(i).sum();  // All of the sound of a patch meets a wall.
    area += area_of(patches[i]);
    path += area_of(patches[i]) * box.share.row(i).dot(box.length.row(i));
  }
  // The mean free path is 4 V / S; here it comes out some 2 % short, since patches that meet at an edge exchange too
  // much.
  const double mean_path = 4 * size.prod() / area;
  EXPECT_NEAR(path / area, mean_path, 0.03 * mean_path);
  box.length *= mean_path / (path / area);
  return box;
}

// Rate of decay in a box with walls that scatter after Lambert, from the exchange of sound between patches: the rate at
// which the largest eigenvalue of R2 (share of the sound of i that j gets) e^(rate l_ij) is 1. No random numbers.
// @param open  Number of a face that is not there; -1 for none.
double rate_in_box(const Vec3& size, double reflectance, int open = -1) {
  static std::map<std::array<double, 3>, BoxExchange> known;  // Several tests have the same box.
  BoxExchange& box = known[{size.x(), size.y(), size.z()}];
  if (box.patches.empty()) {
    box = exchange_in_box(size);
  }
  Eigen::MatrixXd share = box.share;
  const Eigen::Index count = share.rows();
  for (Eigen::Index i = 0; i < count; ++i) {
    if (box.patches[i].face == open) {
      share.row(i).setZero();
    }
  }
  double low = 0, high = 20 / size.norm();
  for (int i = 0; i < 20; ++i) {  // To a millionth of the first interval.
    const double rate = 0.5 * (low + high);
    const Eigen::MatrixXd exchange = reflectance * (share.array() * (rate * box.length.array()).exp()).matrix();
    Eigen::VectorXd field = Eigen::VectorXd::Ones(count);
    double eigenvalue = 0;
    for (int step = 0; step < 30; ++step) {
      const Eigen::VectorXd next = exchange * field;
      eigenvalue = next.norm() / field.norm();
      field = next / next.norm();
    }
    (eigenvalue < 1 ? low : high) = rate;
  }
  return low;
}

SonarConfig wide_sonar(double max_range) {
  SonarConfig sonar;
  sonar.beam_count = 32;
  sonar.azimuth_aperture = 120 * kDegree;
  sonar.elevation_aperture = 70 * kDegree;
  sonar.min_range = 0.1;
  sonar.max_range = max_range;
  sonar.bin_count = 200;
  sonar.sampling = {4, 100};
  return sonar;
}

// Decay of the reverberation between two windows of range, 1 m wide [dB per metre of range].
Mean decay_of(Scene scene, const Vec3& position, double near, double far, const char* engine = "cpu", int walks = 4000,
              int pings = 24) {
  WalkScene room(engine, std::move(scene), {.sonar = wide_sonar(far + 2), .water = {.absorption = false}}, position,
                 walks);
  // The level of each sum of several pings, so that the logarithm of a noisy sum is not biased.
  constexpr int kTogether = 4;
  Mean decay;
  for (int group = 0; group < pings / kTogether; ++group) {
    double first = 0, last = 0;
    for (int ping = 0; ping < kTogether; ++ping) {
      room.ping(kTogether * group + ping);
      first += room.energy(3, near, near + 1);
      last += room.energy(3, far, far + 1);
    }
    // The windows may have numbers of bins that differ by one.
    const double bins = room.bins(far, far + 1) / room.bins(near, near + 1);
    decay.add(10 * std::log10(first / last * bins) / (far - near));
  }
  return decay;
}

// Four standard errors, and one percent for the patches of the reference and the facets of a sphere.
double tolerance(const Mean& decay) {
  return 4 * decay.error() + 0.01 * decay.value();
}

TEST(ReverberationDecayTest, IsThatOfASphere) {
  const Mean decay = decay_of(sphere_at({0, 0, 0}, 0.8, lambert_wall(0.7)), {0.2, 0.1, -0.15}, 5, 9);
  const double expected = kDecibelsPerRate * rate_in_sphere(0.8, 0.7);
  EXPECT_NEAR(decay.value(), expected, tolerance(decay));
  EXPECT_LT(tolerance(decay), 0.04 * expected);  // So the test can fail.
}

TEST(ReverberationDecayTest, IsThatOfTheWallsOfABox) {
  struct Box {
    Vec3 size;
    double reflectance, near, far;
  };
  for (const Box& box : {Box{{2, 1.2, 0.9}, 0.85, 4, 10}, Box{{5, 4, 2}, 0.6, 9, 15}}) {
    const Mean decay = decay_of(scene_of(make_box(box.size), lambert_wall(box.reflectance), {}),
                                {-0.2 * box.size.x(), 0.1 * box.size.y(), 0}, box.near, box.far);
    const double expected = kDecibelsPerRate * rate_in_box(box.size, box.reflectance);
    EXPECT_NEAR(decay.value(), expected, tolerance(decay)) << box.size.transpose();
    EXPECT_LT(tolerance(decay), 0.04 * expected);
    // Eyring: -S ln R2 / (4 V) for paths of equal length; those of unequal length keep more, up to 10 % here.
    const double volume = box.size.prod(), surface = 2 * (box.size.x() * box.size.y() + box.size.y() * box.size.z() +
                                                          box.size.z() * box.size.x());
    const double eyring = -kDecibelsPerRate * surface * std::log(box.reflectance) / (4 * volume);
    EXPECT_LT(decay.value(), 1.01 * eyring);
    EXPECT_GT(decay.value(), 0.8 * eyring);
  }
}

// A box without its lid.
TEST(ReverberationDecayTest, IsFasterWhereAWallIsMissing) {
  const Vec3 size(2, 1.2, 0.9);
  const double reflectance = 0.85;
  const Material material = lambert_wall(reflectance);
  const Scene open = scene_of_all({
      scene_of(make_plane(Vec3::UnitX(), 0.9, 1.2), material, {.position = {-1, 0, 0}}),
      scene_of(make_plane(-Vec3::UnitX(), 0.9, 1.2), material, {.position = {1, 0, 0}}),
      scene_of(make_plane(Vec3::UnitY(), 2, 0.9), material, {.position = {0, -0.6, 0}}),
      scene_of(make_plane(-Vec3::UnitY(), 2, 0.9), material, {.position = {0, 0.6, 0}}),
      scene_of(make_plane(Vec3::UnitZ(), 2, 1.2), material, {.position = {0, 0, -0.45}}),
  });
  const Mean decay = decay_of(open, {-0.4, 0.12, 0}, 3, 6);
  const double expected = kDecibelsPerRate * rate_in_box(size, reflectance, 5);  // Face 5 is that at +z.
  EXPECT_GT(expected, 2 * kDecibelsPerRate * rate_in_box(size, reflectance));
  EXPECT_NEAR(decay.value(), expected, 4 * decay.error() + 0.02 * expected);  // The patches at the open edge are large.
}

// Mirrors with lobes mix the sound as diffuse walls do, once the roughness has spread it.
TEST(ReverberationDecayTest, OfEvenWallsIsNearTheirReflectance) {
  const Vec3 size(2, 1.2, 0.9);
  const Mean decay = decay_of(scene_of(make_box(size), glinting(std::sqrt(0.85), 0.3), {}), {-0.4, 0.12, 0}, 3, 9);
  const double expected = kDecibelsPerRate * rate_in_box(size, 0.85);
  EXPECT_NEAR(decay.value() / expected, 1, 0.12);  // Grazing paths along the box are reflected less often.
}

TEST(ReverberationDecayTest, IsAlikeOnTheReferenceEngine) {
  const Scene scene = scene_of(make_box({1.5, 1.1, 0.8}), lambert_wall(0.75), {});
  const Mean cpu = decay_of(scene, {-0.3, 0.1, 0}, 1, 4, "cpu", 500, 8),
             reference = decay_of(scene, {-0.3, 0.1, 0}, 1, 4, "reference", 500, 8);
  EXPECT_NEAR(cpu.value(), reference.value(), 1e-3 * cpu.value());  // The same walks but for rounding.
}

}  // namespace
}  // namespace insonify::validation::reverberation_decay_test
