// viewer_client.cpp -- handles the requests of a page, and sends it the pings that it watches.

#include <fmt/format.h>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "insonify/recording_formats.h"
#include "serve/hub.h"
#include "serve/json_messages.h"

namespace insonify {
namespace {

using nlohmann::json;

// Settings that can name files: clients must not make the server read files on its disk.
void refuse_files(const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    std::string_view key = setting;
    key = key.substr(key.starts_with("--") ? 2 : 0);
    key = key.substr(0, key.find_first_of("=.["));
    if (key == "water" && setting.find("profile") != std::string::npos) {
      throw Error("water.profile can name files, and cannot be set by a client");
    }
    for (const std::string_view with_files : {"world", "materials", "trajectory", "motions"}) {
      if (key == with_files) {
        throw Error(fmt::format("{} can name files, and cannot be set by a client", key));
      }
    }
  }
}

class ViewerClient : public Client, public HubMember, public std::enable_shared_from_this<ViewerClient> {
 public:
  ViewerClient(Connection& connection, Hub& hub) : connection_(connection), hub_(hub) {}

  void begin() {
    hub_.client_came();
    hub_.join(*this);
    if (hub_.ready()) {
      on_world();
    }
    if (const std::string error = hub_.source().state().recording_error; !error.empty()) {
      on_note(error);
    }
  }

  void on_binary(std::string_view /*bytes*/) override { end("messages to the server are texts"); }

  void on_text(std::string_view text) override {
    std::string op;
    try {
      const json message = parse_message(text);
      if (!message.is_object()) {
        throw FormError("the message is not a JSON object");
      }
      op = text_of(message, "op");
      carry_out(op, message);
      hub_.send_state_soon();
    } catch (const FormError& error) {
      end(op.empty() ? error.what() : fmt::format("{}: {}", printable(op), error.what()));
    } catch (const Error& error) {
      send(error_text(error.what(), op));
    }
  }

  void on_world() override {
    send(hub_.hello());
    if (hub_.scene() != scene_) {
      scene_ = hub_.scene();
      connection_.send({.bytes = scene_, .binary = true});
    }
    if (!hub_.markers().all().empty()) {
      send(hub_.markers().text());
    }
    on_state();
    for (std::size_t i = 0; i < hub_.world().sonars.size(); ++i) {
      if (const auto& ping = hub_.last_ping(static_cast<int>(i))) {
        on_ping(*ping);
      }
    }
  }

  void on_state() override {
    if (hub_.ready()) {
      send(state_text(hub_.source().state(), hub_.counts(), watched_name(), connection_.dropped()));
    }
  }

  void on_note(const std::string& text) override { send(note_text(text)); }
  void on_levels(const Bytes& text) override { send(text); }
  void on_markers(const Bytes& text) override { send(text); }

  void on_ping(SharedPing& shared) override {
    const LivePing& ping = shared.ping();
    if (!hub_.ready() || ping.world->sonars[static_cast<std::size_t>(ping.sonar)].name != watched_name()) {
      return;
    }
    if (!ping.moved.empty()) {
      connection_.send({.bytes = moved_frame(ping), .binary = true, .droppable = true, .stream = 1});
    }
    connection_.send({.bytes = shared.frame(tables_), .binary = true, .droppable = true});
  }

  [[nodiscard]] bool flies() const override { return flies_; }

 private:
  void send(std::string text) { send(std::make_shared<const std::string>(std::move(text))); }
  void send(const Bytes& bytes) { connection_.send({.bytes = bytes}); }

  void end(const std::string& reason) {
    send(closing_text(reason));
    constexpr std::uint16_t kPolicyError = 1008;
    connection_.close(kPolicyError, reason);
  }

  // The chosen sonar, or the first if that no longer exists.
  [[nodiscard]] std::string watched_name() const {
    for (const SonarConfig& sonar : hub_.world().sonars) {
      if (sonar.name == watched_) {
        return watched_;
      }
    }
    return hub_.world().sonars.front().name;
  }

  // Its index.
  [[nodiscard]] int watched() const {
    const auto& sonars = hub_.world().sonars;
    return static_cast<int>(std::ranges::find(sonars, watched_name(), &SonarConfig::name) - sonars.begin());
  }

  // Answers a request when it is done, if this client still exists.
  [[nodiscard]] LiveLoop::Done answer(const std::string& op) {
    return [&hub = hub_, weak = weak_from_this(), op](const std::string& error) {
      hub.post([&hub, weak, op, error] {
        if (const auto self = weak.lock(); self && !error.empty()) {
          self->send(error_text(error, op));
        }
        hub.send_state_soon();
      });
    };
  }

