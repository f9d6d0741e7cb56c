// card_engine.h -- an engine that stands for one on a graphics card, which fails when a test wants it to.

#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/device_failure.h"
#include "simulator/small_world.h"
#include "support/same_pings.h"

namespace insonify::testing_scenes {

/// What the card has left before it fails, of each kind of call; and which engine computes on it.
struct CardState {
  bool there = false;
  const char* inner = "cpu";
  int starts = 1000, scenes = 1000, batches = 1000, traces = 1000;
};
inline CardState card;

inline void use(int& left, const char* what) {
  if (left-- <= 0) {
    throw DeviceFailure(std::string("device \"card\" was lost: ") + what);
  }
}

class CardBatch final : public EchoBatch {
 public:
  explicit CardBatch(std::unique_ptr<EchoBatch> inner) : inner_(std::move(inner)) {}
  [[nodiscard]] std::size_t capacity(std::span<const PingView> views) const override { return inner_->capacity(views); }
  using EchoBatch::start;
  void start(std::span<const PingView> views, EchoLists lists) override {
    use(card.batches, "a batch");
    inner_->start(views, lists);
  }
  void receive(EchoReceiver& receiver) override { inner_->receive(receiver); }
  [[nodiscard]] const EchoGrid& map(std::size_t view) override { return inner_->map(view); }
  [[nodiscard]] RayCounts ray_counts(std::size_t view) const override { return inner_->ray_counts(view); }

 private:
  std::unique_ptr<EchoBatch> inner_;
};

/// Computes with another engine.
class CardEngine final : public Engine {
 public:
  CardEngine(Workers& workers, std::string_view device) : inner_(make_engine(card.inner, workers, device)) {
    use(card.starts, "its start");
  }
  static const EngineKind kKind;
  [[nodiscard]] const EngineKind& kind() const override { return kKind; }
  void set_scene(const Scene& scene) override {
    use(card.scenes, "a scene");
    inner_->set_scene(scene);
  }
  void leave_out(std::shared_ptr<const LeftOut> left_out) override { inner_->leave_out(std::move(left_out)); }
  void place(const Placement& placement) override { inner_->place(placement); }
  [[nodiscard]] std::unique_ptr<EchoBatch> make_batch() override {
    return std::make_unique<CardBatch>(inner_->make_batch());
  }
  using Engine::trace;
  void trace(std::span<const RayRun> runs) override {
    use(card.traces, "rays");
    inner_->trace(runs);
  }
  [[nodiscard]] EngineMemory memory() const override { return inner_->memory(); }

 private:
  std::unique_ptr<Engine> inner_;
};

inline const EngineKind CardEngine::kKind = {
    .name = "card",
    .draws_primaries = true,
    .make = [](Workers& workers, std::string_view device) -> std::unique_ptr<Engine> {
      return std::make_unique<CardEngine>(workers, device);
    },
    .find_hardware = [](std::string_view) -> std::string {
      if (!card.there) {
        throw Error("there is no card");
      }
      return "the card of the test";
    }};

/// small_world() with a rod so thin that the samples leave it out.
inline Scene world_with_rod() {
  Scene scene = small_world();
  Instance rod = scene.instances[kMast];
  rod.name = "rod";
  rod.mesh = std::make_shared<const Mesh>(make_cylinder(0.005, 1.5, 0.4));
  rod.world_from_mesh = {.position = {6, -0.5, -1}};
  scene.instances.push_back(std::move(rod));
  return scene;
}

class AutoEngineTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    static const bool once = [] {
      add_engine_kind(CardEngine::kKind);
      return true;
    }();
    EXPECT_TRUE(once);
  }
  void SetUp() override { card = {.there = true}; }
  void TearDown() override { card = {}; }

  // Of 102 400 samples, which is enough for a card.
  static Scenario scenario(std::string_view engine, EchoModel model = EchoModel::kCalibrated) {
    Scenario scenario = small_scenario({"", "cpu", model, PrimaryEchoes::kRays});
    scenario.engine = engine;
    scenario.sonars[0].sampling = {.columns_per_beam = 8, .rows = 400};
    return scenario;
  }

  Simulator make(const Scenario& of, std::uint64_t pings = 0) {
    lines.clear();
    return Simulator(
        of, world_with_rod(), 2, movable, [this](Severity, const std::string& text) { lines.push_back(text); }, pings);
  }

  // Some pings in two batches, the ball elsewhere in the second.
  static std::vector<Ping> pings_of(Simulator& simulator) {
    std::vector<PingRequest> requests(7);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      requests[i].number = i;
      requests[i].moved = {{.name = "ball", .world_from_object = {.position = {6, i < 4 ? 0.1 : 0.4, -1}}}};
    }
    std::vector<Ping> pings(requests.size());
    simulator.ping(0, std::span(requests).first(4), std::span(pings).first(4));
    simulator.ping(0, std::span(requests).subspan(4), std::span(pings).subspan(4));
    return pings;
  }

  void expect_pings_of_cpu(Simulator& simulator, EchoModel model = EchoModel::kCalibrated) {
    const std::vector<Ping> made = pings_of(simulator);
    Simulator host(scenario("cpu", model), world_with_rod(), 2, movable);
    const std::vector<Ping> expected = pings_of(host);
    for (std::size_t i = 0; i < made.size(); ++i) {
      SCOPED_TRACE(i);
      expect_same(made[i], expected[i]);
    }
  }

  std::vector<MovableObject> movable = {{"ball"}};
  std::vector<std::string> lines;
};

}  // namespace insonify::testing_scenes
