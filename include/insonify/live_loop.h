// live_loop.h -- makes a scenario's pings live: pause, steering, changed settings, recording.

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
#include "insonify/marker.h"
#include "insonify/messages.h"
#include "insonify/ping.h"
#include "insonify/ping_request.h"
#include "insonify/scenario.h"
#include "insonify/scene.h"

namespace insonify {

/// The world that a LiveLoop simulates, until its next change.
struct LiveWorld {
  std::uint64_t change = 0;         ///< Number of changes so far.
  Scenario scenario;                ///< The simulated scenario, with the `trajectory` in use; sonars as given.
  Trajectory trajectory;            ///< The scenario's own, before shifting and steering.
  Scene scene;                      ///< With the sea surface.
  std::vector<SonarConfig> sonars;  ///< With default values filled in.
  std::string engine_choice;        ///< Simulator::engine_choice()
};

/// Pose of one moving instance at a ping.
struct MovedInstance {
  int instance = 0;  ///< Index into the scene's instances.
  Pose world_from_mesh;
};

/// A sonar carried by something other than the vehicle, such as a link of another model.
struct CarriedSonar {
  std::string sonar;        ///< Its name.
  Pose world_from_carrier;  ///< Used instead of the vehicle's pose.
  Twist twist = {};
};

/// Poses set by another program: of the vehicle, and of other objects.
struct LiveDrive {
  Pose world_from_vehicle;
  Twist twist = {};                     ///< Used with Scenario::motion_in_ping.
  std::vector<MovedObject> moved = {};  ///< In order, as PingRequest::moved.
  double stamp = 0;                     ///< Time of the pose by that program's clock [s].
  std::vector<CarriedSonar> carried = {};
  std::uint64_t request = 0;  ///< Passed on in LivePing::request.

