// mattress.cpp -- blocks draped one by one, sleepers, grout bags.

#include "cooler/mattress.h"

namespace {

constexpr double kBlockPitch = 0.3;   // [m]
constexpr double kBlockSide = 0.27;   // At its waist, where it is widest [m].
constexpr double kBlockCrown = 0.17;  // At top and bottom [m].
constexpr double kRopeRadius = 0.011;

// Two frusta back to back, its foot at z = 0.
Shape make_block() {
  const auto square = [](double side) {
    const double half = side / 2;
    return std::vector<Vec2>{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  };
  Shape block = sweep("concrete", {{0, 0, 0}, {0, 0, kMattressThickness / 2}, {0, 0, kMattressThickness}},
                      square(kBlockSide), Vec3::UnitX());
  block.deform([](const Vec3& p) -> Vec3 {
    const double crown = kBlockCrown / kBlockSide;
    const double share = std::abs(p.z() - kMattressThickness / 2) > 0.01 ? crown : 1;
    return {share * p.x(), share * p.y(), p.z()};
  });
  return block;
}

}  // namespace

Shape make_mattress(const Pose& world_from_plan, const Ground& drape) {
  const int columns = static_cast<int>(std::lround(kMattressLength / kBlockPitch));
  const int rows = static_cast<int>(std::lround(kMattressWidth / kBlockPitch));
  const Shape block = make_block();
  Shape mattress;

  // A place of the mattress's plan on what it lies on, and the slope there over the size of a block.
  const auto on_drape = [&](double x, double y) -> Vec3 {
    const Vec3 place = world_from_plan * Vec3(x, y, 0);
    return {place.x(), place.y(), drape(place.x(), place.y())};
  };
  std::vector<std::vector<Vec3>> waists(static_cast<std::size_t>(columns));
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const double x = kBlockPitch * (i - (columns - 1) / 2.0);
      const double y = kBlockPitch * (j - (rows - 1) / 2.0);
      const double half = kBlockPitch / 2;
      const Vec3 along_x = on_drape(x + half, y) - on_drape(x - half, y);
      const Vec3 along_y = on_drape(x, y + half) - on_drape(x, y - half);
      Eigen::Matrix3d turn;
      const Vec3 up = along_x.cross(along_y).normalized();
      turn << along_x.normalized(), up.cross(along_x.normalized()), up;
      const Pose pose{on_drape(x, y) - 0.02 * Vec3::UnitZ(), Eigen::Quaterniond(turn)};
      mattress.add(block, pose);
      waists[static_cast<std::size_t>(i)].push_back(pose * Vec3(0, 0, kMattressThickness / 2));
    }
  }

  // Ropes through the blocks, every second row, without the lifting loops at both ends.
  for (int j = 0; j < rows; j += 2) {
    Path rope;
    for (const std::vector<Vec3>& column : waists) {
      rope.push_back(column[static_cast<std::size_t>(j)]);
    }
    const Vec3 out = (rope.back() - rope.front()).normalized();
    rope.insert(rope.begin(), rope.front() - 0.33 * out - Vec3(0, 0, 0.08));
    rope.push_back(rope.back() + 0.33 * out - Vec3(0, 0, 0.08));
    mattress.add(tube("nylon", rope, kRopeRadius, 5));
  }
  return mattress;
}

Shape make_sleeper(double height, double pipe_radius) {
  constexpr double kLength = 2.6;  // [m]
  constexpr double kFoot = 0.75;
  constexpr double kCrown = 0.42;
  const double sunk = 0.12;
  Shape sleeper = sweep("concrete", {{0, -kLength / 2, 0}, {0, kLength / 2, 0}},
                        {{-kFoot / 2, -sunk},
                         {kFoot / 2, -sunk},
                         {kFoot / 2, 0.1},
                         {kCrown / 2, height - 0.04},
                         {kCrown / 2 - 0.04, height},
                         {-kCrown / 2 + 0.04, height},
                         {-kCrown / 2, height - 0.04},
                         {-kFoot / 2, 0.1}},
                        Vec3::UnitZ());
  for (const double side : {-1.0, 1.0}) {  // Horns of steel, spread so that the pipe finds its way between them.
    const double y = side * (pipe_radius + 0.09);
    sleeper.add(tube("steel",
                     bent({{0, y, height - 0.1},
                           {0, y, height + 1.2 * pipe_radius},
                           {0, y + side * 0.22, height + 1.2 * pipe_radius + 0.3}},
                          0.12, 4),
                     0.045, 10));
  }
  for (const double y : {-0.8, 0.8}) {  // Lifting loops.
    sleeper.add(make_handle("steel", {0.1, y, height - 0.08}, {-0.1, y, height - 0.08}, {0, 0, 0.21}, 0.06, 0.014));
  }
  return sleeper;
}

Shape make_grout_bag(double height, std::uint32_t seed) {
  Shape bag = icosphere("concrete", 3);
  bag.deform([&](const Vec3& p) -> Vec3 {
    // A pillow: squarer than an ellipsoid, flat below, its seam drawn in, and lumpy.
    const auto square = [](double v) { return std::copysign(std::pow(std::abs(v), 0.6), v); };
    const double lumps = 1 + 0.08 * fractal_noise(2.2 * p + Vec3::Constant(0.61 * seed), seed, 3);
    return {0.45 * lumps * square(p.x()), 0.75 * lumps * square(p.y()), height * (0.42 + 0.58 * lumps * square(p.z()))};
  });
  return bag;
}
