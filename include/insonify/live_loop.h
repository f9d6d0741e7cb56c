// live_loop.h -- makes a scenario's pings interactively: pause, steering, changed settings, recording.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "insonify/log.h"
#include "insonify/messages.h"
#include "insonify/ping.h"
#include "insonify/ping_request.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// What a LiveLoop simulates until the next change of it.
struct LiveWorld {
  std::uint64_t change = 0;         ///< Counts the changes; pings carry it too.
  Scenario scenario;                ///< As pings are made from it, `trajectory` included; sonars as given.
  Trajectory trajectory;            ///< The scenario's own, before shifts and steering.
  Scene scene;                      ///< With the sea's surface.
  std::vector<SonarConfig> sonars;  ///< With everything filled in.
};

/// Where one instance is at a ping, of those that move.
struct MovedInstance {
  int instance = 0;  ///< Index into the scene's instances.
  Pose world_from_mesh;
};

/// A sonar that something else than the vehicle carries, such as a link of another model.
struct CarriedSonar {
  std::string sonar;        ///< Its name.
  Pose world_from_carrier;  ///< Takes the place of the vehicle's pose.
  Twist twist = {};
};

/// Where a vehicle is that another program moves, and what else it has moved.
struct LiveDrive {
  Pose world_from_vehicle;
  Twist twist = {};                     ///< Has an effect with Scenario::motion_in_ping.
  std::vector<MovedObject> moved = {};  ///< In order, as PingRequest::moved.
  double stamp = 0;                     ///< When it was there, by the clock of that program [s].
  std::vector<CarriedSonar> carried = {};
};

/// Objects that come to a world and go from it while pings are made.
struct LiveObjects {
  std::vector<std::string> removed = {};  ///< Full names of instances that change_objects() has added before.
  Scene added = {};  ///< As load_scene() returns it: materials are assigned by the scenario's rules. drive() can move
                     ///< instances marked `moving`, by their full names.
};

/// One ping of a LiveLoop.
struct LivePing {
  std::shared_ptr<const LiveWorld> world;  ///< Never null.
  int sonar = 0;
  Ping ping;
  Pose world_from_vehicle;
  std::vector<MovedInstance> moved;
  double computing_time = 0;  ///< [s]
  double made_at = 0;         ///< Unix time at which it was done [s].
  double stamp = 0;           ///< Stamp of the LiveDrive that it was made from [s], 0 for none ...
  double told_at = 0;         ///< ... and the Unix time at which drive() was called [s].
  double clock = 0;           ///< Time told by advance() when it was transmitted [s], 0 without.
};

/// Files of a recording that has ended, and what they hold.
struct LiveRecording {
  std::vector<std::filesystem::path> files;  ///< One, or one a sonar. Without a ping none was kept.
  std::filesystem::path scenario;            ///< Repeats the pings.
  std::uint64_t pings = 0;                   ///< In all files.
  std::uintmax_t bytes = 0;                  ///< Size of all `files` together [bytes].
};

/// Files that LiveLoop::record() writes: the recordings, and last the scenario that repeats them.
[[nodiscard]] std::vector<std::filesystem::path> live_recording_files(const std::filesystem::path& path,
                                                                      std::span<const SonarConfig> sonars);

/// Receives what a LiveLoop makes, in threads of its own: each function must return soon, and may be called while
/// another one runs.
class LiveListener {
 public:
  virtual ~LiveListener() = default;
  virtual void on_ping(const std::shared_ptr<const LivePing>& ping) = 0;
  /// Called before the first ping of a world.
  virtual void on_world(const std::shared_ptr<const LiveWorld>& world) = 0;
  /// A line to show, such as a warning of a setting or why the vehicle stopped.
  virtual void on_note(const std::string& text) = 0;
  /// Called when the files of a recording are closed, whole or not.
  virtual void on_recorded(const LiveRecording& /*recording*/) {}
};

/// How a LiveLoop stands.
struct LiveState {
  bool paused = false;
  bool follows = true;               ///< Whether the vehicle is on the scenario's trajectory; else it is steered.
  double speed = 1;                  ///< Seconds of the scenario in a second, where the machine keeps up.
  std::string recording;             ///< File or files being written, "" for none.
  std::uint64_t recorded_pings = 0;  ///< In them.
  std::string recording_error;       ///< Why a recording is not whole, "" where none failed.
  std::uint64_t pings_made = 0;      ///< Since the start of the loop.
  std::uint64_t pings_since_change = 0;
  double time = 0;         ///< Time of the next ping since the last change [s].
  bool preparing = false;  ///< Whether a change is being prepared while pings of the state before go on.
};

struct LiveOptions {
  int threads = 0;  ///< Threads of the simulator; 0 for as many as there are processors.
  std::optional<double> rate_limit =
      {};                 ///< Most pings a second of each sonar [Hz], above 0; time passes more slowly then.
  bool paused = false;    ///< Whether it starts paused.
  bool driven = false;    ///< Whether another program moves the vehicle: see LiveLoop::drive().
  bool clocked = false;   ///< Whether another program tells the time: see LiveLoop::advance().
  bool followed = false;  ///< Whether another program gives the world, by LiveLoop::change_objects(): the scenario's
                          ///< own is not read, and `materials` may name what is not there.
  MessageOptions messages = {};  ///< How MCAP recordings tell pings.
};

/// Velocities of a steered vehicle in its own axes: x ahead, y to port, z up.
struct LiveVelocity {
  Vec3 linear = Vec3::Zero();   ///< Surge, sway and heave [m/s], each within 50.
  Vec3 angular = Vec3::Zero();  ///< About x, y and z [rad/s], each within 90 deg/s.

