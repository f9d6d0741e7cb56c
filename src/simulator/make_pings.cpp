// make_pings.cpp -- makes pings from requests, in batches as large as the engine takes.

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "insonify/error.h"
#include "receiver/paper_receiver.h"
#include "simulator/echo_sources.h"
#include "simulator/simulator_state.h"

namespace insonify {
namespace {

// Requests that are checked and placed before the first of them is made.
constexpr std::size_t kAtOnce = 256;

// Most moved objects with which an engine receives a ping itself: each has a lattice of scatterers in every cell, of
// which few are hit, while the host computes those that are.
constexpr std::size_t kMostFrames = 16;

// Where a request has an aperture of the sonar.
PingView view_of(const SimulatedSonar& sonar, const Aperture& aperture, const PingRequest& request,
                 const Placement& placement) {
  const Pose housing_from_aperture = housing_from_head(sonar.head_angle(request)) * aperture.housing_from_aperture;
  const Pose world_from_aperture = sonar.world_from_beams(request) * housing_from_aperture;
  return {.plan = aperture.plan.get(),
          .world_from_sonar = world_from_aperture,
          .placement = &placement,
          .layers = aperture.layers,
          .number = request.number,
          .time = request.time,
          .world_from_vehicle = request.world_from_vehicle,
          .vehicle_from_sonar = sonar.vehicle_from_housing * housing_from_aperture};
}

void add_times(const std::vector<StepTime>& more, std::vector<StepTime>& sums) {
  for (const StepTime& step : more) {
    const auto found = std::ranges::find(sums, step.step, &StepTime::step);
    found == sums.end() ? sums.push_back(step) : void(found->seconds += step.seconds);
  }
}

// Positions of the thrusters, which one source has found.
std::span<const std::optional<Vec3>> thrusters_in(const SourceSet& sources) {
  for (const AskingSource& source : sources) {
    if (!source.found.thrusters.empty()) {
      return source.found.thrusters;
    }
  }
  return {};
}

}  // namespace

// Passes each view's echoes through the receiver of its aperture.
class Simulator::State::Receiver final : public EchoReceiver {
 public:
  /// @param first  The first view of the batch in State::views_.
  Receiver(State& state, std::size_t first) : state_(state), first_(first) {}

  void receive(std::size_t view, const EchoGrid& grid, const FormedBeams* formed, Workers& workers,
               int worker) override {
    const Shot& shot = state_.shots_[first_ + view];
    const PingView& from = state_.views_[first_ + view];
    const Scenario& scenario = state_.scenario;
    const Aperture& aperture = *shot.aperture;
    Ping& ping = *shot.ping;
    ping.number = shot.request->number;
    ping.time = shot.request->time;
    ping.head_angle = shot.sonar->head_angle(*shot.request);
    ping.world_from_sonar = shot.sonar->world_from_beams(*shot.request);
    if (scenario.model == EchoModel::kPaper) {
      PaperReceiver(
          grid, aperture.config,
          {.model = scenario.paper, .noise = scenario.receiver_of(aperture.config).noise, .seed = aperture.seed}, ping)
          .receive(workers);
    } else {
      const PingMotion motion = scenario.motion_in_ping
                                    ? shot.sonar->motion_while_listening(*shot.request, from.vehicle_from_sonar)
                                    : PingMotion{};
      aperture.receivers[worker]->receive(grid, formed, state_.displaced_[shot.order], from.world_from_sonar, motion,
                                          thrusters_in(*state_.sources_[view]), workers, ping);
    }
    if (shot.sonar->detector) {
      shot.sonar->detector->detect(ping, ping.soundings);
    }
  }

