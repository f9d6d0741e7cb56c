// python_simulator.h -- a simulator that threads of Python may share, and that counts its pings.

#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "bind.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"

namespace insonify::python {

namespace py = pybind11;

class PythonSimulator {
 public:
  PythonSimulator(Scenario scenario, Scene scene, int threads, const std::vector<MovableObject>& movable);

  /// Index of a sonar by index or name.  @throws Error listing the names.
  [[nodiscard]] int sonar(const py::object& sonar) const;

  /// What ping() was asked for; None where the scenario says it.
  struct Asked {
    py::object pose, time, number, twist, moved, head_angle;
  };

  /// The request of the next ping, or of the one asked for.
  [[nodiscard]] PingRequest request(int sonar, const Asked& asked);

  /// Makes a ping, without the interpreter's lock; one at a time.
  [[nodiscard]] std::shared_ptr<PythonPing> ping(int sonar, const PingRequest& request);
  void ping(int sonar, const std::vector<PingRequest>& requests, std::vector<Ping>& pings);

  void set_sonar(int sonar, const SonarConfig& config);
  int add_objects(Scene objects, const std::vector<MovableObject>& movable);
  void remove_object(const std::string& name);

  [[nodiscard]] const Simulator& simulator() const { return simulator_; }

 private:
  template <typename Action>
  auto locked(const Action& action) {
    const py::gil_scoped_release released;
    const std::lock_guard<std::mutex> lock(mutex_);
    return action();
  }

  void note_facts();

  Simulator simulator_;
  std::vector<std::shared_ptr<const SonarFacts>> facts_;  // Of each sonar.
  std::unique_ptr<ScenarioRequests> requests_;
  std::vector<std::uint64_t> next_;  // Number of each sonar's next ping.
  std::mutex mutex_;
};

}  // namespace insonify::python