  template <typename Self, typename Visit>
  static void visit_fields(Self& self, Visit&& visit) {
    visit(Field{"linear", "m/s", from_to(-50, 50), "Surge, sway and heave."}, self.linear);
    visit(Field{"angular", "rad", from_to(-radians_from_degrees(90), radians_from_degrees(90)),
                "Rates of roll, pitch and yaw."},
          self.angular);
  }
};

/// Simulates a scenario in a thread of its own, in real time where the machine keeps up.
///
/// Every sonar pings at its own period: ping n of a sonar is at time n times its period, as `insonify run` has it, and
/// the vehicle follows the scenario's trajectory until it is steered or placed. Where computing takes longer than the
/// period, time passes more slowly; no ping is left out.
///
/// A change starts anew, at ping 0 and time 0: of a setting, a material, of who steers, a placement, and the start of a
/// recording. Changes that take long are prepared while pings of the state before go on. saved_scenario() gives the
/// scenario since then, with the path flown, and `insonify run` of it makes the same pings.
///
/// All functions may be called from any thread.
class LiveLoop {
 public:
  /// Called once, with "" or the reason why a request could not be done, from any thread; then nothing has changed.
  using Done = std::function<void(const std::string& error)>;

  /// Reads scenario and world.
  /// @param settings  As of load_scenario().
  /// @throws Error for wrong input.
  LiveLoop(const std::filesystem::path& scenario, std::span<const std::string> settings = {},
           const LiveOptions& options = {}, const Log& log = {});
  /// Ends the loop.
  ~LiveLoop();
  LiveLoop(const LiveLoop&) = delete;
  LiveLoop& operator=(const LiveLoop&) = delete;

  /// Begins to make pings; once.
  /// @param listener  Must live until end().
  void start(LiveListener& listener);

  /// Stops within some beams' time and closes a recording. Nothing is told to the listener after it. Requests that
  /// were not done are answered with "the simulation ends".
  /// @throws Error where a recording could not be put on the disk, now or before.
  void end();

  [[nodiscard]] std::shared_ptr<const LiveWorld> world() const;
  [[nodiscard]] LiveState state() const;

  void pause(bool on);
  /// Makes the next ping of a paused loop, of all sonars that ping then.
  void step();
  /// @throws Error unless the factor is from 0.01 to 100.
  void set_speed(double factor);

  /// Steers the vehicle until the next call. The first velocity that is not 0 takes it off the trajectory.
  /// @throws Error for a velocity out of its limits.
  void fly(const LiveVelocity& velocity);
  /// Puts the vehicle somewhere and takes it off the trajectory.
  /// @throws Error for a pose out of PingRequest's limits.
  void place(const Pose& world_from_vehicle, Done done = {});
  /// Takes the vehicle back to the start of the trajectory, or off it.
  void follow(bool on, Done done = {});

  /// Removes objects, then adds others, before the next ping; numbers of pings and time go on. What is added stays when
  /// settings change. While a recording is made, a further file of it begins, and the run with it. saved_scenario() has
  /// none of these objects.
  /// An object that cannot be added, for its material is not known, is told to the listener and left out.
  /// @throws Error for a name to be removed that is not there, and one to be added that is; nothing has changed then.
  void change_objects(LiveObjects change);

  /// With LiveOptions::driven: where the vehicle is from now on. There is no ping before the first call; of several
  /// calls between two pings the last counts. Where a sonar cannot ping from there, the listener is told why and no
  /// ping is made until the next call. fly() has no effect then, place() and follow() are refused. saved_scenario() has
  /// a waypoint at each ping, to a micrometre; it has none of `twist`, `moved` and `carried`.
  /// With LiveOptions::followed, objects in `moved` that are not there are passed over.
  /// @throws Error for what PingRequest refuses, and without LiveOptions::driven.
  void drive(LiveDrive drive);

  /// With LiveOptions::clocked: the time by the clock of another program [s]. A ping is due when as much time has
  /// passed by that clock as since the ping before in the scenario; of those that are more than a period late only the
  /// last is made. A clock that is set back goes on from there.
  /// @throws Error for a time that is not finite, and without LiveOptions::clocked.
  void advance(double time);

  /// Changes settings, all or none, with the rules and messages of load_scenario(). Those of before hold on.
  void set(std::vector<std::string> settings, Done done);
  /// Gives an object, by its full name, a material of the library or of the scenario.
  void set_material(std::string object, std::string material, Done done);

  /// Records every sonar's pings from 0 on, into HDF5 (.h5) or MCAP (.mcap) by the ending of `path`. HDF5 files of
  /// several sonars have the sonar's name before the ending; after each further change a new file begins, with a number
  /// before the ending. A scenario that repeats the pings is put beside them at the end, with the ending .yaml. At the
  /// end the listener is told of values that an MCAP recording has cut: SonarMessages::cut_text().
  /// @param replace  Whether files that are there are replaced, once those of the recording are closed.
  void record(const std::filesystem::path& path, Done done, bool replace = false);
  void stop_recording(Done done);

  /// The scenario since the last change as a scenario file, see above.
  /// @throws Error for a path of more than kLongestLivePath waypoints.
  [[nodiscard]] std::string saved_scenario() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Waypoints of a flown path, 20 a second, that are kept: 14 hours.
inline constexpr std::size_t kLongestLivePath = 1'000'000;

}  // namespace insonify
