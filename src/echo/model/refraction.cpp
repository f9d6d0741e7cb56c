// refraction.cpp -- bent rays from the profile, and tables of them.

#include "echo/model/refraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace insonify {
namespace {

constexpr int kLaunches = 2048;  // Intervals of launch angle from -90 to 90 degrees.
constexpr float kLaunchStep = std::numbers::pi_v<float> / kLaunches;
constexpr float kUpright = std::numbers::pi_v<float> / 2;

// A place or direction as seen from the sonar: along the horizontal away from it, and its angle down.
struct Launch {
  Vec3 outward;
  double angle, distance;

  explicit Launch(const Vec3& place) : outward(place.x(), place.y(), 0), angle(0), distance(place.norm()) {
    const double level = outward.norm();
    angle = std::atan2(-place.z(), level);
    outward = level > 0 ? Vec3(outward / level) : Vec3(Vec3::UnitX());
  }
};

template <typename Vector, typename Number>
Vector turned_up(const Vector& direction, const Vector& outward, Number turn) {
  const Number along = direction.dot(outward), down = -direction.z();
  const Number cosine = std::cos(turn), sine = std::sin(turn);
  const Number along_there = along * cosine + down * sine, down_there = down * cosine - along * sine;
  return direction + (along_there - along) * outward - (down_there - down) * Vector::UnitZ();
}

}  // namespace

Refraction::Refraction(std::shared_ptr<const SoundSpeedProfile> water, const Vec3& sonar, double surface_height,
                       double sound_speed, double reach, Workers& workers, const Refraction* before)
    : water_(std::move(water)),
      sonar_(sonar),
      depth_(surface_height - sonar.z()),
      sound_speed_(sound_speed),
      reach_(reach) {
  const bool same = before != nullptr && before->water_ == water_ && before->table_->depth == depth_ &&
                    before->table_->sound_speed == sound_speed_ && before->table_->reach == reach_;
  table_ = same ? before->table_ : make_table(workers);
}

std::shared_ptr<const Refraction::Table> Refraction::make_table(Workers& workers) const {
  Table table{depth_, sound_speed_, reach_, 0, 0, {}};
  const double longest = std::sqrt(8 * kOffChord * water_->least_radius());
  table.chords = static_cast<int>(std::clamp(std::ceil(reach_ / longest), 1.0, double{kMostChords}));
  table.chord = static_cast<float>(reach_ / table.chords);
  const std::size_t stride = static_cast<std::size_t>(table.chords) + 1;
  table.bends.resize((kLaunches + 1) * stride);
  constexpr int kTogether = 64;
  workers.for_each(kLaunches / kTogether + 1, [&](int task, int) {
    for (int i = task * kTogether; i < std::min((task + 1) * kTogether, kLaunches + 1); ++i) {
      const double launch = std::numbers::pi * (static_cast<double>(i) / kLaunches - 0.5);
      Bend* row = &table.bends[static_cast<std::size_t>(i) * stride];
      const double step = reach_ / table.chords;
      RayPoint at{.distance = 0, .depth = depth_, .angle = launch, .time = 0};
      row[0] = {0, 0, 0};
      for (int k = 1; k <= table.chords; ++k) {
        const RayPoint next = water_->after_time(at.depth, at.angle, step / sound_speed_);
        at = {at.distance + next.distance, next.depth, next.angle, 0};
        row[k] = {static_cast<float>(at.distance - k * step * std::cos(launch)),
                  static_cast<float>(at.depth - depth_ - k * step * std::sin(launch)),
                  static_cast<float>(at.angle - launch)};
      }
    }
  });
  return std::make_shared<const Table>(std::move(table));
}

RayPoint Refraction::ray_to(const Vec3& apparent) const {
  const Launch launch(apparent - sonar_);
  return water_->after_time(depth_, launch.angle, launch.distance / sound_speed_);
}

Vec3 Refraction::true_place(const Vec3& apparent) const {
  const RayPoint there = ray_to(apparent);
  return sonar_ + there.distance * Launch(apparent - sonar_).outward - (there.depth - depth_) * Vec3::UnitZ();
}

std::optional<Vec3> Refraction::apparent_place(const Vec3& place) const {
  const Vec3 there = place - sonar_;
  const std::optional<Eigenray> ray = water_->eigenray(depth_, depth_ - there.z(), std::hypot(there.x(), there.y()));
  if (!ray) {
    return {};
  }
  return sonar_ +
         sound_speed_ * ray->time *
             (std::cos(ray->launch_angle) * Launch(there).outward - std::sin(ray->launch_angle) * Vec3::UnitZ());
}

Vec3 Refraction::apparent_direction(const Vec3& apparent, const Vec3& direction) const {
  const Launch launch(apparent - sonar_);
  return turned_up<Vec3, double>(direction, launch.outward, ray_to(apparent).angle - launch.angle);
}

Refraction::Bend Refraction::bend(float launch, float distance) const {
  const Table& table = *table_;
  const float angle = std::clamp((launch + kUpright) / kLaunchStep, 0.0F, static_cast<float>(kLaunches));
  const float along = distance / table.chord;
  const int i = std::min(static_cast<int>(angle), kLaunches - 1);
  const int k = std::min(static_cast<int>(along), table.chords - 1);
  const float u = angle - static_cast<float>(i), v = along - static_cast<float>(k);
  const Bend* low = &table.bends[static_cast<std::size_t>(i) * (static_cast<std::size_t>(table.chords) + 1) +
                                 static_cast<std::size_t>(k)];
  const Bend* high = low + table.chords + 1;
  const float weights[] = {(1 - u) * (1 - v), (1 - u) * v, u * (1 - v), u * v};
  const auto mean = [&](float Bend::*of) {
    return weights[0] * low[0].*of + weights[1] * low[1].*of + weights[2] * high[0].*of + weights[3] * high[1].*of;
  };
  return {mean(&Bend::outward), mean(&Bend::down), mean(&Bend::turn)};
}

Vec3f Refraction::true_offset(const Vec3f& apparent) const {
  const float level = std::hypot(apparent.x(), apparent.y());
  const Bend bent = bend(std::atan2(-apparent.z(), level), apparent.norm());
  const Vec3f outward = level > 0 ? Vec3f(apparent.x() / level, apparent.y() / level, 0) : Vec3f(Vec3f::UnitX());
  return apparent + bent.outward * outward - bent.down * Vec3f::UnitZ();
}

Vec3f Refraction::apparent_direction(const Vec3f& apparent, const Vec3f& direction) const {
  const float level = std::hypot(apparent.x(), apparent.y());
  const Vec3f outward = level > 0 ? Vec3f(apparent.x() / level, apparent.y() / level, 0) : Vec3f(Vec3f::UnitX());
  return turned_up<Vec3f, float>(direction, outward, bend(std::atan2(-apparent.z(), level), apparent.norm()).turn);
}

}  // namespace insonify
