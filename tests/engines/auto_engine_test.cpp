// auto_engine_test.cpp -- `engine: auto` on a card that fails: `cpu` goes on, and no ping is lost.

#include <gmock/gmock.h>

#include "base/device_failure.h"
#include "gpu/device.h"
#include "simulator/small_world.h"
#include "support/message_of.h"
#include "support/same_pings.h"

namespace insonify::auto_engine_test {
namespace {

using namespace testing_scenes;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// What the card has left before it fails, of each kind of call; and which engine computes on it.
struct CardState {
  bool there = false;
  const char* inner = "cpu";
  int starts = 1000, scenes = 1000, batches = 1000, traces = 1000;
} card;

void use(int& left, const char* what) {
  if (left-- <= 0) {
    throw DeviceFailure(std::string("device \"card\" was lost: ") + what);
  }
}

class CardBatch final : public EchoBatch {
 public:
  explicit CardBatch(std::unique_ptr<EchoBatch> inner) : inner_(std::move(inner)) {}
  [[nodiscard]] std::size_t capacity(std::span<const PingView> views) const override { return inner_->capacity(views); }
  void start(std::span<const PingView> views) override {
    use(card.batches, "a batch");
    inner_->start(views);
  }
  void receive(std::span<const std::span<const EchoList* const>> lists, EchoReceiver& receiver) override {
    inner_->receive(lists, receiver);
  }
  [[nodiscard]] const EchoGrid& map(std::size_t view) override { return inner_->map(view); }
  [[nodiscard]] RayCounts ray_counts(std::size_t view) const override { return inner_->ray_counts(view); }

 private:
  std::unique_ptr<EchoBatch> inner_;
};

// Computes with another engine.
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

const EngineKind CardEngine::kKind = {.name = "card",
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

constexpr char kChosen[] = "engine: card on the card of the test, expected to make the samples of a ping";

class AutoEngineTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { add_engine_kind(CardEngine::kKind); }
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
        of, small_world(), 2, movable, [this](Severity, const std::string& text) { lines.push_back(text); }, pings);
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
    Simulator host(scenario("cpu", model), small_world(), 2, movable);
    const std::vector<Ping> expected = pings_of(host);
    for (std::size_t i = 0; i < made.size(); ++i) {
      SCOPED_TRACE(i);
      expect_same(made[i], expected[i]);
    }
  }

  std::vector<MovableObject> movable = {{"ball"}};
  std::vector<std::string> lines;
};

TEST_F(AutoEngineTest, ACardComputesUntilTheEnd) {
  Simulator simulator = make(scenario("auto"));
  EXPECT_EQ(simulator.scenario().engine, "card");
  expect_pings_of_cpu(simulator);
  EXPECT_THAT(simulator.engine_choice(), StartsWith(kChosen));
  EXPECT_THAT(lines, ElementsAre());
  EXPECT_LT(card.batches, 1000);
}

TEST_F(AutoEngineTest, OnAMachineWithoutACardCpuComputes) {
  for (const std::string& device : device_texts()) {
    if (!device.starts_with("none: ") && device.find("computes on the processor") == std::string::npos) {
      GTEST_SKIP() << "there is a card: " << device;
    }
  }
  card.there = false;
  Simulator simulator = make(scenario("auto"));
  EXPECT_EQ(simulator.scenario().engine, "cpu");
  EXPECT_THAT(simulator.engine_choice(), StartsWith("engine: cpu, since "));
}

TEST_F(AutoEngineTest, FewPingsStartNoCard) {
  Simulator simulator = make(scenario("auto"), 2);
  EXPECT_EQ(simulator.scenario().engine, "cpu");
  EXPECT_EQ(card.starts, 1000);
  EXPECT_EQ(simulator.engine_choice(), "engine: cpu, since 2 pings end before a graphics card has started");
}

TEST_F(AutoEngineTest, CpuGoesOnInTheMiddleOfARun) {
  for (const EchoModel model : {EchoModel::kPaper, EchoModel::kCalibrated}) {
    for (const int batches : {0, 1}) {
      Simulator simulator = make(scenario("auto", model));
      card.batches = batches;
      expect_pings_of_cpu(simulator, model);
      EXPECT_EQ(simulator.scenario().engine, "cpu");
      EXPECT_THAT(lines, ElementsAre("device \"card\" was lost: a batch; engine cpu goes on"));
    }
  }
}

TEST_F(AutoEngineTest, CpuGoesOnAmongTheRaysOfSources) {
  Simulator simulator = make(scenario("auto"));
  card.traces = 0;
  expect_pings_of_cpu(simulator);
  EXPECT_EQ(simulator.scenario().engine, "cpu");
  EXPECT_THAT(lines, ElementsAre("device \"card\" was lost: rays; engine cpu goes on"));
}

TEST_F(AutoEngineTest, CpuGoesOnWhereTheSceneDoesNotFit) {
  card.scenes = 0;
  Simulator simulator = make(scenario("auto"));
  EXPECT_EQ(simulator.scenario().engine, "cpu");
  expect_pings_of_cpu(simulator);
  EXPECT_THAT(lines, ElementsAre("device \"card\" was lost: a scene; engine cpu goes on"));
}

