// python_simulator.cpp -- turns Python arguments into requests, and makes pings without the interpreter's lock.

#include "python_simulator.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "convert.h"

namespace insonify::python {
namespace {

Twist twist_from(py::handle value) {
  if (PySequence_Check(value.ptr()) == 0 || py::len(value) != 2) {
    throw Error("", "twist", fmt::format(" = {} must be a pair: (linear [m/s], angular [rad/s])", shown(value)));
  }
  const auto pair = py::reinterpret_borrow<py::sequence>(value);
  Twist twist;
  from_python(pair[0], "twist[0]", 1, twist.linear);
  from_python(pair[1], "twist[1]", 1, twist.angular);
  return twist;
}

// {"rock": pose, 3: pose}: by name or by instance.
std::vector<MovedObject> moved_from(py::handle value) {
  if (!py::isinstance<py::dict>(value)) {
    throw Error("", "moved",
                fmt::format(" = {} must be a dict of names, or indices of instances, and poses", shown(value)));
  }
  std::vector<MovedObject> moved;
  for (const auto& [key, pose] : py::reinterpret_borrow<py::dict>(value)) {
    MovedObject one{.world_from_object = pose_from(pose, "moved[" + shown(key) + "]")};
    if (py::isinstance<py::str>(key)) {
      one.name = key.cast<std::string>();
    } else {
      from_python(key, "moved", 1, one.instance);
    }
    moved.push_back(std::move(one));
  }
  return moved;
}

}  // namespace

PythonSimulator::PythonSimulator(Scenario scenario, Scene scene, int threads, const std::vector<MovableObject>& movable)
    : simulator_(std::move(scenario), std::move(scene), threads, movable, warnings_log()),
      known_(look()),
      next_(known_->facts.size(), 0) {
  simulator_.stop_when(&stop_at_end());
  make_pools();
}

void PythonSimulator::make_pools() {
  pools_.clear();
  for (std::size_t i = 0; i < known_->facts.size(); ++i) {
    pools_.push_back(std::make_shared<PingPool>());
  }
}

std::shared_ptr<const PythonSimulator::Known> PythonSimulator::look() {
  const Scenario& scenario = simulator_.scenario();
  auto names = std::make_shared<LabelNames>();
  for (const Instance& instance : simulator_.scene().instances) {
    names->instances.push_back(instance.present ? instance.name : "");
  }
  for (const Material& material : simulator_.scene().materials) {
    names->materials.push_back(material.name);
  }
  facts_.clear();
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig& sonar = simulator_.sonar(static_cast<int>(i));
    facts_.push_back(
        std::make_shared<SonarFacts>(SonarFacts{sonar, scenario.model, scenario.receiver_of(sonar), names}));
  }
  return std::make_shared<Known>(Known{scenario, ScenarioRequests(scenario), facts_, std::move(names)});
}

int PythonSimulator::sonar(const py::object& sonar) const {
  const std::vector<SonarConfig>& sonars = known_->scenario.sonars;
  std::vector<std::string> names;
  if (py::isinstance<py::str>(sonar)) {
    for (std::size_t i = 0; i < sonars.size(); ++i) {
      if (sonar.cast<std::string>() == sonars[i].name) {
        return static_cast<int>(i);
      }
      names.push_back(sonars[i].name);
    }
    throw Error("", "sonar", fmt::format(" = {} does not exist; available: {}", shown(sonar), fmt::join(names, ", ")));
  }
  int index = 0;
  from_python(sonar, "sonar", 1, index);
  if (index < 0 || index >= static_cast<int>(sonars.size())) {
    throw Error("", "sonar", fmt::format(" = {} must be from 0 to {}", index, sonars.size() - 1));
  }
  return index;
}

namespace {

// Reserves ping numbers before the pings are made, so that other threads get others; returns them on failure.
// Constructed and destroyed with the interpreter's lock held.
class TakenNumbers {
 public:
  TakenNumbers(std::uint64_t& next, std::uint64_t end) : next_(next), before_(std::exchange(next, end)), end_(end) {}
  ~TakenNumbers() {
    if (std::uncaught_exceptions() > exceptions_ && next_ == end_) {
      next_ = before_;
    }
  }
  TakenNumbers(const TakenNumbers&) = delete;
  TakenNumbers& operator=(const TakenNumbers&) = delete;

