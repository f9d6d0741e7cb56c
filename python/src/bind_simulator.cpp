// bind_simulator.cpp -- insonify.Simulator, and loading of scenarios.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "arguments.h"
#include "bind.h"
#include "bind_config.h"
#include "flown_line.h"
#include "held.h"
#include "insonify/files.h"
#include "ping_batch.h"
#include "python_simulator.h"

namespace insonify::python {
namespace {

// None, a list of names, or a dict of names and poses of the objects' frames.
std::vector<MovableObject> movable_from(const py::object& given) {
  std::vector<MovableObject> movable;
  if (given.is_none()) {
    return movable;
  }
  if (py::isinstance<py::str>(given) || PySequence_Check(given.ptr()) == 0) {
    if (!py::isinstance<py::dict>(given)) {
      throw Error("", "movable",
                  fmt::format(" = {} must be a list of names, or a dict of names and poses", shown(given)));
    }
  }
  const bool has_poses = py::isinstance<py::dict>(given);
  for (const py::handle& name : given) {
    MovableObject one;
    from_python(name, "movable", 1, one.name);
    if (has_poses) {
      one.world_from_object = pose_from(given[name], "movable[" + shown(name) + "]");
    }
    movable.push_back(std::move(one));
  }
  return movable;
}

// Texts "key=value" of a list of them or of a dict.
std::vector<std::string> settings_from(const py::object& given) {
  std::vector<std::string> texts;
  if (!py::isinstance<py::dict>(given)) {
    from_python(given, "settings", 1, texts);
    return texts;
  }
  for (const auto& [key, value] : py::dict(plain_value(given, "settings"))) {
    const bool is_text = py::isinstance<py::str>(value);
    const py::object text =
        is_text ? py::reinterpret_borrow<py::object>(value) : py::module_::import("json").attr("dumps")(value);
    texts.push_back(key.cast<std::string>() + "=" + text.cast<std::string>());
  }
  return texts;
}

// What a Simulator is made of: a Scenario, the path of one, a dict with the keys of files, or sonars.
Scenario scenario_from(const py::object& given, bool has_scene) {
  if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__")) {
    return unwrap<Scenario>(load_wrapped(given, py::tuple()), "scenario");
  }
  if (py::isinstance<py::dict>(given)) {
    py::dict keys = given.attr("copy")();
    if (has_scene && !keys.contains("world")) {
      keys["world"] = py::none();
    }
    return unwrap<Scenario>(scenario_from_dict(keys, py::str("")), "scenario");
  }
  if (py::isinstance<Held<Scenario>>(given)) {
    return unwrap<Scenario>(given, "scenario");
  }
  Scenario scenario;
  if (py::isinstance<Held<SonarConfig>>(given)) {
    scenario.sonars = {unwrap<SonarConfig>(given, "scenario")};
    return scenario;
  }
  throw Error(
      "", "scenario",
      fmt::format(" = {} must be a Scenario, the path of one, a dict of its keys or a SonarConfig", shown(given)));
}

Scene scene_from(const py::object& given, const Scenario& scenario) {
  if (py::isinstance<Scene>(given)) {
    return given.cast<Scene>();
  }
  if (py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__")) {
    return load_scene(path_from(given, "scene"), world_options(scenario), warnings_log());
  }
  throw Error("", "scene", fmt::format(" = {} must be a Scene, the path of one or None", shown(given)));
}

std::unique_ptr<PythonSimulator> make_simulator(const py::object& given, const py::object& scene,
                                                const py::object& threads_, const py::object& movable) {
  Scenario scenario = scenario_from(given, !scene.is_none());
  int threads = 0;
  from_python(threads_, "threads", 1, threads);
  Scene made;
  if (scene.is_none()) {
    made = load_scene(scenario, warnings_log());
  } else {
    made = scene_from(scene, scenario);
    Scenario elsewhere = scenario;  // Its file says nothing about this scene.
    elsewhere.places.clear();
    assign_scenario_materials(made, elsewhere, warnings_log());
  }
  const std::vector<MovableObject> objects = movable_from(movable);
  const Released released;
  return std::make_unique<PythonSimulator>(std::move(scenario), std::move(made), threads, objects);
}

std::shared_ptr<PythonPing> ping(PythonSimulator& self, const py::object& sonar_, const py::object& pose,
                                 const py::object& time, const py::object& number, const py::object& twist,
                                 const py::object& moved, const py::object& head_angle) {
  if (pose.is_none() && is_pose(sonar_)) {
    return ping(self, py::int_(0), sonar_, time, number, twist, moved, head_angle);
  }
  PythonSimulator::Asked asked = asked_from(pose);
  const auto set = [&](const char* name, py::object& member, const py::object& value) {
    if (!value.is_none() && !member.is_none()) {
      throw Error("", name, " is given twice: in the PingRequest and beside it");
    }
    if (!value.is_none()) {
      member = value;
    }
  };
  set("time", asked.time, time);
  set("number", asked.number, number);
  set("twist", asked.twist, twist);
  set("moved", asked.moved, moved);
  set("head_angle", asked.head_angle, head_angle);
  const int sonar = self.sonar(sonar_);
  return self.ping(sonar, self.request(sonar, asked));
}

void add_request(py::module_& module) {
  using Asked = PythonSimulator::Asked;
  py::class_<Asked>(module, "PingRequest",
                    "A request for a ping: the keywords of Simulator.ping() as an object to pass instead of a "
                    "pose.\n\nValues are checked when the ping is made.")
      .def(py::init([](const py::object& pose, const py::object& time, const py::object& number,
                       const py::object& twist, const py::object& moved,
                       const py::object& head_angle) { return Asked{pose, time, number, twist, moved, head_angle}; }),
           py::arg("pose") = py::none(), py::arg("time") = py::none(), py::arg("number") = py::none(), py::kw_only(),
           py::arg("twist") = py::none(), py::arg("moved") = py::none(), py::arg("head_angle") = py::none())
      .def(py::pickle(
          [](const Asked& self) {
            return py::make_tuple(self.pose, self.time, self.number, self.twist, self.moved, self.head_angle);
          },
          [](const py::tuple& state) { return Asked{state[0], state[1], state[2], state[3], state[4], state[5]}; }))
      .def_readwrite("pose", &Asked::pose, "Pose of the vehicle in the world; None: the scenario's.")
      .def_readwrite("time", &Asked::time, "Time of transmission [s].")
      .def_readwrite("number", &Asked::number, "Seeds random numbers, with the scenario's seed; the step of a head.")
      .def_readwrite("twist", &Asked::twist, "(linear [m/s], angular [rad/s]) in the world's frame.")
      .def_readwrite("moved", &Asked::moved, "Poses of movable objects by name or instance index.")
      .def_readwrite("head_angle", &Asked::head_angle, "Angle of a scanning head [rad].");
}

constexpr const char* kPingHelp = R"(Makes a ping. Returns a Ping; other threads of Python run meanwhile.

sonar: name or index; may be left out, for the first one: ping(pose).
pose: of the vehicle in the world: a position of three numbers, a 4 x 4 matrix, a pair (position, quaternion w x y z),
    these seven numbers in a row or a Pose; None: the scenario's trajectory. Or a PingRequest or the dict of one,
    instead of all other arguments.
time: of transmission [s]; None: number times the sonar's ping period.
number: seeds random numbers, with the scenario's seed, and is the step of a scanning head; None: the one after the last.
twist: pair (linear [m/s], angular [rad/s]) in the world's frame, for motion_in_ping; None: the trajectory's, or at rest
    if a pose is given.
moved: dict of poses of movable objects by name or instance index.
head_angle: of a scanning head [rad].

Raises Error for an invalid request; the simulator stays usable.)";