  void watch(const json& message) {
    const std::string name = text_of(message, "sonar");
    unsigned tables = kLevelTable;
    if (message.contains("tables")) {
      for (const std::string& table : texts_of(message, "tables")) {
        const unsigned bit = ping_table(table);
        if (bit == 0) {
          throw Error(fmt::format("there is no table {}", printable(table)));
        }
        tables |= bit;
      }
    }
    const auto& sonars = hub_.world().sonars;
    if (std::ranges::find(sonars, name, &SonarConfig::name) == sonars.end()) {
      throw Error(fmt::format("there is no sonar {}", printable(name)));
    }
    watched_ = name;
    tables_ = tables;
    if (const auto& ping = hub_.last_ping(watched())) {
      on_ping(*ping);
    }
  }

  void fly(const json& message) {
    LiveVelocity velocity;
    velocity.linear = numbers_of(message, "linear", 3);
    velocity.angular = numbers_of(message, "angular", 3) * (std::numbers::pi / 180);
    simulation().fly(velocity);
    flies_ = !velocity.linear.isZero(0) || !velocity.angular.isZero(0);
  }

  void record(const json& message) {
    if (!switch_of(message, "on")) {
      simulation().stop_recording(answer("record"));
      return;
    }
    const std::string format = message.contains("format") ? text_of(message, "format") : "h5";
    if (recording_format("a." + format) == nullptr) {
      throw Error(fmt::format("format = \"{}\" must be {}", printable(format), recording_names("", " or ")));
    }
    simulation().record(hub_.recording_path("." + format), answer("record"));
  }

  [[nodiscard]] LiveLoop& simulation() {
    if (LiveLoop* const simulation = hub_.source().simulation()) {
      return *simulation;
    }
    throw Error("this is a recording: its pings are made, and cannot be changed");
  }

  [[nodiscard]] Playback& playback() {
    if (Playback* const playback = hub_.source().playback()) {
      return *playback;
    }
    throw Error("this is a simulation: only recordings have a time to go to");
  }

  void carry_out(const std::string& op, const json& message) {
    PingSource& source = hub_.source();
    if (op == "watch") {
      watch(message);
    } else if (op == "fly") {
      fly(message);
    } else if (op == "place") {
      const Eigen::VectorXd q = numbers_of(message, "orientation", 4);
      Pose pose{numbers_of(message, "position", 3), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
      const double norm = pose.orientation.norm();
      if (!(norm > 0.5 && norm < 2)) {
        throw Error("orientation must be a unit quaternion");
      }
      pose.orientation.normalize();
      simulation().place(pose, answer(op));
    } else if (op == "follow") {
      simulation().follow(switch_of(message, "on"), answer(op));
    } else if (op == "pause") {
      source.pause(switch_of(message, "on"));
    } else if (op == "step") {
      message.contains("back") && switch_of(message, "back") ? playback().step_back(watched()) : source.step(watched());
    } else if (op == "seek") {
      playback().seek(number_of(message, "time"));
    } else if (op == "speed") {
      source.set_speed(number_of(message, "factor"));
    } else if (op == "set") {
      std::vector<std::string> settings = texts_of(message, "settings");
      refuse_files(settings);
      simulation().set(std::move(settings), answer(op));
    } else if (op == "material") {
      simulation().set_material(text_of(message, "object"), text_of(message, "material"), answer(op));
    } else if (op == "record") {
      record(message);
    } else if (op == "mark") {
      hub_.markers().set(message);
      hub_.send_markers();
    } else if (op == "save") {
      send(saved_text(simulation().saved_scenario()));
    } else {
      throw FormError("unknown op");
    }
  }

  Connection& connection_;
  Hub& hub_;
  Bytes scene_;
  std::string watched_;
  unsigned tables_ = kLevelTable;
  bool flies_ = false;
};

// Others hold weak pointers to the client, so that late answers find it gone.
class Holder : public Client {
 public:
  Holder(Connection& connection, Hub& hub) : hub_(hub), client_(std::make_shared<ViewerClient>(connection, hub)) {
    client_->begin();
  }
  ~Holder() override {
    hub_.leave(*client_);
    hub_.client_left();
  }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;
  void on_text(std::string_view text) override { client_->on_text(text); }
  void on_binary(std::string_view bytes) override { client_->on_binary(bytes); }

 private:
  Hub& hub_;
  std::shared_ptr<ViewerClient> client_;
};

}  // namespace

std::unique_ptr<Client> make_viewer_client(Connection& connection, Hub& hub) {
  return std::make_unique<Holder>(connection, hub);
}

}  // namespace insonify
