// ssiv_site.cpp -- sand that the swell has rippled, stones, and a sinker.

#include "ssiv/ssiv_site.h"

#include "ssiv/ssiv.h"

namespace {

constexpr double kHalfWidth = 22;  // Half the width of the bed [m].
constexpr double kMiddleX = 8;
constexpr double kSinkerX = 9.0;  // [m]
constexpr double kSinkerY = 4.3;

// What a swell of four seconds leaves in eight metres of water: short, nearly symmetric.
const Ripples& ripples() {
  static const Ripples all({.wavelength = 0.36, .height = 0.042, .azimuth = 0.32, .forks = 130, .seed = 601},
                           {kMiddleX - kHalfWidth, kMiddleX + kHalfWidth, -kHalfWidth, kHalfWidth});
  return all;
}

const std::vector<Boulder>& stones() {
  static const std::vector<Boulder> all =
      strewn_stones({34, {3.5, 14.5, -10, 10}, 0.05, 0.97, 0.42, 611}, [](const Boulder& stone) {
        return std::hypot(stone.x - kSsivPosition.x(), stone.y - kSsivPosition.y()) > 2.6 &&
               std::hypot(stone.x - kSinkerX, stone.y - kSinkerY) > 1;
      });
  return all;
}

// Distance in plan from the nearest mudmat, 0 on it [m].
double distance_from_mudmats(double x, double y) {
  const Vec3 p = world_from_ssiv().inverse() * Vec3(x, y, 0);
  const double half = kSsivMudmatSide / 2;
  const double beyond_x = std::max(std::abs(std::abs(p.x()) - kSsivLength / 2) - half, 0.0);
  const double beyond_y = std::max(std::abs(std::abs(p.y()) - kSsivWidth / 2) - half, 0.0);
  return std::hypot(beyond_x, beyond_y);
}

}  // namespace

Pose world_from_ssiv() {
  return at(kSsivPosition, kSsivRollDeg, kSsivPitchDeg, kSsivYawDeg);
}

double ssiv_ground(double x, double y) {
  const double distance = distance_from_mudmats(x, y);
  const double level = 1 - bump(std::hypot(x - kSsivPosition.x(), y - kSsivPosition.y()), 3);
  const double undulation = 0.14 * level * fractal_noise({x / 6, y / 6, 0.5}, 621, 3, 0.4);
  const double scour = 0.06 * bump(distance - 0.12, 0.2) * smooth_step(0, 0.1, distance);
  const StoneScour dug = stone_scour(stones(), x, y);
  const double sinker = std::hypot(x - kSinkerX, y - kSinkerY);
  const double calm = (1 - bump(distance, 0.25)) * dug.calm * (1 - bump(sinker, 0.7));
  return undulation - scour - dug.depth - 0.05 * bump(sinker, 0.8) + calm * ripples().height(x, y);
}

Shape make_ssiv_bed() {
  return make_bed("sand", ssiv_ground, graded(kMiddleX - kHalfWidth, 4.5, 13, kMiddleX + kHalfWidth, 0.075),
                  graded(-kHalfWidth, -7.5, 7.5, kHalfWidth, 0.17));
}

Shape make_ssiv_surroundings() {
  Shape whole = make_boulders(stones(), ssiv_ground, 630);

  // A truncated pyramid of concrete with an eye cast in.
  Shape sinker = sweep("concrete", {{0, 0, -0.15}, {0, 0, 0.4}, {0, 0, 0.44}},
                       {{-0.4, -0.4}, {0.4, -0.4}, {0.4, 0.4}, {-0.4, 0.4}}, Vec3::UnitX());
  sinker.deform([](const Vec3& p) -> Vec3 {
    const double share = p.z() > 0.42 ? 0.68 : p.z() > 0 ? 0.75 : 1.05;
    return {share * p.x(), share * p.y(), p.z()};
  });
  sinker.add(make_handle("steel", {-0.09, 0, 0.4}, {0.09, 0, 0.4}, {0, 0, 0.2}, 0.085, 0.016));
  whole.add(sinker, on_ground(ssiv_ground, kSinkerX, kSinkerY, 0.02, 3, -2, 25));

  // Its rope, cut, lying on the sand.
  Path rope = {{kSinkerX, kSinkerY, ssiv_ground(kSinkerX, kSinkerY) + 0.58}};
  for (const Vec2& p : {Vec2(8.75, 3.75), Vec2(8.3, 3.2), Vec2(8.6, 2.6), Vec2(9.3, 2.7), Vec2(9.5, 3.2),
                        Vec2(10.1, 2.9), Vec2(10.6, 2.0), Vec2(10.3, 1.2), Vec2(10.9, 0.4)}) {
    rope.emplace_back(p.x(), p.y(), ssiv_ground(p.x(), p.y()) + 0.03);
  }
  Path laid = laid_through(rope, 0.08);
  for (std::size_t i = 10; i < laid.size(); ++i) {
    laid[i].z() = ssiv_ground(laid[i].x(), laid[i].y()) + 0.018;
  }
  whole.add(tube("nylon", laid, 0.02, 6));
  return whole;
}
