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

// Where a request has the sonar.
PingView view_of(const SimulatedSonar& sonar, const PingRequest& request, const Placement& placement) {
  const Pose head = housing_from_head(sonar.head_angle(request));
  return {.plan = sonar.plan.get(),
          .world_from_sonar = request.world_from_vehicle * sonar.vehicle_from_housing * head,
          .placement = &placement,
          .layers = sonar.layers,
          .number = request.number,
          .time = request.time,
          .world_from_vehicle = request.world_from_vehicle,
          .vehicle_from_sonar = sonar.vehicle_from_housing * head};
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

// Passes each view's echoes through the receiver of its sonar.
class Simulator::State::Receiver final : public EchoReceiver {
 public:
  /// @param first  The first view of the batch in State::views_.
  Receiver(State& state, std::span<const PingOrder> orders, std::size_t first)
      : state_(state), orders_(orders), first_(first) {}

  void receive(std::size_t view, const EchoGrid& grid, const FormedBeams* formed, Workers& workers,
               int worker) override {
    const PingOrder& order = orders_[view];
    const SimulatedSonar& sonar = state_.sonars[order.sonar];
    const PingView& from = state_.views_[first_ + view];
    const Scenario& scenario = state_.scenario;
    Ping& ping = *order.ping;
    ping.number = order.request->number;
    ping.time = order.request->time;
    ping.head_angle = sonar.head_angle(*order.request);
    ping.world_from_sonar = order.request->world_from_vehicle * sonar.vehicle_from_housing;
    if (scenario.model == EchoModel::kPaper) {
      PaperReceiver(grid, sonar.config,
                    {.model = scenario.paper, .noise = scenario.receiver_of(sonar.config).noise, .seed = scenario.seed},
                    ping)
          .receive(workers);
      return;
    }
    const PingMotion motion =
        scenario.motion_in_ping ? sonar.motion_while_listening(*order.request, from.vehicle_from_sonar) : PingMotion{};
    sonar.receivers[worker]->receive(grid, formed, state_.displaced_[first_ + view], from.world_from_sonar, motion,
                                     thrusters_in(*state_.sources_[view]), workers, ping);
  }

 private:
  State& state_;
  std::span<const PingOrder> orders_;
  std::size_t first_;
};

void Simulator::State::set_view(std::size_t i, int index, const PingRequest& request) {
  const SimulatedSonar& of = sonar(index);
  if (i >= views_.size()) {
    views_.emplace_back();
    placements_.push_back(std::make_unique<Placement>());
    receptions_.push_back(std::make_unique<Reception>());
    displaced_.emplace_back();
  }
  try {
    request.validate();
    of.check(request, scenario.motion_in_ping);
    const Vec3 position = request.world_from_vehicle * of.config.position;
    if (sea) {
      sea->check(position);
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
    views_[i] = view_of(of, request, placement);
  } catch (const Error& error) {
    throw Error(fmt::format("ping {} of {}: {}", request.number, of.config.name, error.what()));
  }
}

void Simulator::State::place(int sonar, const PingRequest& request) {
  set_view(0, sonar, request);
  engine->place(*views_[0].placement);
}

// Sources keep what they need between the rounds of a batch, so each view has its own; a sonar's later batches use them
// again.
SourceSet* Simulator::State::sources_of(SimulatedSonar& sonar, std::size_t slot) {
  while (sonar.sources.size() <= slot) {
    const std::optional<SurfaceLabel> water = sea ? std::optional(sea->label()) : std::nullopt;
    sonar.sources.push_back(std::make_unique<SourceSet>(make_sources({scenario, targets, sonar, senders, water})));
  }
  return sonar.sources[slot].get();
}

void Simulator::State::make(std::span<const PingOrder> orders) {
  step_times.clear();
  for (std::size_t start = 0; start < orders.size(); start += kAtOnce) {
    const std::span<const PingOrder> some = orders.subspan(start, std::min(kAtOnce, orders.size() - start));
    std::exception_ptr refused;
    std::size_t count = 0;
    try {
      for (; count < some.size(); ++count) {
        set_view(count, some[count].sonar, *some[count].request);
      }
    } catch (const Error&) {
      refused = std::current_exception();
    }
    for (std::size_t first = 0; first < count;) {
      if (scenario.engine != engine->kind().name) {
        start_runner();  // A device has failed since, outside of batches.
      }
      const std::span<const PingView> left = std::span(views_).subspan(first, count - first);
      const std::size_t together = runner->capacity(left);
      if (try_batch(some.subspan(first, together), left.first(together), first)) {
        first += together;
      }
    }
    if (refused) {
      std::rethrow_exception(refused);
    }
  }
}

bool Simulator::State::try_batch(std::span<const PingOrder> orders, std::span<const PingView> views,
                                 std::size_t first) {
  try {
    make_batch(orders, views, first);
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
void Simulator::State::aim_receivers(std::span<const PingOrder> orders, std::size_t first) {
  if (!engine->receives()) {
    return;
  }
  const bool apart = orders.size() >= static_cast<std::size_t>(workers.count());
  const auto aim = [&](std::size_t view, int worker) {
    SimulatedSonar& of = sonars[orders[view].sonar];
    PingView& from = views_[first + view];
    CalibratedReceiver* const receiver =
        of.receivers.empty() ? nullptr : of.receivers[static_cast<std::size_t>(worker)].get();
    if (receiver != nullptr && receiver->flat() != nullptr && from.layers.ground_truth != GroundTruth::kFull &&
        displaced_[first + view].size() <= kMostFrames) {
      receiver->aim(displaced_[first + view], from.world_from_sonar, *receptions_[first + view]);
      from.reception = receptions_[first + view].get();
    }
  };
  if (apart) {
    workers.for_each(static_cast<int>(orders.size()),
                     [&](int view, int worker) { aim(static_cast<std::size_t>(view), worker); });
    return;
  }
  for (std::size_t view = 0; view < orders.size(); ++view) {
    aim(view, 0);
  }
}

void Simulator::State::make_batch(std::span<const PingOrder> orders, std::span<const PingView> views,
                                  std::size_t first) {
  const auto threads = static_cast<std::size_t>(workers.count());
  sources_.clear();
  for (std::size_t i = 0; i < orders.size(); ++i) {
    SimulatedSonar& of = sonars[orders[i].sonar];
    const auto before =
        static_cast<std::size_t>(std::ranges::count(orders.first(i), orders[i].sonar, &PingOrder::sonar));
    sources_.push_back(sources_of(of, before));
    if (scenario.model == EchoModel::kCalibrated && orders.size() >= threads && of.receivers.size() < threads) {
      of.add_receivers(scenario, materials_at(of.config.frequency, scenario, scene), threads);
    }
  }
  aim_receivers(orders, first);
  Receiver receiver(*this, orders, first);
  runner->run(views, sources_, receiver);
  ray_counts = runner->ray_counts(views.size() - 1);
  add_times(runner->step_times(), step_times);
}

}  // namespace insonify
