// scene_ping.h -- the first ping of a shipped scene, with queries on its cells and on the geometry of shadows.

#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"

namespace insonify::testing_scenes {

/// Ping 0 of the scene's first sonar without noise, after `adjust` has changed the scenario.
class ScenePing {
 public:
  explicit ScenePing(const std::string& name, const std::function<void(Scenario&)>& adjust = {})
      : simulator_([&] {
          Scenario scenario = load_scenario(INSONIFY_SOURCE_DIR "/scenes/" + name + ".yaml");
          scenario.receiver.noise = false;
          if (adjust) {
            adjust(scenario);
          }
          Scene scene = load_scene(scenario);
          return Simulator(std::move(scenario), std::move(scene), 2);
        }()),
        ping_(simulator_.make_ping(0, 0)) {}

  [[nodiscard]] const Ping& ping() const { return ping_; }
  [[nodiscard]] const Simulator& simulator() const { return simulator_; }
  [[nodiscard]] const SonarConfig& sonar() const { return simulator_.sonar(0); }
  [[nodiscard]] Pose world_from_sonar() const {
    return simulator_.world_from_head(0, ScenarioRequests(simulator_.scenario()).at(0, 0));
  }

  /// A world position in the sonar's spherical coordinates.
  struct Sighting {
    double range, azimuth, elevation;
  };
  [[nodiscard]] Sighting sighting(const Vec3& place) const {
    const Vec3 p = world_from_sonar().inverse() * place;
    return {p.norm(), std::atan2(p.y(), p.x()), std::atan2(p.z(), std::hypot(p.x(), p.y()))};
  }

  [[nodiscard]] int bin_at(double range) const {
    return static_cast<int>(std::floor((range - sonar().min_range) / sonar().bin_length()));
  }

  /// The beam whose centre is nearest.
  [[nodiscard]] int beam_at(double azimuth) const {
    int best = 0;
    for (int beam = 1; beam < ping_.beam_count; ++beam) {
      if (std::abs(sonar().beam_azimuth(beam) - azimuth) < std::abs(sonar().beam_azimuth(best) - azimuth)) {
        best = beam;
      }
    }
    return best;
  }

  /// Last part of the name of the visual with the cell's strongest echo; "" without an echo.
  [[nodiscard]] std::string visual(int bin, int beam) const {
    const std::uint16_t instance = ping_.instance[ping_.index(bin, beam)];
    if (instance == kNoLabel) {
      return "";
    }
    const std::string& name = simulator_.scene().instances[instance].name;
    return name.substr(name.rfind(':') + 1);
  }

  [[nodiscard]] std::string material(std::size_t cell) const {
    return ping_.material[cell] == kNoLabel ? "" : simulator_.scene().materials[ping_.material[cell]].name;
  }

  [[nodiscard]] double elevation(int bin, int beam) const { return ping_.elevation[ping_.index(bin, beam)]; }

  /// First bin of a beam with an echo of a visual; -1 if there is none.
  [[nodiscard]] int first_bin_of(const std::string& name, int beam) const {
    for (int bin = 0; bin < ping_.bin_count; ++bin) {
      if (visual(bin, beam) == name) {
        return bin;
      }
    }
    return -1;
  }

  /// Fraction of the cells between two ranges and two azimuths that have an echo.
  [[nodiscard]] double share_heard(double from_range, double to_range, double from_azimuth, double to_azimuth) const {
    double received = 0;
    double count = 0;
    for (int beam = 0; beam < ping_.beam_count; ++beam) {
      const double azimuth = sonar().beam_azimuth(beam);
      for (int bin = bin_at(from_range); azimuth > from_azimuth && azimuth < to_azimuth && bin < bin_at(to_range);
           ++bin) {
        received += visual(bin, beam).empty() ? 0 : 1;
        count += 1;
      }
    }
    return count > 0 ? received / count : std::numeric_limits<double>::quiet_NaN();
  }

