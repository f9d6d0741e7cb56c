// cargo.cpp -- cars, a container, a boat and ground tackle.

#include "ferry/cargo.h"

namespace {

Shape make_wheel(double radius, double width) {
  const Shape tyre = revolve("rubber",
                             {{0, -width / 2},
                              {0.55 * radius, -width / 2},
                              {0.92 * radius, -width / 2},
                              {radius, -width / 4},
                              {radius, width / 4},
                              {0.92 * radius, width / 2},
                              {0.55 * radius, width / 2},
                              {0, width / 2}},
                             16);
  return placed(tyre, at({0, 0, radius}, 90));
}

// A body cut from its side view: an outline in x-z with see-through windows, `width` across, middle on y = 0.
Shape extruded_side_view(const std::string& material, const std::vector<Vec2>& outline,
                         const std::vector<std::vector<Vec2>>& windows, double width) {
  return placed(plate(material, outline, windows, width), at({0, width / 2, 0}, 90));
}

// The wave of a container's wall [m].
double corrugation(double along) {
  const double phase = along / 0.28 - std::floor(along / 0.28);
  return 0.036 * std::clamp(1.5 - 6 * std::abs(phase - 0.5), 0.0, 1.0);
}

constexpr double kContainerPlate = 0.01;  // Thickness [m].

// Between two corner posts, which hide its ends.
Shape corrugated_wall(const Vec3& from, const Vec3& to, double height) {
  const double length = (to - from).norm();
  const Vec3 along = (to - from) / length;
  const Vec3 inwards = Vec3::UnitZ().cross(along);
  return panel(
      "steel",
      [&](double s, double t) -> Vec3 { return from + s * along + corrugation(s) * inwards + t * Vec3::UnitZ(); },
      stepped(0.05, length - 0.05, 0.07), {0, height / 2, height}, kContainerPlate);
}

// One link: a long round in x-z, or lying flat in x-y.
Shape make_link(double length, bool upright) {
  const double half = length / 2;
  const double bow = 0.32 * length;
  std::vector<Vec3> path;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2 * kPi * i / 12;
    const double straight = std::copysign(half - bow * 0.6, std::cos(angle));
    const double x = straight + 0.6 * bow * std::cos(angle);
    const double across = bow * std::sin(angle);
    path.push_back(upright ? Vec3(x, 0, across) : Vec3(x, across, 0));
  }
  return tube("steel", path, 0.1 * length, 5, true);
}

}  // namespace

Shape make_car(std::uint32_t seed) {
  const double stretch = 0.95 + 0.15 * chance(seed, 1);
  const double crush = 0.2 * chance(seed, 2);  // More would fold the sides over themselves.
  const double width = 1.72;
  std::vector<Vec2> outline = {{-2.15, 0.32}, {-2.15, 0.86}, {-1.95, 0.98}, {-1.35, 1.0}, {-0.85, 1.4},
                               {0.35, 1.42},  {0.95, 0.98},  {1.95, 0.84},  {2.12, 0.68}, {2.12, 0.32}};
  const auto add_wheel_arch = [&](double x) {
    for (const double angle : spaced(0, kPi, 7)) {
      outline.emplace_back(x + 0.36 * std::cos(angle), 0.28 + 0.36 * std::sin(angle));
    }
  };
  add_wheel_arch(1.35);
  add_wheel_arch(-1.3);
  Shape car = extruded_side_view("steel", outline,
                                 {{{-1.05, 1.02}, {-0.8, 1.3}, {-0.3, 1.32}, {-0.3, 1.02}},
                                  {{-0.2, 1.02}, {-0.2, 1.32}, {0.25, 1.32}, {0.68, 1.02}}},
                                 width);
  car.deform([&](const Vec3& p) -> Vec3 {
    const double cabin = smooth_step(0.9, 1.4, p.z());
    return {stretch * p.x(), p.y() * (1 - 0.2 * cabin), p.z() - crush * cabin * smooth_step(1.0, -1.5, p.x() + p.y())};
  });
  for (const double x : {-1.3, 1.35}) {
    for (const double y : {-0.72, 0.72}) {
      car.add(make_wheel(0.3, 0.2), at({stretch * x, y, 0}));
    }
  }
  return car;
}

Shape make_lorry() {
  Shape lorry = extruded_side_view("steel", {{1.5, 0.5}, {3.15, 0.5}, {3.2, 1.3}, {2.85, 2.25}, {1.5, 2.3}},
                                   {{{1.85, 1.4}, {2.75, 1.4}, {2.6, 2.0}, {1.85, 2.0}}}, 2.0);
  lorry.add(box("steel", {6.2, 0.8, 0.25}), at({0, 0, 0.6}));
  // The box has lost its roof and its tail.
  const auto body_wall = [&](const Vec3& from, const Vec3& to) { lorry.add(wall("steel", from, to, 2.1, 0.05)); };
  body_wall({-3.2, -1.15, 0.75}, {1.3, -1.15, 0.75});
  body_wall({1.3, 1.15, 0.75}, {-3.2, 1.15, 0.75});
  lorry.add(wall("steel", {1.29, -1.13, 0.76}, {1.29, 1.13, 0.76}, 2.08, 0.05));
  lorry.add(box("wood", {4.46, 2.26, 0.06}), at({-0.95, 0, 0.76}));
  for (const double x : {-2.0, 2.3}) {
    for (const double y : {-0.9, 0.9}) {
      lorry.add(make_wheel(0.42, 0.28), at({x, y, 0}));
    }
  }
  return lorry;
}

