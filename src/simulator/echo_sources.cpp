// echo_sources.cpp -- the list of echo sources: when each has something to do, and what it is made from.

#include "simulator/echo_sources.h"

#include <cmath>
#include <span>

#include "echo/batch/echo_source.h"
#include "echo/model/hit.h"
#include "echo/targets/corner_echoes.h"
#include "echo/targets/edge_echoes.h"
#include "echo/targets/interference.h"
#include "echo/targets/point_echoes.h"
#include "echo/targets/point_ghosts.h"
#include "echo/thin/thin_echoes.h"
#include "echo/walks/random_walks.h"
#include "insonify/thruster.h"

namespace insonify {
namespace {

// Finds EchoList::thrusters, the positions of the vehicle's thrusters in the frame of a sonar's head: they make noise,
// no echoes. Any surface in the way hides one.
class ThrusterPaths final : public EchoSource {
 public:
  explicit ThrusterPaths(std::span<const Thruster> thrusters) : thrusters_(thrusters) {}

  void ask(const PingView& view, Workers&, RayList& rays) override {
    const Vec3 sonar = view.world_from_vehicle * view.vehicle_from_sonar.position;
    for (const Thruster& thruster : thrusters_) {
      const Vec3 there = view.world_from_vehicle * thruster.position - sonar;
      const double range = there.norm();
      rays.rays.push_back({sonar, there / range, 0, range - double{kRayClearance}});
    }
  }

  void answer(const PingView& view, const RayAnswers& hits, Workers&, RayList&, EchoList& found) override {
    if (hits.rays.empty()) {
      return;
    }
    const Pose sonar_from_vehicle = view.vehicle_from_sonar.inverse();
    for (std::size_t i = 0; i < thrusters_.size(); ++i) {
      found.thrusters.emplace_back();
      if (!std::isfinite(hits.rays[i].distance)) {
        found.thrusters.back() = sonar_from_vehicle * thrusters_[i].position;
      }
    }
  }

 private:
  std::span<const Thruster> thrusters_;
};

using Source = std::unique_ptr<EchoSource>;

bool has_array(const SourceSettings& settings) {
  return settings.scenario.receiver_of(settings.aperture.config).azimuth_pattern != BeamPattern::kTopHat;
}

Source thin_echoes(const SourceSettings& settings, const SourceSet&) {
  const auto& parts = settings.targets.thin_parts;
  return parts->pieces.empty() ? nullptr : std::make_unique<ThinEchoes>(parts);
}

Source random_walks(const SourceSettings& settings, const SourceSet&) {
  if (!settings.aperture.walks) {
    return nullptr;
  }
  RandomWalks::Settings walks = *settings.aperture.walks;
  walks.elsewhere = {.corners = CornerEchoes::act(*settings.targets.corners, *settings.aperture.plan),
                     .water = settings.water.value_or(kNoSurface)};
  walks.waves = settings.water && settings.scenario.surface->wind_speed > 0 ? *settings.water : kNoSurface;
  return std::make_unique<RandomWalks>(walks);
}

Source corner_echoes(const SourceSettings& settings, const SourceSet&) {
  const auto& corners = settings.targets.corners;
  return CornerEchoes::act(*corners, *settings.aperture.plan) ? std::make_unique<CornerEchoes>(corners) : nullptr;
}

Source point_echoes(const SourceSettings& settings, const SourceSet&) {
  const auto& points = settings.scenario.points;
  return points.empty() ? nullptr : std::make_unique<PointEchoes>(points);
}

Source face_glints(const SourceSettings& settings, const SourceSet&) {
  const auto& faces = settings.targets.faces;
  return faces->any() ? std::make_unique<FaceGlints>(faces) : nullptr;
}

Source edge_echoes(const SourceSettings& settings, const SourceSet& before) {
  const auto& edges = settings.targets.edges;
  const FaceGlints* glints = nullptr;
  for (const AskingSource& source : before) {
    glints = glints != nullptr ? glints : dynamic_cast<const FaceGlints*>(source.source.get());
  }
  return edges->any() ? std::make_unique<EdgeEchoes>(edges, glints) : nullptr;
}

Source point_ghosts(const SourceSettings& settings, const SourceSet&) {
  const Scenario& scenario = settings.scenario;
  if (scenario.points.empty() || settings.bent) {
    return nullptr;  // Mirrors are not plane in apparent space.
  }
  std::optional<PointGhosts::Surface> water;
  if (settings.water) {
    water = {.level = scenario.surface->level, .label = *settings.water, .waves = scenario.surface->wind_speed > 0};
  }
  const bool phases = scenario.receiver_of(settings.aperture.config).speckle;
  return std::make_unique<PointGhosts>(scenario.points, water, settings.targets.mirrors, phases);
}

Source interference(const SourceSettings& settings, const SourceSet&) {
  const auto& interferers = settings.scenario.interferers;
  return interferers.empty() ? nullptr : std::make_unique<Interference>(interferers, has_array(settings));
}

Source mutual_interference(const SourceSettings& settings, const SourceSet&) {
  return settings.senders.empty() ? nullptr
                                  : std::make_unique<MutualInterference>(
                                        settings.senders, settings.aperture.config.name, has_array(settings));
}

Source thruster_paths(const SourceSettings& settings, const SourceSet&) {
  const auto& thrusters = settings.scenario.thrusters;
  return thrusters.empty() ? nullptr : std::make_unique<ThrusterPaths>(thrusters);
}

// Each makes a source, or null where it has nothing to do; in the order in which their echoes are added.
// @param before  Sources made before it, for those that rest on another.
constexpr Source (*kSources[])(const SourceSettings& settings, const SourceSet& before) = {
    thin_echoes, random_walks, corner_echoes, point_echoes,        face_glints,
    edge_echoes, point_ghosts, interference,  mutual_interference, thruster_paths,
};

}  // namespace

SourceSet make_sources(const SourceSettings& settings) {
  SourceSet sources;
  if (settings.scenario.model == EchoModel::kCalibrated) {
    for (const auto& make : kSources) {
      if (Source source = make(settings, sources)) {
        sources.emplace_back(std::move(source));
      }
    }
  }
  return sources;
}

}  // namespace insonify