  /// Limits of the interval around `range` in which a beam has no echo; both are `range` if there is one there.
  struct Silence {
    double from, to;
  };
  [[nodiscard]] Silence silence_around(double range, int beam) const {
    int first = bin_at(range);
    int last = first;
    while (first > 0 && visual(first - 1, beam).empty()) {
      --first;
    }
    while (last < ping_.bin_count && visual(last, beam).empty()) {
      ++last;
    }
    const auto edge = [&](int bin) { return sonar().min_range + bin * sonar().bin_length(); };
    return last == bin_at(range) ? Silence{range, range} : Silence{edge(first), edge(last)};
  }

 private:
  Simulator simulator_;
  Ping ping_;
};

/// A round pipe: a point of its axis, the axis direction, and its radius [m].
struct StraightPipe {
  Vec3 place, along;
  double radius;
};

/// Echo and shadow of a pipe in a beam.
struct PipeShadow {
  double echo;      ///< Range of its nearest point [m].
  double from, to;  ///< Ranges between which the bed beyond it is in shadow [m].
};

/// Length of a ray from `origin` to a bed whose heights are known [m].
inline double range_on_bed(const Vec3& origin, const Vec3& direction,
                           const std::function<double(double, double)>& bed) {
  double range = 0;
  double height = 0;
  for (int round = 0; round < 30; ++round) {  // Each iteration uses the height at the end of the previous ray.
    range = (origin.z() - height) / -direction.z();
    const Vec3 place = origin + range * direction;
    height = bed(place.x(), place.y());
  }
  return range;
}

/// By trigonometry: a beam is a half plane of directions of one azimuth in the sonar's frame. The rays of it that touch
/// the pipe, at the distance of its radius from its axis, bound its shadow above and below.
inline PipeShadow shadow_of_pipe(const Pose& world_from_sonar, double azimuth, const StraightPipe& pipe,
                                 const std::function<double(double, double)>& bed) {
  const Vec3 along = pipe.along.normalized();
  const Vec3 to_axis = pipe.place - world_from_sonar.position;
  const auto ray = [&](double elevation) -> Vec3 {
    return world_from_sonar.orientation *
           Vec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  };
  // Signed distance between ray and axis as lines.
  const auto distance = [&](double elevation) {
    const Vec3 normal = ray(elevation).cross(along);
    return to_axis.dot(normal) / normal.norm();
  };
  const auto touching = [&](double low, double high, double wanted) {
    for (int round = 0; round < 60; ++round) {
      const double middle = (low + high) / 2;
      ((distance(middle) > wanted) == (distance(high) > wanted) ? high : low) = middle;
    }
    return (low + high) / 2;
  };
  constexpr double kReach = 0.17;  // Half of the fan's height, nearly [rad].
  const double middle = touching(-kReach, kReach, 0);
  const double sign = distance(kReach) > 0 ? 1 : -1;
  const double lower = touching(-2 * kReach, middle, -sign * pipe.radius);
  const double upper = touching(middle, 2 * kReach, sign * pipe.radius);

  // Where rays between the two enter the pipe.
  double echo = std::numeric_limits<double>::infinity();
  for (int i = 1; i < 200; ++i) {
    const Vec3 direction = ray(lower + (upper - lower) * i / 200);
    const Vec3 across = direction - direction.dot(along) * along;
    const Vec3 offset = to_axis - to_axis.dot(along) * along;
    const double half = across.dot(offset);
    const double root = half * half - across.squaredNorm() * (offset.squaredNorm() - pipe.radius * pipe.radius);
    echo = std::min(echo, (half - std::sqrt(std::max(root, 0.0))) / across.squaredNorm());
  }
  return {echo, range_on_bed(world_from_sonar.position, ray(lower), bed),
          range_on_bed(world_from_sonar.position, ray(upper), bed)};
}

}  // namespace insonify::testing_scenes