constexpr const char* kSimulatorHelp = R"(Runs the sonars of a scenario in a scene.

scenario: a Scenario; or the path of a scenario file, a dict with the keys of such a file, or a single SonarConfig.
scene: a Scene, or the path of one, instead of the scenario's world.
threads: 0: one per processor; pings do not depend on it.
movable: names of objects that `moved` may move, or a dict of the poses of their frames by name.

Simulators may be used from several threads; one simulator makes one ping at a time.)";

}  // namespace

py::object load_wrapped(const py::object& path, const py::object& settings) {
  return wrap(load_scenario(path_from(path, "path"), settings_from(settings), warnings_log()));
}

py::object parse_wrapped(const std::string& text, const py::object& folder, const py::object& settings) {
  return wrap(parse_scenario(text, path_from(folder, "folder"), settings_from(settings), warnings_log()));
}

py::object scenario_from_dict(const py::dict& dict, const py::object& folder) {
  // JSON is YAML, except that its words are in quotes: a world "none" would be a file of that name.
  py::dict rest = plain_value(dict, "");
  const bool no_world = rest.contains("world") &&
                        (py::object(rest["world"]).is_none() || py::object(rest["world"]).equal(py::str("none")));
  if (no_world) {
    rest.attr("pop")("world");
  }
  auto text = py::module_::import("json").attr("dumps")(rest).cast<std::string>();
  if (no_world) {
    text.insert(1, rest.empty() ? "\"world\": none" : "\"world\": none, ");
  }
  return parse_wrapped(text, folder, py::tuple());
}