 private:
  State& state_;
  std::size_t first_;
};

void Simulator::State::add_views(std::size_t i, const PingOrder& order) {
  const SimulatedSonar& of = sonar(order.sonar);
  const PingRequest& request = *order.request;
  if (i >= placements_.size()) {
    placements_.push_back(std::make_unique<Placement>());
    displaced_.emplace_back();
  }
  try {
    request.validate();
    of.check(request, scenario.motion_in_ping);
    const Vec3 position = request.world_from_vehicle * of.config.position;
    if (sea) {
      sea->check(position);
    }
    if (layers) {
      layers->check(scenario, of.config, position);
    }
    load_scene();
    Placement& placement = *placements_[i];
    placement.at_home = at_home;
    objects.place(request.moved, scene, placement);
    displaced_[i].clear();
    for (const Placement::Moved& moved : placement.moved) {
      displaced_[i].push_back(
          {static_cast<std::uint16_t>(moved.instance), at_home[moved.instance] * moved.world_from_mesh.inverse()});
    }
    if (sea) {
      sea->place(position, placement);
    }
  } catch (const Error& error) {
    throw Error(fmt::format("ping {} of {}: {}", request.number, of.config.name, error.what()));
  }
  for (Aperture& aperture : sonars[order.sonar].apertures) {
    views_.push_back(view_of(of, aperture, request, *placements_[i]));
    shots_.push_back({&request, &of, &aperture, i, order.ping});
    if (views_.size() > receptions_.size()) {
      receptions_.push_back(std::make_unique<Reception>());
      parts_.push_back(std::make_unique<Ping>());
    }
    if (of.joiner) {
      shots_.back().ping = parts_[views_.size() - 1].get();
    }
  }
}

void Simulator::State::place(int sonar, const PingRequest& request) {
  views_.clear();
  shots_.clear();
  add_views(0, {sonar, &request, nullptr});
  engine->place(*views_[0].placement);
}

// Sources keep what they need between the rounds of a batch, so each view has its own; later batches of an aperture use
// them again.
SourceSet* Simulator::State::sources_of(Aperture& aperture, std::size_t slot) {
  while (aperture.sources.size() <= slot) {
    const std::optional<SurfaceLabel> water = sea ? std::optional(sea->label()) : std::nullopt;
    aperture.sources.push_back(
        std::make_unique<SourceSet>(make_sources({scenario, targets, aperture, senders, water, layers.has_value()})));
  }
  return aperture.sources[slot].get();
}

void Simulator::State::make(std::span<const PingOrder> orders) {
  step_times.clear();
  for (std::size_t start = 0; start < orders.size(); start += kAtOnce) {
    const std::span<const PingOrder> some = orders.subspan(start, std::min(kAtOnce, orders.size() - start));
    std::exception_ptr refused;
    views_.clear();
    shots_.clear();
    std::size_t count = 0;
    try {
      for (; count < some.size(); ++count) {
        add_views(count, some[count]);
      }
    } catch (const Error&) {
      refused = std::current_exception();
    }
    make_views();
    join(some.first(count));
    if (refused) {
      std::rethrow_exception(refused);
    }
  }
}

void Simulator::State::make_views() {
  ray_counts = {};
  for (std::size_t first = 0; first < views_.size();) {
    if (scenario.engine != engine->kind().name) {
      start_runner();  // A device has failed since, outside of batches.
    }
    const std::size_t together = runner->capacity(std::span(views_).subspan(first));
    if (try_batch(first, together)) {
      first += together;
    }
  }
}

bool Simulator::State::try_batch(std::size_t first, std::size_t count) {
  try {
    make_batch(first, count);
    return true;
  } catch (const DeviceFailure& failure) {
    if (spare == nullptr) {
      throw;
    }
    spare->give_up(failure);
    start_runner();
    return false;
  }
}

// Sets what engines need that receive pings themselves.
void Simulator::State::aim_receivers(std::size_t first, std::size_t count) {
  if (!engine->receives()) {
    return;
  }
  const bool apart = count >= static_cast<std::size_t>(workers.count());
  const auto aim = [&](std::size_t view, int worker) {
    const Aperture& of = *shots_[view].aperture;
    const std::vector<DisplacedInstance>& displaced = displaced_[shots_[view].order];
    PingView& from = views_[view];
    CalibratedReceiver* const receiver =
        of.receivers.empty() ? nullptr : of.receivers[static_cast<std::size_t>(worker)].get();
    if (receiver != nullptr && receiver->flat() != nullptr && from.layers.ground_truth != GroundTruth::kFull &&
        displaced.size() <= kMostFrames) {
      receiver->aim(displaced, from.world_from_sonar, *receptions_[view]);
      from.reception = receptions_[view].get();
    }
  };
  if (apart) {
    workers.for_each(static_cast<int>(count),
                     [&](int view, int worker) { aim(first + static_cast<std::size_t>(view), worker); });
    return;
  }
  for (std::size_t view = first; view < first + count; ++view) {
    aim(view, 0);
  }
}

// Sets how the water bends the rays of views. Sonars at one depth share tables.
void Simulator::State::bend_rays(std::size_t first, std::size_t count) {
  if (!layers) {
    return;
  }
  refractions_.resize(std::max(refractions_.size(), count));
  const Refraction* before = refractions_.front().get();
  for (std::size_t i = 0; i < count; ++i) {
    PingView& view = views_[first + i];
    refractions_[i] = layers->refraction(scenario, shots_[first + i].sonar->config, view, workers, before);
    before = refractions_[i].get();
    view.refraction = before;
  }
}

void Simulator::State::make_batch(std::size_t first, std::size_t count) {
  const auto threads = static_cast<std::size_t>(workers.count());
  const std::span<const Shot> shots = std::span(shots_).subspan(first, count);
  sources_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    Aperture& of = *shots[i].aperture;
    const auto before = static_cast<std::size_t>(std::ranges::count(shots.first(i), &of, &Shot::aperture));
    sources_.push_back(sources_of(of, before));
    if (scenario.model == EchoModel::kCalibrated && count >= threads && of.receivers.size() < threads) {
      of.add_receivers(scenario, materials_at(of.config.frequency, scenario, scene), threads);
    }
  }
  aim_receivers(first, count);
  bend_rays(first, count);
  Receiver receiver(*this, first);
  runner->run(std::span(views_).subspan(first, count), sources_, receiver);
  for (std::size_t i = 0; i < count; ++i) {
    if (shots[i].order == shots_.back().order) {
      ray_counts += runner->ray_counts(i);
    }
  }
  add_times(runner->step_times(), step_times);
}

void Simulator::State::join(std::span<const PingOrder> orders) {
  for (std::size_t view = 0; view < shots_.size(); ++view) {
    const Shot& shot = shots_[view];
    SideJoiner* const joiner = shot.sonar->joiner ? &*sonars[orders[shot.order].sonar].joiner : nullptr;
    if (joiner == nullptr) {
      continue;
    }
    Ping& ping = *orders[shot.order].ping;
    const Ping* const sides[] = {shot.ping, shots_[++view].ping};
    ping.number = sides[0]->number;
    ping.time = sides[0]->time;
    ping.head_angle = 0;
    ping.world_from_sonar = sides[0]->world_from_sonar;
    const auto& receivers = shot.aperture->receivers;
    joiner->join(sides, receivers.empty() ? 0 : receivers.front()->covered_bins(), ping);
  }
}

}  // namespace insonify
