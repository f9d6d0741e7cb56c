// flown_line.cpp -- requests of the pings of a line, and their arrays, filled block by block.

#include "flown_line.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "convert.h"
#include "insonify/survey/bottom_track.h"

namespace insonify::python {
namespace {

constexpr double kUsualSpeed = 1.5;  // As that of a pattern's lines [m/s].

Vec3 place_from(const py::object& given, const char* name) {
  Vec3 place = Vec3::Zero();
  from_python(given, name, 1, place);
  check_member("", Field{name, "m", coordinate(), ""}, place);
  return place;
}

// The scenario with a straight flight in place of its trajectory, until the vehicle is at the end.
Scenario straight(Scenario scenario, const Vec3& begin, const Vec3& end, double speed) {
  const Vec3 way = end - begin;
  if (!(way.norm() > 0)) {
    throw Error("", "end", " of a line must differ from its begin");
  }
  const Vec3 rpy(0, -std::atan2(way.z(), way.head<2>().norm()), std::atan2(way.y(), way.x()));
  scenario.trajectory.waypoints = {{0, begin, rpy}, {way.norm() / speed, end, rpy}};
  scenario.duration = way.norm() / speed;
  scenario.ping_spans.clear();
  return scenario;
}

ScenarioRequests requests_of(const PythonSimulator& self, const py::object& begin, const py::object& end,
                             const py::object& speed, const py::object& number) {
  if (begin.is_none() != end.is_none()) {
    throw Error("", begin.is_none() ? "begin" : "end", " of the line is missing");
  }
  const PythonSimulator::Known& known = self.known();
  if (begin.is_none()) {
    if (!speed.is_none() || !number.is_none()) {
      throw Error("", speed.is_none() ? "number" : "speed",
                  " is that of a line from begin to end; the scenario's pings have their own");
    }
    if (known.scenario.trajectory.waypoints.size() < 2) {
      throw Error("", "begin", " and end of the line are missing: the scenario has no trajectory or pattern");
    }
    return known.requests;
  }
  double metres_per_second = kUsualSpeed;
  if (!speed.is_none()) {
    from_python(speed, "speed", 1, metres_per_second);
    check_field("", {"speed", "m/s", above_to(0, 50), ""}, metres_per_second);
  }
  return ScenarioRequests(
      straight(known.scenario, place_from(begin, "begin"), place_from(end, "end"), metres_per_second));
}

void add_pings(FlownLine& line, const SonarConfig& sonar, std::span<const Ping> pings, std::size_t first,
               std::size_t count) {
  const std::size_t size = pings.front().intensity.size();
  if (line.intensity.size() == 0) {
    line.intensity = py::array_t<float>(
        std::vector<py::ssize_t>{static_cast<py::ssize_t>(count), pings.front().bin_count, pings.front().beam_count});
  }
  float* to = line.intensity.mutable_data() + first * size;
  for (const Ping& ping : pings) {
    to = std::ranges::copy(ping.intensity, to).out;
    line.soundings.insert(line.soundings.end(), ping.soundings.begin(), ping.soundings.end());
    line.time.push_back(ping.time);
    line.poses.push_back(ping.world_from_sonar);
    line.altitude.push_back(altitude_by_truth(ping, sonar).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
}

}  // namespace

std::shared_ptr<FlownLine> fly_line(PythonSimulator& self, const py::object& sonar_, const py::object& begin,
                                    const py::object& end, const py::object& speed, const py::object& number) {
  const int sonar = self.sonar(sonar_);
  const SonarConfig config = self.known().facts[sonar]->sonar;
  if (!config.is_side_scan() && !config.is_multibeam()) {
    throw Error("", "sonar",
                fmt::format(" = {} is neither a side-scan sonar (type: sss) nor a multibeam (mbes); ping_batch() takes "
                            "any",
                            config.name));
  }
  const ScenarioRequests requests = requests_of(self, begin, end, speed, number);
  auto line = std::make_shared<FlownLine>();
  line->first_number = begin.is_none() ? 0 : self.request(sonar, {.number = number}).number;
  const std::size_t count = requests.ping_count(sonar);
  line->facts = self.ping(
      sonar, count,
      [&](std::size_t i, PingRequest& request) {
        requests.fill(sonar, i, request);
        request.number = line->first_number + i;
      },
      [&](std::span<const Ping> pings, std::size_t at) { add_pings(*line, config, pings, at, count); });
  return line;
}

}  // namespace insonify::python