void bind_simulator(py::module_& module) {
  add_request(module);
  py::class_<PythonSimulator> simulator(module, "Simulator", kSimulatorHelp);
  simulator
      .def(py::init(&make_simulator), py::arg("scenario"), py::arg("scene") = py::none(), py::arg("threads") = 0,
           py::arg("movable") = py::none())
      .def("ping", &ping, py::arg("sonar") = 0, py::arg("pose") = py::none(), py::arg("time") = py::none(),
           py::arg("number") = py::none(), py::kw_only(), py::arg("twist") = py::none(), py::arg("moved") = py::none(),
           py::arg("head_angle") = py::none(), kPingHelp)
      .def("ping_batch", &ping_batch, py::arg("sonar") = 0, py::arg("poses") = py::none(),
           py::arg("times") = py::none(), py::arg("numbers") = py::none(),
           "ping_batch(sonar=0, poses, times=None, numbers=None)\n\n"
           "Makes a ping at each of many poses. Returns a dict of arrays, as the tables of Ping, with a leading axis: "
           "\"intensity\" is [poses, bins, beams].\n\nsonar: name or index; may be left out: ping_batch(poses). poses: "
           "poses or PingRequests, in a list or a generator; or an array [n, 3] of positions; or one [n, 4, 4]; or one "
           "[n, 7] of positions and quaternions w x y z, as RecordedPings.world_from_sonar; or these two as a tuple of "
           "arrays [n, 3] and [n, 4]. times: n numbers [s]. numbers: n whole numbers, such as range(n), which seed "
           "random numbers: the same poses and numbers give the same pings; None: those after the last ping's.\n\n"
           "Threads make a ping each, "
           "unless something in the scene moves (a scenario's motions, a sea surface): then they share each ping. The "
           "pings are those of ping(), one after the other, byte for byte. Raises Error for the first invalid one, and "
           "KeyboardInterrupt within 64 pings of Control-C.")
      .def(
          "line", &fly_line, py::arg("sonar") = 0, py::arg("begin") = py::none(), py::arg("end") = py::none(),
          py::arg("speed") = py::none(), py::kw_only(), py::arg("number") = py::none(),
          "Flies a side-scan sonar along a line, a ping each ping_period. Returns a Line.\n\n"
          "sonar: name or index. begin, end: positions of the vehicle in the world [m], between which it flies "
          "straight, "
          "looking along the line, from time 0 until before it reaches the end; None: all pings of the scenario, along "
          "its trajectory or pattern. speed: from begin to end [m/s]; None: 1.5. number: of the first ping from begin "
          "to "
          "end, which seeds random numbers; None: the one after the last.\n\n"
          "The pings are those of ping(), byte for byte; beside the arrays of the Line no memory grows with their "
          "number. Raises Error for a sonar of another type than sss, and KeyboardInterrupt within 64 pings of "
          "Control-C.")
      .def("_time_ping",
           [](PythonSimulator& self, const py::object& sonar_, const py::object& pose, const py::object& number) {
             const int sonar = self.sonar(sonar_);
             const py::none none;
             return self.time_ping(sonar, self.request(sonar, {pose, none, number, none, none, none}));
           })
      .def(
          "sonar",
          [](const PythonSimulator& self, const py::object& sonar) {
            return wrap(self.known().facts[self.sonar(sonar)]->sonar, kSimulatorsSonar);
          },
          py::arg("sonar") = 0,
          "Settings of a sonar, with sound speed and ping period filled in. They cannot be changed: pass a changed "
          "copy() to set_sonar().")
      .def(
          "set_sonar",
          [](PythonSimulator& self, const py::object& sonar, const py::object& config, const py::kwargs& changes) {
            const int index = self.sonar(sonar);
            const bool is_dict = py::isinstance<py::dict>(config);
            const bool of_preset = is_dict && config.contains("preset");
            const auto given = [&] {
              const py::object base = (config.is_none() || is_dict) && !of_preset
                                          ? wrap(self.known().facts[index]->sonar)
                                          : py::object(config);
              auto changed = wrap(unwrap<SonarConfig>(base, "config"));
              set_fields(changed, is_dict && !of_preset ? py::dict(config) : py::dict());
              set_fields(changed, changes);
              return unwrap<SonarConfig>(changed, "config");
            }();
            const std::string& own = self.known().facts[index]->sonar.name;
            if (given.name != own && given.name != SonarConfig().name) {  // The default's: none was given.
              throw Error("config", "name", fmt::format(" = {} cannot be set: the sonar stays {}", given.name, own));
            }
            self.set_sonar(index, given);
          },
          py::arg("sonar") = 0, py::arg("config") = py::none(),
          "set_sonar(sonar=0, config=None, **changes)\n\n"
          "Changes range, gain, beams or all of a sonar but its name, from the next ping on.\n\n"
          "config: its settings, a SonarConfig; or a dict of those that change; None: as they are. Keywords change "
          "more: set_sonar(\"fls\", max_range=3). Bins, ping period and pulse that followed from the range follow it. "
          "Raises Error for a name that is another one, unless it is the default's.")
      .def(
          "add",
          [](PythonSimulator& self, const Scene& objects, const py::object& movable) {
            return self.add_objects(objects, movable_from(movable));
          },
          py::arg("objects"), py::arg("movable") = py::none(),
          "Adds the instances of a Scene. Returns the index of the first of them, which may be that of a removed one. "
          "Raises Error for a name that is there.")
      .def("remove", &PythonSimulator::remove_object, py::arg("name"), "Removes an object with all its parts.")
      .def_property_readonly(
          "scenario", [](const PythonSimulator& self) { return wrap(self.known().scenario, kSimulatorsScenario); },
          "A copy of the scenario, which cannot be changed: pass a changed copy() of a sonar to set_sonar(), of the "
          "scenario to a new Simulator.")
      .def_property_readonly(
          "scene", [](PythonSimulator& self) { return SimulatorsScene{self.scene()}; },
          "A copy of the scene, which takes no more objects: Simulator.add() and remove() change the simulator's.")
      .def_property_readonly(
          "instance_names", [](const PythonSimulator& self) { return self.known().names->instances; },
          "Names by index in Ping.instance, of pings made now; \"\" where an object was removed, whose index add() may "
          "give to another. Ping.instance_names has those of a ping.")
      .def_property_readonly(
          "material_names", [](const PythonSimulator& self) { return self.known().names->materials; },
          "Names by index in Ping.material.");
}

}  // namespace insonify::python