  /// With LiveOptions::on_request: called once, in any thread, with "" after the pings of this drive() are passed to
  /// the listener, or with the reason why there is none.
  std::function<void(const std::string& error)> done = {};
};

/// Objects added and removed while pings are made.
struct LiveObjects {
  std::vector<std::string> removed = {};  ///< Full names of instances added by change_objects() before.
  Scene added = {};  ///< As load_scene() returns it: materials are assigned by the scenario's rules. drive() can move
                     ///< instances marked `moving`, by their full names.
};

/// One ping of a LiveLoop.
struct LivePing {
  std::shared_ptr<const LiveWorld> world;  ///< Not null.
  int sonar = 0;
  Ping ping;
  Pose world_from_vehicle;
  std::vector<MovedInstance> moved;
  double computing_time = 0;  ///< [s]
  double made_at = 0;         ///< Unix time of completion [s].
  double stamp = 0;           ///< Stamp of the LiveDrive that it was made from [s], 0: none ...
  double received_at = 0;     ///< ... and the Unix time at which drive() was called [s].
  std::uint64_t request = 0;  ///< LiveDrive::request of that pose.
  double clock = 0;           ///< Time of advance() at transmission [s], 0: none.
};

/// Files of a finished recording, and their contents.
struct LiveRecording {
  std::vector<std::filesystem::path> files;  ///< One, or one per sonar; none without pings.
  std::filesystem::path scenario;            ///< Scenario that repeats the pings.
  std::uint64_t pings = 0;                   ///< In all files.
  std::uintmax_t bytes = 0;                  ///< Size of all `files` together [bytes].
};

/// Files that LiveLoop::record() writes: the recordings, then the scenario that repeats them.
[[nodiscard]] std::vector<std::filesystem::path> live_recording_files(const std::filesystem::path& path,
                                                                      std::span<const SonarConfig> sonars);

/// Receives the events of a LiveLoop in its threads: each function must return soon, and may be called while another
/// one runs.
class LiveListener {
 public:
  virtual ~LiveListener() = default;
  virtual void on_ping(const std::shared_ptr<const LivePing>& ping) = 0;
  /// Called before the first ping of a world.
  virtual void on_world(const std::shared_ptr<const LiveWorld>& world) = 0;
  /// A line to show, such as a warning about a setting or the reason why the vehicle stopped.
  virtual void on_note(const std::string& text) = 0;
  /// Another program's clock, by LiveLoop::advance() [s].
  virtual void on_clock(double /*time*/) {}
  /// Called when the next ping needs a pose or a time from another program that has not come.
  virtual void on_idle() {}
  /// Called when the files of a recording are closed, complete or not.
  virtual void on_recorded(const LiveRecording& /*recording*/) {}
  /// What an operator has marked so far; asked for when a recording is closed, which keeps it.
  [[nodiscard]] virtual std::vector<Marker> marked() { return {}; }
};

/// State of a LiveLoop.
struct LiveState {
  bool paused = false;
  bool follows = true;               ///< Whether the vehicle follows the scenario's trajectory; else it is steered.
  double speed = 1;                  ///< Scenario time per real time, if the machine keeps up.
  std::string recording;             ///< File or files being written, "": none.
  std::uint64_t recorded_pings = 0;  ///< In these files; 0 while nothing is recorded.
  std::string recording_error;       ///< Why a recording is incomplete, "": none failed.
  std::uint64_t pings_made = 0;      ///< Since the start of the loop.
  std::uint64_t pings_since_change = 0;
  double time = 0;                     ///< Time of the next ping since the last change [s].
  std::optional<double> awaited = {};  ///< With LiveOptions::clocked: the time of that clock at which the next ping is
                                       ///< due, if all pings until now are made [s].
  bool preparing = false;              ///< Whether a change is being prepared while pings of the old state continue.
};

struct LiveOptions {
  int threads = 0;                        ///< Threads of the simulator; 0: one per processor.
  std::optional<double> rate_limit = {};  ///< Limit of each sonar's ping rate [Hz], > 0; time slows down accordingly.
  bool paused = false;                    ///< Whether it starts paused.
  bool driven = false;                    ///< Whether another program moves the vehicle: see LiveLoop::drive().
  bool on_request = false;                ///< With `driven`: a ping for each drive(), in order, and none between.
  bool clocked = false;                   ///< Whether another program sets the time: see LiveLoop::advance().
  bool followed = false;  ///< Whether another program defines the world, by LiveLoop::change_objects(): the scenario's
                          ///< own is not read, and `materials` may name absent objects.
  MessageOptions messages = {};  ///< For MCAP recordings.
};

/// Velocities of a steered vehicle in its own frame: x ahead, y to port, z up.
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

/// Simulates a scenario in a thread of its own, in real time if the machine keeps up.
///
/// Every sonar pings at its own period: ping n of a sonar is at time n times its period, as in `insonify run`. The
/// vehicle follows the scenario's trajectory until it is steered or placed. If computing takes longer than the period,
/// time slows down; no ping is skipped.
///
/// A changed setting or material, a placement, a switch between trajectory and steering, and the start of a recording
/// restart the run at ping 0 and time 0. Slow changes are prepared while pings of the old state continue.
/// saved_scenario() returns the scenario since the restart with the flown path; `insonify run` makes the same pings of
/// it.
///
/// All functions may be called from any thread.
class LiveLoop {
 public:
  /// Called once, from any thread, with "" or the reason why a request failed; then nothing has changed.
  using Done = std::function<void(const std::string& error)>;

  /// Reads scenario and world.
  /// @param settings  As for load_scenario().
  /// @throws Error for wrong input.
  LiveLoop(const std::filesystem::path& scenario, std::span<const std::string> settings = {},
           const LiveOptions& options = {}, const Log& log = {});
  /// Ends the loop.
  ~LiveLoop();
  LiveLoop(const LiveLoop&) = delete;
  LiveLoop& operator=(const LiveLoop&) = delete;

