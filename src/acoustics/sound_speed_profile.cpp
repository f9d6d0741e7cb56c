// sound_speed_profile.cpp -- rays through layers of linear sound speed, in closed form.

#include "insonify/acoustics/sound_speed_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "acoustics/find_root.h"
#include "acoustics/formula.h"
#include "insonify/acoustics/sound_speed.h"
#include "insonify/error.h"

namespace insonify {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

// Duration of the way between two points of a layer. In a half-plane whose speed is linear, travel time is hyperbolic
// distance: sinh(g t/2) = g chord / (2 sqrt(c0 c1)).
double time_along(double chord, double speed, double speed_there, double gradient) {
  const double straight = chord / std::sqrt(speed * speed_there);
  const double half = gradient * straight / 2;
  return half == 0 || !std::isfinite(straight) ? straight : straight * std::asinh(half) / half;
}

// By how much an angle changes when its sine falls: from a first guess by Newton's method, since the difference of two
// arcsines has few digits near the vertical.
double turn_by(double angle, double fall) {
  constexpr double kSlight = 1e-3;
  const double cosine = std::cos(angle);
  double turn = std::abs(fall) < kSlight * cosine * cosine
                    ? -fall / cosine
                    : std::asin(std::clamp(std::sin(angle) - fall, -1.0, 1.0)) - angle;
  for (int i = 0; i < 3; ++i) {
    const double slope = std::cos(angle + turn);
    turn -= slope > 0 ? (2 * std::cos(angle + turn / 2) * std::sin(turn / 2) + fall) / slope : 0;
  }
  return turn;
}

}  // namespace

double ProfilePoint::speed() const {
  return sound_speed ? *sound_speed : chen_millero_sound_speed(temperature_c.value_or(0), salinity.value_or(0), depth);
}

void ProfilePoint::validate(std::string_view object) const {
  visit_fields(*this, [&]<typename Member>(const Field& field, const Member& member) {
    if constexpr (std::is_same_v<Member, double>) {
      check_field(object, field, member);
    } else if (member) {
      check_field(object, field, *member);
    }
  });
  if (!sound_speed && (!temperature_c || !salinity)) {
    throw Error(object, "", " must have a sound_speed, or temperature_c and salinity");
  }
  visit_fields(*this, [&](const Field& field, const auto&) {
    if (field.name == "sound_speed") {  // One that follows from temperature and salinity has the same limits.
      check_field(object, field, speed());
    }
  });
}

void check_profile(std::span<const ProfilePoint> points, std::string_view object) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string name = fmt::format("{}[{}]", object, i);
    points[i].validate(name);
    if (i > 0 && !(points[i].depth > points[i - 1].depth)) {
      throw Error(name, "depth",
                  fmt::format(" = {:.10g} m must be greater than {}[{}].depth = {:.10g} m", points[i].depth, object,
                              i - 1, points[i - 1].depth));
    }
    const double gradient =
        i > 0 ? (points[i].speed() - points[i - 1].speed()) / (points[i].depth - points[i - 1].depth) : 0;
    if (std::abs(gradient) > kSteepestProfile) {
      throw Error(name, "",
                  fmt::format(" changes by {:.4g} m/s in each metre from {}[{}]; must be at most {} m/s", gradient,
                              object, i - 1, kSteepestProfile));
    }
  }
}

// A ray on its way.
struct SoundSpeedProfile::State {
  std::size_t layer;
  RayPoint at;
};

// The way from a point of a layer to where it leaves the layer.
struct SoundSpeedProfile::Leg {
  double distance = kNowhere, time = kNowhere;
  double depth = 0, angle = 0;  // Where it ends.
  std::size_t next = 0;         // The layer that it enters.
};

SoundSpeedProfile::SoundSpeedProfile(std::span<const ProfilePoint> points, std::string_view object) {
  if (points.empty()) {
    throw Error(object, "", " must have a point");
  }
  check_profile(points, object);
  layers_.push_back({-kNowhere, points.front().depth, points.front().depth, points.front().speed(), 0});
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double top = points[i - 1].depth, bottom = points[i].depth, speed = points[i - 1].speed();
    layers_.push_back({top, bottom, top, speed, (points[i].speed() - speed) / (bottom - top)});
  }
  layers_.push_back({points.back().depth, kNowhere, points.back().depth, points.back().speed(), 0});
}

std::size_t SoundSpeedProfile::layer_at(double depth) const {
  const auto found = std::ranges::lower_bound(layers_, depth, {}, &Layer::bottom);
  return static_cast<std::size_t>(found - layers_.begin());
}

double SoundSpeedProfile::speed_at(double depth) const {
  return layers_[layer_at(depth)].speed_at(depth);
}

