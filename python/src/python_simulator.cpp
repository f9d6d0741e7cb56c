// python_simulator.cpp -- from arguments of Python to requests, and pings without the interpreter's lock.

#include "python_simulator.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

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
    : simulator_(std::move(scenario), std::move(scene), threads, movable),
      requests_(std::make_unique<ScenarioRequests>(simulator_.scenario())),
      next_(simulator_.scenario().sonars.size(), 0) {
  note_facts();
}

void PythonSimulator::note_facts() {
  const Scenario& scenario = simulator_.scenario();
  facts_.clear();
  for (std::size_t i = 0; i < scenario.sonars.size(); ++i) {
    const SonarConfig& sonar = simulator_.sonar(static_cast<int>(i));
    facts_.push_back(std::make_shared<SonarFacts>(SonarFacts{sonar, scenario.model, scenario.receiver_of(sonar)}));
  }
}

int PythonSimulator::sonar(const py::object& sonar) const {
  const std::vector<SonarConfig>& sonars = simulator_.scenario().sonars;
  std::vector<std::string> names;
  if (py::isinstance<py::str>(sonar)) {
    for (std::size_t i = 0; i < sonars.size(); ++i) {
      if (sonar.cast<std::string>() == sonars[i].name) {
        return static_cast<int>(i);
      }
      names.push_back(sonars[i].name);
    }
    throw Error("", "sonar", fmt::format(" = {} is not there; there are {}", shown(sonar), fmt::join(names, ", ")));
  }
  int index = 0;
  from_python(sonar, "sonar", 1, index);
  if (index < 0 || index >= static_cast<int>(sonars.size())) {
    throw Error("", "sonar", fmt::format(" = {} must be from 0 to {}", index, sonars.size() - 1));
  }
  return index;
}

PingRequest PythonSimulator::request(int sonar, const Asked& asked) {
  std::uint64_t number = next_[sonar];
  if (!asked.number.is_none()) {
    from_python(asked.number, "number", 1, number);
  }
  PingRequest request = requests_->at(sonar, number);
  if (!asked.time.is_none()) {
    from_python(asked.time, "time", 1, request.time);
    const Scenario& scenario = simulator_.scenario();
    if (std::isfinite(request.time)) {
      request.world_from_vehicle = scenario.trajectory.at(request.time);
      for (std::size_t i = 0; i < scenario.motions.size(); ++i) {
        request.moved[i].world_from_object = scenario.motions[i].trajectory.at(request.time);
      }
    }
  }
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
  auto ping = std::make_shared<PythonPing>();
  locked([&] { simulator_.ping(sonar, request, *ping); });
  next_[sonar] = request.number + 1;
  ping->facts = facts_[sonar];
  return ping;
}

void PythonSimulator::ping(int sonar, const std::vector<PingRequest>& requests, std::vector<Ping>& pings) {
  locked([&] { simulator_.ping(sonar, requests, pings); });
  next_[sonar] = requests.empty() ? next_[sonar] : requests.back().number + 1;
}

void PythonSimulator::set_sonar(int sonar, const SonarConfig& config) {
  locked([&] {
    simulator_.set_sonar(sonar, config);
    requests_ = std::make_unique<ScenarioRequests>(simulator_.scenario());
    note_facts();
  });
}

int PythonSimulator::add_objects(Scene objects, const std::vector<MovableObject>& movable) {
  return locked([&] {
    assign_materials(objects, simulator_.scenario().materials);
    return simulator_.add_objects(objects, movable);
  });
}

void PythonSimulator::remove_object(const std::string& name) {
  locked([&] { simulator_.remove_object(name); });
}

}  // namespace insonify::python