Shape make_container() {
  constexpr double kLength = 6.06;
  constexpr double kWidth = 2.44;
  constexpr double kHeight = 2.59;
  const double x = kLength / 2;
  const double y = kWidth / 2;
  Shape container;
  container.add(corrugated_wall({-x, -y, 0.1}, {x, -y, 0.1}, kHeight - 0.2));
  container.add(corrugated_wall({x, y, 0.1}, {-x, y, 0.1}, kHeight - 0.2));
  container.add(corrugated_wall({-x, y, 0.1}, {-x, -y, 0.1}, kHeight - 0.2));
  container.add(panel(  // Roof, stove in.
      "steel",
      [](double s, double t) -> Vec3 {
        return {s, t, kHeight - 0.05 - 0.5 * std::exp(-(s - 0.8) * (s - 0.8) - t * t)};
      },
      stepped(-x + 0.02, x - 0.02, 0.3), stepped(-y + 0.02, y - 0.02, 0.3), kContainerPlate));
  container.add(box("wood", {kLength - 0.04, kWidth - 0.04, 0.12}), at({0, 0, 0.12}));

  // Posts and beams of the frame.
  for (const double side_x : {-x, x}) {
    for (const double side_y : {-y, y}) {
      container.add(box("steel", {0.16, 0.16, kHeight}), at({side_x, side_y, kHeight / 2}));
    }
  }
  for (const double z : {0.08, kHeight - 0.06}) {
    container.add(box("steel", {kLength, 0.1, 0.14}), at({0, -y, z}));
    container.add(box("steel", {kLength, 0.1, 0.14}), at({0, y, z}));
    container.add(box("steel", {0.1, kWidth, 0.14}), at({-x, 0, z + 0.005}));
    container.add(box("steel", {0.1, kWidth, 0.14}), at({x, 0, z + 0.005}));
  }
  // One door shut, one swung wide.
  container.add(box("steel", {0.05, kWidth / 2 - 0.05, kHeight - 0.24}), at({x, -y / 2, kHeight / 2}));
  container.add(box("steel", {0.05, kWidth / 2 - 0.05, kHeight - 0.24}),
                at({x + 0.5, y + 0.38, kHeight / 2}, 0, 0, -52));
  return container;
}

Shape make_lifeboat() {
  constexpr double kLength = 5.6;
  const auto half_breadth = [](double s) { return 0.95 * std::pow(1 - std::pow(std::abs(2 * s - 1), 2.6), 0.8); };
  // Both ends sharp, sheer rising to them, round bilges.
  const Surface planking = [&](double s, double girth) -> Vec3 {
    const double angle = girth * kPi / 2;
    const double sheer = 0.9 + 0.4 * (2 * s - 1) * (2 * s - 1);
    const double keel = 0.35 * std::pow(std::abs(2 * s - 1), 4);
    return {(s - 0.5) * kLength, half_breadth(s) * std::copysign(std::pow(std::abs(std::sin(angle)), 0.8), girth),
            keel + (sheer - keel) * (1 - std::pow(std::cos(angle), 0.9))};
  };
  Shape boat = panel("wood", planking, spaced(0.01, 0.99, 25), spaced(-1, 1, 21), 0.05, {{0.56, 0.68, 0.35, 0.75}});
  for (const double s : {0.25, 0.45, 0.65}) {
    boat.add(box("wood", {0.25, 1.9 * half_breadth(s), 0.05}), at({(s - 0.5) * kLength, 0, 0.65}));
  }
  return boat;
}

Shape make_chain(const std::vector<Vec3>& path, double link_length) {
  Shape chain;
  double position = 0;  // Position of the next link's middle along the present piece [m].
  bool upright = false;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vec3 piece = path[i + 1] - path[i];
    const double length = piece.norm();
    for (; position < length; position += 0.8 * link_length) {
      const double yaw = std::atan2(piece.y(), piece.x());
      const double pitch = -std::asin(piece.z() / length);
      const Vec3 middle = path[i] + position / length * piece;
      chain.add(make_link(link_length, upright), at(middle, 0, pitch / kPi * 180, yaw / kPi * 180));
      upright = !upright;
    }
    position -= length;
  }
  return chain;
}

Shape make_anchor() {
  Shape anchor = box("steel", {1.5, 0.16, 0.2});
  anchor.deform([](const Vec3& p) -> Vec3 { return p + Vec3(0, 0, 0.25); });
  anchor.add(box("steel", {0.3, 1.1, 0.3}), at({-0.75, 0, 0.25}));
  for (const double y : {-0.42, 0.42}) {
    anchor.add(plate("steel", {{0, -0.14}, {0.75, -0.03}, {0.9, 0.02}, {0.75, 0.08}, {0, 0.14}}, {}, 0.12),
               at({-0.75, y, 0.25}, 0, -28));
  }
  anchor.add(
      tube("steel", {{0.75, -0.16, 0.25}, {0.95, -0.16, 0.25}, {0.95, 0.16, 0.25}, {0.75, 0.16, 0.25}}, 0.05, 6, true));
  return anchor;
}