bool SoundSpeedProfile::is_constant() const {
  return std::ranges::all_of(layers_, [](const Layer& layer) { return layer.gradient == 0; });
}

double SoundSpeedProfile::least_radius() const {
  double radius = kNowhere;
  for (const Layer& layer : layers_) {
    if (layer.gradient != 0) {
      const double slowest = std::min(layer.speed, layer.speed_at(layer.bottom));
      radius = std::min(radius, slowest / std::abs(layer.gradient));
    }
  }
  return radius;
}

SoundSpeedProfile::State SoundSpeedProfile::start(double depth, double launch_angle) const {
  return {layer_at(depth), {.distance = 0, .depth = depth, .angle = launch_angle, .time = 0}};
}

// Whether a ray runs along the boundary that it is at, since both layers bend it back before it is kOffAxis away. Near
// the axis of such a channel it would take ever more legs.
bool SoundSpeedProfile::runs_along(const State& state) const {
  constexpr double kOffAxis = 1e-6;  // [m]
  const Layer& layer = layers_[state.layer];
  const bool at_top = state.at.depth == layer.top, at_bottom = state.at.depth == layer.bottom;
  if (!at_top && !at_bottom) {
    return false;
  }
  const double above = at_top ? layers_[state.layer - 1].gradient : layer.gradient;
  const double below = at_top ? layer.gradient : layers_[state.layer + 1].gradient;
  if (state.at.angle == 0) {
    return above <= 0 && below >= 0;
  }
  const double weakest = std::min(-above, below);  // An arc rises by R angle^2/2.
  return weakest > 0 && state.at.angle * state.at.angle * layer.speed_at(state.at.depth) < 2 * weakest * kOffAxis;
}

// Along the ray cos(angle)/c is constant (Snell), so that sin^2 at another depth is sin^2 here less what cos^2 gains.
// With speed linear in depth the ray is an arc: the chord from end to end is inclined at the mean of both angles.
SoundSpeedProfile::Leg SoundSpeedProfile::leg_to_boundary(const State& state) const {
  const Layer& layer = layers_[state.layer];
  const double sine = std::sin(state.at.angle), cosine = std::cos(state.at.angle);
  const double speed = layer.speed_at(state.at.depth), gradient = layer.gradient;
  const auto square_at = [&](double depth) {
    const double deeper = depth - state.at.depth;
    return sine * sine - cosine * cosine * gradient * deeper * (layer.speed_at(depth) + speed) / (speed * speed);
  };
  if ((sine == 0 && gradient == 0) || runs_along(state)) {
    return {};
  }
  bool down = sine > 0 || (sine == 0 && gradient < 0);
  double end = down ? layer.bottom : layer.top;
  if (!std::isfinite(end)) {
    return {};
  }
  const bool turns = gradient != 0 && square_at(end) < 0;
  if (turns) {
    down = !down;
    end = down ? layer.bottom : layer.top;
  }
  const double sine_there = (down ? 1 : -1) * std::sqrt(gradient == 0 ? sine * sine : square_at(end));
  const double speed_there = layer.speed_at(end);
  const double angle = gradient == 0 ? state.at.angle : std::atan2(sine_there, cosine * speed_there / speed);
  const double middle = (state.at.angle + angle) / 2;
  const double deeper = end - state.at.depth;
  const double chord = turns         ? 2 * speed / (gradient * cosine) * std::sin((state.at.angle - angle) / 2)
                       : deeper == 0 ? 0
                                     : deeper / std::sin(middle);
  return {.distance = chord * std::cos(middle),
          .time = time_along(chord, speed, speed_there, gradient),
          .depth = end,
          .angle = angle,
          .next = down ? state.layer + 1 : state.layer - 1};
}

// Within a layer artanh(sin angle) falls by g a second.
RayPoint SoundSpeedProfile::after_time(double depth, double launch_angle, double time) const {
  State state = start(depth, launch_angle);
  for (Leg leg = leg_to_boundary(state); state.at.time + leg.time < time; leg = leg_to_boundary(state)) {
    state = {leg.next, {state.at.distance + leg.distance, leg.depth, leg.angle, state.at.time + leg.time}};
  }
  const Layer& layer = layers_[state.layer];
  const double speed = layer.speed_at(state.at.depth), rest = time - state.at.time;
  const bool along = std::isinf(leg_to_boundary(state).time);
  const double turn = along ? 0 : layer.gradient * rest;
  const double sine = std::sin(state.at.angle), cosine = std::cos(state.at.angle);
  const double fall = std::cosh(turn) - sine * std::sinh(turn);  // Speed here / speed there.
  const double angle = turn == 0 ? state.at.angle : std::atan2(sine * std::cosh(turn) - std::sinh(turn), cosine);
  const double chord = rest * speed / std::sqrt(fall) * (turn == 0 ? 1 : std::sinh(turn / 2) / (turn / 2));
  const double middle = (state.at.angle + angle) / 2;
  return {state.at.distance + chord * std::cos(middle), state.at.depth + chord * std::sin(middle), angle, time};
}