  /// Starts to make pings; to be called once.
  /// @param listener  Must live until end().
  void start(LiveListener& listener);

  /// Stops within the time of a few beams and closes a recording. The listener is not called afterwards. Pending
  /// requests are answered with "the simulation ends".
  /// @throws Error if a recording could not be written, now or before.
  void end();

  [[nodiscard]] std::shared_ptr<const LiveWorld> world() const;
  [[nodiscard]] LiveState state() const;

  void pause(bool on);
  /// Makes the next ping of a paused loop, for all sonars that ping at that time.
  void step();
  /// @throws Error unless the factor is from 0.01 to 100.
  void set_speed(double factor);

  /// Steers the vehicle until the next call. The first nonzero velocity takes it off the trajectory.
  /// @throws Error for a velocity out of limits.
  void fly(const LiveVelocity& velocity);
  /// Places the vehicle and takes it off the trajectory.
  /// @throws Error for a pose out of PingRequest's limits.
  void place(const Pose& world_from_vehicle, Done done = {});
  /// Puts the vehicle back at the start of the trajectory, or takes it off it.
  void follow(bool on, Done done = {});

  /// Removes objects, then adds others, before the next ping; ping numbers and time continue. Added objects stay when
  /// settings change. A recording continues in another file, with which the run restarts. saved_scenario() has none of
  /// these objects.
  /// An object that cannot be added, because its material is unknown, is skipped and reported to the listener.
  /// @throws Error for removing a name that does not exist, or adding one that does; then nothing has changed.
  void change_objects(LiveObjects change);

  /// With LiveOptions::driven: sets the vehicle's pose from now on. There is no ping before the first call; of several
  /// calls between two pings the last counts. If a sonar cannot ping from there, the listener gets the reason and no
  /// ping is made until the next call. fly() has no effect in this mode, place() and follow() are refused.
  /// saved_scenario() has a waypoint per ping, to a micrometre, without `twist`, `moved` and `carried`. With
  /// LiveOptions::followed, missing objects in `moved` are ignored.
  /// With LiveOptions::on_request, each call makes the next ping, of all sonars that ping at that time; an error of
  /// one call does not pause the loop.
  /// @throws Error for what PingRequest refuses, without LiveOptions::driven, and when 1000 calls wait for their pings.
  void drive(LiveDrive drive);

  /// With LiveOptions::clocked: sets the time by another program's clock [s]. A ping is due when that clock has
  /// advanced by the interval between pings in the scenario; of pings more than a period late only the last is made.
  /// After the clock is set back, pings continue from there.
  /// @throws Error for a time that is not finite, and without LiveOptions::clocked.
  void advance(double time);

  /// Changes settings, all or none, with the rules and messages of load_scenario(). Earlier settings stay in effect.
  void set(std::vector<std::string> settings, Done done);
  /// Assigns an object, by its full name, a material of the library or the scenario.
  void set_material(std::string object, std::string material, Done done);

  /// Records every sonar's pings from 0 on, as HDF5 (.h5) or MCAP (.mcap) by the extension of `path`. HDF5 files of
  /// several sonars have the sonar's name before the extension; each further change begins a new file, with a number
  /// before the extension. At the end a scenario that repeats the pings is written beside them (.yaml), and the
  /// listener gets a note of values clipped in an MCAP recording: SonarMessages::cut_text().
  /// @param replace  Whether existing files are replaced, once the recording's files are closed.
  void record(const std::filesystem::path& path, Done done, bool replace = false);
  /// Ends the recording, or the last one requested if it has not begun yet.
  void stop_recording(Done done);

  /// The scenario since the last restart as a scenario file, see above.
  /// @throws Error for a path of more than kLongestLivePath waypoints.
  [[nodiscard]] std::string saved_scenario() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Largest number of waypoints of a flown path, at 20 per second: 14 hours.
inline constexpr std::size_t kLongestLivePath = 1'000'000;

}  // namespace insonify