 private:
  std::uint64_t& next_;
  std::uint64_t before_, end_;
  int exceptions_ = std::uncaught_exceptions();
};

}  // namespace

PingRequest PythonSimulator::request(int sonar, const Asked& asked) {
  std::uint64_t number = next_[sonar];
  if (!asked.number.is_none()) {
    from_python(asked.number, "number", 1, number);
  }
  double time = 0;
  if (!asked.time.is_none()) {
    from_python(asked.time, "time", 1, time);
  }
  const ScenarioRequests& requests = known_->requests;
  PingRequest request = asked.time.is_none() ? requests.at(sonar, number) : requests.at(sonar, number, time);
  if (!asked.pose.is_none()) {
    request.world_from_vehicle = pose_from(asked.pose, "pose");
    request.twist = {};
  }
  if (!asked.twist.is_none()) {
    request.twist = twist_from(asked.twist);
  }
  if (!asked.moved.is_none()) {
    for (MovedObject& one : moved_from(asked.moved)) {
      request.moved.push_back(std::move(one));
    }
  }
  if (!asked.head_angle.is_none()) {
    request.head_angle.emplace();
    from_python(asked.head_angle, "head_angle", 1, *request.head_angle);
  }
  return request;
}

std::shared_ptr<PythonPing> PythonSimulator::ping(int sonar, const PingRequest& request) {
  std::shared_ptr<PythonPing> ping = pools_[sonar]->take();
  const TakenNumbers taken(next_[sonar], request.number + 1);
  locked([&] {
    simulator_.ping(sonar, request, *ping);
    ping->facts = facts_[sonar];
  });
  return ping;
}

std::shared_ptr<const SonarFacts> PythonSimulator::ping(int sonar, std::size_t count, const FillRequest& fill,
                                                        const Take& take) {
  // Enough to balance the load of the threads, few enough to stop soon and to fit in memory.
  constexpr std::size_t kAtOnce = 64;
  PingRequest last;
  fill(count - 1, last);
  const TakenNumbers taken(next_[sonar], last.number + 1);
  return locked([&] {
    std::vector<Ping> pings(std::min(kAtOnce, count));
    std::vector<PingRequest> requests(pings.size());
    for (std::size_t first = 0; first < count; first += kAtOnce) {
      const std::size_t block = std::min(kAtOnce, count - first);
      for (std::size_t i = 0; i < block; ++i) {
        fill(first + i, requests[i]);
      }
      simulator_.ping(sonar, std::span(requests).first(block), std::span(pings).first(block));
      const Locked locked;
      take(std::span(pings).first(block), first);
      if (PyErr_CheckSignals() != 0) {  // Control-C.
        throw py::error_already_set();
      }
    }
    return facts_[sonar];
  });
}

double PythonSimulator::time_ping(int sonar, const PingRequest& request) {
  return locked([&] {
    const auto start = std::chrono::steady_clock::now();
    simulator_.ping(sonar, request, timed_);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  });
}

void PythonSimulator::set_sonar(int sonar, const SonarConfig& config) {
  known_ = locked([&] {
    simulator_.set_sonar(sonar, config);
    return look();
  });
  make_pools();
}

int PythonSimulator::add_objects(Scene objects, const std::vector<MovableObject>& movable) {
  int first = 0;
  known_ = locked([&] {
    assign_materials(objects, simulator_.scenario().materials);
    first = simulator_.add_objects(objects, movable);
    return look();
  });
  return first;
}

void PythonSimulator::remove_object(const std::string& name) {
  known_ = locked([&] {
    simulator_.remove_object(name);
    return look();
  });
}

Scene PythonSimulator::scene() {
  return locked([&] { return simulator_.scene(); });
}

std::unique_ptr<Recording> PythonSimulator::recording(const std::filesystem::path& path, int sonar,
                                                      const RecordingOptions& options) {
  return locked([&] {
    return std::make_unique<Recording>(path, simulator_.scenario(), simulator_.scene(), simulator_.sonar(sonar),
                                       options);
  });
}

}  // namespace insonify::python
