// python_simulator.h -- a simulator that Python threads may share, and that counts its pings.

#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "bind.h"
#include "insonify/files.h"
#include "insonify/scenario_requests.h"
#include "insonify/simulator.h"
#include "interpreter_lock.h"

namespace insonify::python {

namespace py = pybind11;

/// A pool of one sonar's pings that Python has released, whose memory the next ones reuse. Allocating a ping's tables
/// takes as long as computing a small ping. A ping returns to the pool when neither Python nor an array refers to it.
class PingPool : public std::enable_shared_from_this<PingPool> {
 public:
  [[nodiscard]] std::shared_ptr<PythonPing> take() {
    std::unique_ptr<PythonPing> ping;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!unused_.empty()) {
        ping = std::move(unused_.back());
        unused_.pop_back();
      }
    }
    if (ping == nullptr) {
      ping = std::make_unique<PythonPing>();
    }
    const auto give_back = [pool = weak_from_this()](PythonPing* used) {
      std::unique_ptr<PythonPing> own(used);
      if (const std::shared_ptr<PingPool> there = pool.lock()) {
        there->keep(std::move(own));
      }
    };
    return {ping.release(), give_back};
  }

 private:
  void keep(std::unique_ptr<PythonPing> ping) {
    constexpr std::size_t kMost = 2;  // A loop holds the last ping while it makes the next.
    const std::lock_guard<std::mutex> lock(mutex_);
    if (unused_.size() < kMost) {
      unused_.push_back(std::move(ping));
    }
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<PythonPing>> unused_;
};

class PythonSimulator {
 public:
  PythonSimulator(Scenario scenario, Scene scene, int threads, const std::vector<MovableObject>& movable);

  /// Index of a sonar by index or name.  @throws Error listing the names.
  [[nodiscard]] int sonar(const py::object& sonar) const;

  /// The arguments of ping(), a Python PingRequest; None: as in the scenario.
  struct Asked {
    py::object pose = py::none(), time = py::none(), number = py::none(), twist = py::none(), moved = py::none(),
               head_angle = py::none();
  };

  /// The request of the next ping, or of the requested one.
  [[nodiscard]] PingRequest request(int sonar, const Asked& asked);

  /// Makes a ping, without the interpreter's lock; one at a time.
  [[nodiscard]] std::shared_ptr<PythonPing> ping(int sonar, const PingRequest& request);

  /// Makes many in blocks: fills the request of each, without the interpreter's lock, and calls take(pings, index of
  /// the first of them) with it.
  /// @return  Facts of all of them.
  using FillRequest = std::function<void(std::size_t index, PingRequest& request)>;
  using Take = std::function<void(std::span<const Ping> pings, std::size_t first)>;
  std::shared_ptr<const SonarFacts> ping(int sonar, std::size_t count, const FillRequest& fill, const Take& take);

  /// Time of a ping in a C++ program that reuses its Ping [s]: to measure Python's overhead.
  [[nodiscard]] double time_ping(int sonar, const PingRequest& request);

  void set_sonar(int sonar, const SonarConfig& config);
  int add_objects(Scene objects, const std::vector<MovableObject>& movable);
  void remove_object(const std::string& name);

  [[nodiscard]] Scene scene();
  [[nodiscard]] std::unique_ptr<Recording> recording(const std::filesystem::path& path, int sonar,
                                                     const RecordingOptions& options);

  /// Properties that Python reads without waiting for a ping. Replaced as a whole by each change.
  struct Known {
    Scenario scenario;
    ScenarioRequests requests;
    std::vector<std::shared_ptr<const SonarFacts>> facts;  ///< [sonar]
    std::shared_ptr<const LabelNames> names;
  };
  [[nodiscard]] const Known& known() const { return *known_; }

 private:
  // Calls action() without the interpreter's lock, while no other thread uses the simulator. It must not touch Python.
  template <typename Action>
  auto locked(const Action& action) {
    const Released released;
    const std::lock_guard<std::mutex> lock(mutex_);
    return action();
  }

  // Sets facts_ and returns the current properties.
  [[nodiscard]] std::shared_ptr<const Known> look();

  // With mutex_.
  Simulator simulator_;
  std::vector<std::shared_ptr<const SonarFacts>> facts_;  // [sonar] Settings of its next ping.
  Ping timed_;
  std::mutex mutex_;

  // With the interpreter's lock.
  std::shared_ptr<const Known> known_;
  std::vector<std::uint64_t> next_;               // [sonar] Number of its next ping.
  std::vector<std::shared_ptr<PingPool>> pools_;  // [sonar] Cleared when the shapes of the tables may change.
  void make_pools();
};

}  // namespace insonify::python