TEST_F(AutoEngineTest, CpuGoesOnWhereTheCardDoesNotStart) {
  card.starts = 0;
  Simulator simulator = make(scenario("auto"));
  EXPECT_EQ(simulator.scenario().engine, "cpu");
  expect_pings_of_cpu(simulator);
  EXPECT_THAT(lines, ElementsAre("device \"card\" was lost: its start; engine cpu goes on"));
}

// Cameras trace rays between pings.
TEST_F(AutoEngineTest, CamerasGoOnToo) {
  Simulator simulator = make(scenario("auto")), host = make(scenario("cpu"));
  PingRequest request;
  request.moved = {{.name = "ball", .world_from_object = {.position = {4, 0, 0}}}};
  const std::vector<Ray> ray = {{.origin = Vec3::Zero(), .direction = Vec3::UnitX()}};
  std::vector<Hit> hit(1), expected(1);
  simulator.place(0, request);
  host.place(0, request);
  card.traces = 0;
  simulator.engine().trace(ray, hit);
  host.engine().trace(ray, expected);
  EXPECT_EQ(hit[0].instance, kBall);
  EXPECT_EQ(hit[0].distance, expected[0].distance);
  expect_pings_of_cpu(simulator);
  EXPECT_EQ(simulator.scenario().engine, "cpu");
}

TEST_F(AutoEngineTest, TheEngineThatWasAskedForEndsWithTheError) {
  Simulator simulator = make(scenario("card"));
  card.batches = 1;
  (void)simulator.ping(0, {});
  EXPECT_EQ(message_of([&] { (void)simulator.ping(0, {}); }), "device \"card\" was lost: a batch");
  EXPECT_EQ(simulator.engine_choice(), "");
  EXPECT_THAT(lines, ElementsAre());
}

// The driver's answers when a card falls off the bus, or has no memory left.
int submits = 0;
VkResult answer = VK_SUCCESS;
PFN_vkGetDeviceProcAddr find_function = nullptr;
PFN_vkQueueSubmit submit = nullptr;

VkResult submit_or_fail(VkQueue queue, std::uint32_t count, const VkSubmitInfo* work, VkFence done) {
  return submits-- > 0 ? submit(queue, count, work, done) : answer;
}

PFN_vkVoidFunction find_or_replace(VkDevice device, const char* name) {
  const PFN_vkVoidFunction found = find_function(device, name);
  if (std::string_view(name) != "vkQueueSubmit") {
    return found;
  }
  submit = reinterpret_cast<PFN_vkQueueSubmit>(found);
  return reinterpret_cast<PFN_vkVoidFunction>(submit_or_fail);
}

TEST_F(AutoEngineTest, ARealDeviceThatFailsIsReplaced) {
  if (std::ranges::find(usable_engines(), "gpu") == usable_engines().end()) {
    GTEST_SKIP() << "no device of Vulkan here";
  }
  auto& functions = const_cast<gpu::Vulkan&>(gpu::Instance::only().vulkan());
  find_function = std::exchange(functions.GetDeviceProcAddr, find_or_replace);
  card.inner = "gpu";
  Scene world = small_world();
  world.instances[kBox].reliefs.clear();
  for (const auto& [result, meant] : {std::pair(VK_ERROR_DEVICE_LOST, "\" was lost: cannot start a computation"),
                                      std::pair(VK_ERROR_OUT_OF_DEVICE_MEMORY, "\" has no memory left (")}) {
    answer = result;
    submits = 1'000'000;
    lines.clear();
    Simulator simulator(scenario("auto"), world, 2, movable,
                        [this](Severity, const std::string& text) { lines.push_back(text); });
    Simulator host(scenario("cpu"), world, 2, movable);
    (void)simulator.ping(0, {});
    EXPECT_EQ(simulator.scenario().engine, "card");
    submits = 2;  // In the middle of a ping, which has its samples from one engine and rays of sources from the other.
    constexpr double kBetweenEngines = 1e-3;
    EXPECT_LE(apart(simulator.ping(0, {.number = 1}), host.ping(0, {.number = 1})), kBetweenEngines);
    expect_same(simulator.ping(0, {.number = 2}), host.ping(0, {.number = 2}));
    EXPECT_EQ(simulator.scenario().engine, "cpu");
    EXPECT_THAT(lines, ElementsAre(HasSubstr(meant)));
  }
  functions.GetDeviceProcAddr = find_function;
}

TEST_F(AutoEngineTest, ACardIsFoundByTheFilesOfItsDriver) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "dev";
  std::filesystem::remove_all(folder);
  EXPECT_FALSE(gpu::has_device_files(folder));
  std::filesystem::create_directories(folder / "dri" / "card0");
  std::filesystem::create_directories(folder / "nvme0");
  EXPECT_FALSE(gpu::has_device_files(folder));
  std::filesystem::create_directories(folder / "dri" / "renderD128");
  EXPECT_TRUE(gpu::has_device_files(folder));
  std::filesystem::remove_all(folder / "dri");
  std::filesystem::create_directories(folder / "nvidia0");
  EXPECT_TRUE(gpu::has_device_files(folder));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace insonify::auto_engine_test