// Within a layer sin(angle) falls linearly with distance.
RayPoint SoundSpeedProfile::at_distance(double depth, double launch_angle, double distance) const {
  State state = start(depth, launch_angle);
  for (Leg leg = leg_to_boundary(state); state.at.distance + leg.distance < distance; leg = leg_to_boundary(state)) {
    state = {leg.next, {state.at.distance + leg.distance, leg.depth, leg.angle, state.at.time + leg.time}};
  }
  const Layer& layer = layers_[state.layer];
  const double speed = layer.speed_at(state.at.depth), rest = distance - state.at.distance;
  const double gradient = std::isinf(leg_to_boundary(state).distance) ? 0 : layer.gradient;
  const double turn = turn_by(state.at.angle, rest * gradient * std::cos(state.at.angle) / speed);
  const double middle = state.at.angle + turn / 2;
  const double deeper = rest * std::tan(middle);
  return {distance, state.at.depth + deeper, state.at.angle + turn,
          state.at.time + time_along(rest / std::cos(middle), speed, speed + gradient * deeper, gradient)};
}

// Launch angles between which the depth at a distance is a continuous function of the angle, and close enough for it to
// have no more than one extremum between them. It jumps where a ray grazes a depth of greatest speed: on this side the
// ray turns back, on the other it passes.
std::vector<double> SoundSpeedProfile::search_angles(double depth) const {
  constexpr int kSteps = 360;
  constexpr double kAlmost = 1e-12;
  const double speed = speed_at(depth);
  std::vector<double> angles;
  for (int i = 1; i < kSteps; ++i) {
    angles.push_back(kPi * (static_cast<double>(i) / kSteps - 0.5));
  }
  for (const double end : {-kPi / 2, kPi / 2}) {
    angles.push_back(end * (1 - kAlmost));
  }
  for (std::size_t i = 1; i < layers_.size(); ++i) {
    const double above = layers_[i - 1].gradient, below = layers_[i].gradient;
    const double cosine = speed / layers_[i].speed_at(layers_[i].top);
    if (((below < 0 && above >= 0) || (above > 0 && below <= 0)) && cosine <= 1) {
      for (const double sign : {-1.0, 1.0}) {
        angles.push_back(sign * std::acos(cosine) * (1 - kAlmost) - kAlmost);
        angles.push_back(sign * std::acos(cosine) * (1 + kAlmost) + kAlmost);
      }
    }
  }
  std::ranges::sort(angles);
  return angles;
}

std::optional<Eigenray> SoundSpeedProfile::eigenray(double depth, double to_depth, double distance) const {
  constexpr double kUpright = 1e-11;
  const double deeper = to_depth - depth;
  if (distance <= kUpright * std::abs(deeper)) {
    const double launch = std::copysign(kPi / 2, deeper);
    double time = 0;
    for (const Layer& layer : layers_) {
      const double top = std::clamp(layer.top, std::min(depth, to_depth), std::max(depth, to_depth));
      const double bottom = std::clamp(layer.bottom, std::min(depth, to_depth), std::max(depth, to_depth));
      time += time_along(bottom - top, layer.speed_at(top), layer.speed_at(bottom), layer.gradient);
    }
    return Eigenray{launch, launch, time};
  }
  const auto miss = [&](double angle) { return at_distance(depth, angle, distance).depth - to_depth; };
  std::optional<Eigenray> best;
  const auto keep = [&](double angle) {
    const RayPoint there = at_distance(depth, angle, distance);
    constexpr double kNear = 1e-9;  // A jump over the target is no ray to it.
    if (std::abs(there.depth - to_depth) * std::cos(there.angle) > kNear * (distance + std::abs(deeper))) {
      return;
    }
    // A distance fixes the time of a steep ray to few digits: what is missing along the ray adds the others.
    const RayPoint then = after_time(depth, angle, there.time);
    const double missing =
        (distance - then.distance) * std::cos(then.angle) + (to_depth - then.depth) * std::sin(then.angle);
    const double time = there.time + missing / speed_at(to_depth);
    if (!best || time < best->time) {
      best = {angle, there.angle, time};
    }
  };
  for_each_root(miss, search_angles(depth), keep);
  return best;
}

}  // namespace insonify
