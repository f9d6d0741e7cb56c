// ping_batch.cpp -- many pings of one sonar as arrays with a leading axis.

#include "ping_batch.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "convert.h"
#include "ping_tables.h"

namespace insonify::python {
namespace {

// Arrays of the tables of many pings [ping, bin, beam], allocated by the first pings.
class Batch {
 public:
  explicit Batch(std::size_t count) : count_(count) {}

  void take(std::span<const Ping> pings, std::size_t first) {
    visit_tables([&](const char* name, auto member, const char*) {
      if (!(pings.front().*member).empty()) {
        put(name, pings, first, member);
      }
    });
    if (!pings.front().soundings.empty()) {
      put("soundings", pings, first, &Ping::soundings);
    }
  }
  [[nodiscard]] const py::dict& arrays() const { return arrays_; }

 private:
  template <typename Value>
  void put(const char* name, std::span<const Ping> pings, std::size_t first, std::vector<Value> Ping::*member) {
    const std::size_t size = (pings.front().*member).size();
    if (!arrays_.contains(name)) {
      arrays_[name] = py::array_t<Value>(shape_of<Value>(pings.front(), size));
    }
    Value* to = py::array_t<Value>(arrays_[name]).mutable_data() + first * size;
    for (const Ping& ping : pings) {
      to = std::copy((ping.*member).begin(), (ping.*member).end(), to);
    }
  }

  template <typename Value>
  [[nodiscard]] std::vector<py::ssize_t> shape_of(const Ping& ping, std::size_t size) const {
    if constexpr (std::is_same_v<Value, Sounding>) {
      return {static_cast<py::ssize_t>(count_), ping.beam_count};
    }
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(count_), ping.bin_count, ping.beam_count};
    const std::size_t cells = static_cast<std::size_t>(ping.bin_count) * static_cast<std::size_t>(ping.beam_count);
    if (size > cells) {
      shape.push_back(static_cast<py::ssize_t>(size / cells));
    }
    return shape;
  }

  std::size_t count_;
  py::dict arrays_;
};

// The poses of ping_batch() as a sequence with a length.
py::object pose_items(const py::object& poses) {
  constexpr const char* kExpected =
      " must be a list of poses, at least one, an array [n, 3], [n, 4, 4] or [n, 7], or a tuple of arrays [n, 3] and "
      "[n, 4]";
  const auto has_columns = [](const py::object& one, py::ssize_t columns) {
    return py::isinstance<py::array>(one) && one.cast<py::array>().ndim() == 2 &&
           one.cast<py::array>().shape(1) == columns;
  };
  py::object items = poses;
  if (py::isinstance<py::array>(poses)) {
    const auto array = poses.cast<py::array>();
    const bool fits = (array.ndim() == 3 && array.shape(1) == 4 && array.shape(2) == 4) || has_columns(poses, 3) ||
                      has_columns(poses, 7) || (array.ndim() == 1 && array.dtype().kind() == 'O');
    if (!fits) {
      throw Error("", "poses", fmt::format("{}, not one {}", kExpected, shown(poses.attr("shape"))));
    }
  } else if (py::isinstance<py::tuple>(poses) && py::len(poses) == 2 && has_columns(poses[py::int_(0)], 3) &&
             has_columns(poses[py::int_(1)], 4)) {
    const std::size_t positions = py::len(poses[py::int_(0)]), quaternions = py::len(poses[py::int_(1)]);
    if (positions != quaternions) {
      throw Error("", "poses", fmt::format(" has {} positions and {} quaternions", positions, quaternions));
    }
    items = py::module_::import("numpy").attr("hstack")(poses);
  } else if (py::isinstance<py::str>(poses) || py::isinstance<py::dict>(poses)) {
    throw Error("", "poses", kExpected);
  } else if (PySequence_Check(poses.ptr()) == 0) {
    if (!py::hasattr(poses, "__iter__")) {
      throw Error("", "poses", kExpected);
    }
    items = py::list(poses);  // A generator; it may raise errors of its own.
  }
  if (py::len(items) == 0) {
    throw Error("", "poses", kExpected);
  }
  return items;
}

// The same error with the index of its pose.
[[noreturn]] void throw_with_index(const Error& error, std::size_t index, bool is_request) {
  const std::string owner = fmt::format("poses[{}]", index);
  const std::string name = member_name(error.object(), error.field()), text = error.what();
  if (name.empty() || !text.starts_with(name)) {
    throw Error(owner + ": " + text);
  }
  const std::string rest = text.substr(name.size());
  const bool of_pose = name == "pose" || name.starts_with("world_from_vehicle");
  throw of_pose ? Error("", owner + (is_request ? ".pose" : ""),
                        name == "pose" ? rest : name.substr(name.find_last_of('.')) + rest)
                : Error(owner, name, rest);
}

}  // namespace

PythonSimulator::Asked asked_from(const py::object& pose) {
  if (py::isinstance<py::dict>(pose)) {
    return py::type::of<PythonSimulator::Asked>()(**py::dict(pose)).cast<PythonSimulator::Asked>();
  }
  return py::isinstance<PythonSimulator::Asked>(pose) ? pose.cast<PythonSimulator::Asked>()
                                                      : PythonSimulator::Asked{.pose = pose};
}

bool is_pose(py::handle given) {
  return py::isinstance<Pose>(given) || py::isinstance<PythonSimulator::Asked>(given) ||
         (!py::isinstance<py::str>(given) && py::hasattr(given, "__iter__"));
}

py::dict ping_batch(PythonSimulator& self, const py::object& sonar_, const py::object& given, const py::object& times,
                    const py::object& numbers) {
  const bool no_sonar = given.is_none() && is_pose(sonar_);
  const int sonar = no_sonar ? 0 : self.sonar(sonar_);
  const py::object poses = pose_items(no_sonar ? sonar_ : given);
  const auto check_count = [&](const py::object& values, const char* name, const char* kind) {
    if (!values.is_none() && (PySequence_Check(values.ptr()) == 0 || py::len(values) != py::len(poses))) {
      throw Error("", name, fmt::format(" must be a list of {} {}, one for each pose", py::len(poses), kind));
    }
  };
  check_count(times, "times", "numbers");
  check_count(numbers, "numbers", "whole numbers");
  std::vector<PingRequest> requests;
  for (std::size_t i = 0; i < py::len(poses); ++i) {
    const py::object pose = poses[py::int_(i)];
    PythonSimulator::Asked asked = asked_from(pose);
    if (!times.is_none()) {
      double time = 0;
      from_python(times[py::int_(i)], fmt::format("times[{}]", i), 1, time);
      asked.time = py::float_(time);
    }
    if (!numbers.is_none()) {
      std::uint64_t number = 0;
      from_python(numbers[py::int_(i)], fmt::format("numbers[{}]", i), 1, number);
      asked.number = py::int_(number);
    }
    if (asked.number.is_none() && !requests.empty()) {
      asked.number = py::int_(requests.back().number + 1);
    }
    try {
      requests.push_back(self.request(sonar, asked));
      requests.back().validate();
    } catch (const Error& error) {
      throw_with_index(error, i, py::isinstance<PythonSimulator::Asked>(pose));
    }
  }
  Batch made(requests.size());
  self.ping(
      sonar, requests.size(), [&](std::size_t i, PingRequest& request) { request = requests[i]; },
      [&](std::span<const Ping> pings, std::size_t first) { made.take(pings, first); });
  return made.arrays();
}

}  // namespace insonify::python
