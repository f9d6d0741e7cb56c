// oculus_server.cpp -- the loop of an emulated Oculus.

#include "emulate/oculus_server.h"

#include <algorithm>
#include <array>
#include <boost/asio/post.hpp>
#include <cmath>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/acoustics/sound_speed.h"

namespace insonify {

namespace net = boost::asio;
using boost::system::error_code;

namespace {

constexpr unsigned short kStatusPort = 52102;
constexpr std::size_t kMostClients = 32;
constexpr std::size_t kMostWarnings = 100;
constexpr std::chrono::seconds kBeat{1};
constexpr std::uint16_t kDevice = 1;

WallClock::duration time_of(double seconds) {
  return std::chrono::duration_cast<WallClock::duration>(std::chrono::duration<double>(seconds));
}

double pressure_bar(const Water& water) {
  constexpr double kAtmosphere = 1.01325, kBarPerMegapascal = 10;
  return kAtmosphere + kBarPerMegapascal * pressure_mpa(water.depth, radians_from_degrees(45));
}

// The members of a fire message that act on the simulated sonar.
OculusFire acting(const OculusFire& fire) {
  return {.mode = fire.mode,
          .flags = static_cast<std::uint8_t>(fire.flags & (kOculusRangeInMetres | kOculus512Beams)),
          .range = fire.range,
          .sound_speed = fire.sound_speed,
          .salinity = fire.salinity};
}

OculusClient::Bytes shared(std::vector<std::uint8_t> bytes) {
  return std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
}

}  // namespace

OculusServer::OculusServer(const EmulateOptions& options, EmulatedSonar& sonar)
    : sonar_(sonar),
      modes_(oculus_modes(sonar.scenario(), sonar.given(), sonar.high())),
      network_(network_of(options)),
      acceptor_(loop_.context()),
      status_socket_(loop_.context(), Udp::v4()) {
  const Tcp::endpoint endpoint(network_.address, static_cast<unsigned short>(options.port));
  error_code failure;
  acceptor_.open(endpoint.protocol(), failure);
  if (!failure) {
    acceptor_.set_option(Tcp::acceptor::reuse_address(true), failure);
  }
  if (!failure) {
    acceptor_.bind(endpoint, failure);
  }
  if (!failure) {
    acceptor_.listen(net::socket_base::max_listen_connections, failure);
  }
  if (!failure) {
    status_socket_.set_option(net::socket_base::broadcast(true), failure);
  }
  if (!failure) {
    status_socket_.bind({network_.address, 0}, failure);
  }
  if (failure) {
    throw Error(
        fmt::format("cannot listen on TCP port {} of {}: {}", options.port, options.address, failure.message()));
  }
}

std::string OculusServer::address() const {
  const Tcp::endpoint local = acceptor_.local_endpoint();
  return fmt::format("{}:{}", local.address().to_string(), local.port());
}

std::string OculusServer::status_address() const {
  return fmt::format("{}:{}", network_.broadcast.to_string(), kStatusPort);
}

void OculusServer::run() {
  accept();
  beat();
  loop_.run();
}

void OculusServer::accept() {
  acceptor_.async_accept([this](error_code failure, Tcp::socket socket) {
    if (!failure) {
      welcome(std::move(socket));
    } else {
      warn_once(fmt::format("a client could not connect: {}", failure.message()));
    }
    accept();
  });
}

void OculusServer::welcome(Tcp::socket socket) {
  if (clients_.size() >= kMostClients) {
    report_.note_refusal();
    warn_once(fmt::format("more than {} clients: the last was turned away", kMostClients));
    return;
  }
  const auto client = std::make_shared<OculusClient>(
      std::move(socket),
      OculusClient::Events{
          .message = [this](OculusClient& from, const OculusMessage& message) { take(from, message); },
          .skipped = [this](OculusClient& from,
                            std::uint64_t bytes) { refuse(from, fmt::format("{} bytes that are no message", bytes)); },
          .gone = [this](OculusClient& from) { forget(from); }});
  clients_.push_back(client);
  last_client_ = client->address();
  client->start();
}

void OculusServer::forget(OculusClient& client) {
  std::erase_if(clients_, [&](const Client& other) { return other.get() == &client; });
  if (clients_.empty()) {  // Nobody listens: the next one begins anew.
    asked_.reset();
    settings_.reset();
    wanted_.reset();
    ping_timer_.cancel();
    tell_timer_.cancel();
    last_client_ = {};
  }
}

void OculusServer::refuse(const OculusClient& client, const std::string& reason) {
  report_.note_refusal();
  warn_once(fmt::format("not obeyed, from {}: {}", client.address().to_string(), reason));
}

void OculusServer::warn_once(const std::string& text) {
  if (warnings_.size() < kMostWarnings && warnings_.insert(text).second) {
    complain("warning: " + text);
  }
}

void OculusServer::take(OculusClient& client, const OculusMessage& message) {
  switch (message.id) {
    case kOculusFire:
      try {
        const OculusFire asked = decode_fire(message);
        client.layout = asked.layout;
        fire(asked);
      } catch (const Error& error) {
        refuse(client, error.what());
      }
      break;
    case kOculusUserConfig:
      if (!client.send(shared(encode(oculus_user_config(status()))))) {
        report_.note_drop();
      }
      break;
    case kOculusDummy:  // Keeps the connection alive.
      break;
    default:
      refuse(client, fmt::format("message 0x{:02x}, which is unknown", message.id));
  }
}

void OculusServer::fire(const OculusFire& asked) {
  if (pinging_) {  // Until the ping is made the simulated sonar cannot be changed.
    wanted_ = asked;
  } else if (asked_ != asked) {
    apply(asked);
    asked_ = asked;
    schedule();
  }
}

// Throws where the simulated sonar refuses the settings; then nothing has changed.
void OculusServer::apply(const OculusFire& asked) {
  const bool high = asked.mode == 2 && modes_.high;
  Settings settings{.plan = oculus_plan(high ? *modes_.high : modes_.low, sonar_.scenario(), asked)};
  if (settings.plan.sonar && applied_ != acting(asked)) {
    sonar_.set(*settings.plan.sonar);
    applied_ = acting(asked);
  }
  settings.levels = sonar_.levels();
  settings.bearings = oculus_bearings(sonar_.config());
  if (asked.mode == 2 && !high) {
    warn_once(fmt::format("{} has one mode, which is used for mode 2 (high frequency) too", sonar_.given().name));
  }
  if (settings.plan.fire.range < asked.range) {
    warn_once(fmt::format("range = {:.6g} m is limited to {:.6g} m, the longest in mode {}", asked.range,
                          settings.plan.fire.range, asked.mode));
  }
  settings_ = std::make_shared<const Settings>(std::move(settings));
}

// A ping that took longer than the period delays the next; those that were due meanwhile are left out.
void OculusServer::schedule() {
  ping_timer_.cancel();
  if (!settings_ || settings_->plan.period == 0) {
    return;
  }
  const WallClock::time_point now = WallClock::now();
  const WallClock::time_point due = last_due_ ? std::max(now, *last_due_ + time_of(settings_->plan.period)) : now;
  ping_timer_.expires_at(due);
  ping_timer_.async_wait([this, due](error_code cancelled) {
    if (!cancelled && settings_ && !pinging_) {
      ping(due);
    }
  });
}

void OculusServer::ping(WallClock::time_point due) {
  last_due_ = due;
  pinging_ = true;
  net::post(maker_, [this, settings = settings_] {
    std::shared_ptr<const Heard> heard;
    std::string failure;
    try {
      heard = std::make_shared<const Heard>(make_ping(*settings));
    } catch (const Interrupted&) {
      return;  // The end of the program: RoadLoop sees it too.
    } catch (const Error& error) {
      failure = error.what();
    }
    net::post(loop_.context(), [this, heard, failure] { pinged(heard, failure); });
  });
}

// Runs in the other thread.
OculusServer::Heard OculusServer::make_ping(const Settings& settings) {
  const WallClock::time_point transmitted = WallClock::now();
  const SonarConfig& sonar = sonar_.config();
  const Water water = sonar_.scenario().water_at(sonar);
  const OculusPlan& plan = settings.plan;
  const Ping* ping = plan.sonar ? &sonar_.ping() : nullptr;
  Heard heard{.result = {.fire = plan.fire,
                         .device = kDevice,
                         .number = number_++,
                         .frequency = sonar.frequency,
                         .temperature_c = water.temperature_c,
                         .pressure_bar = pressure_bar(water),
                         .sound_speed = sonar_.sound_speed(),
                         .start_time = sonar_.time_at(transmitted),
                         .range_resolution = plan.row_length,
                         .range_count = static_cast<std::uint16_t>(plan.rows),
                         .bearings = settings.bearings,
                         .image = oculus_image(plan, ping, settings.levels, sonar.beam_count)},
              .computing_time = std::chrono::duration<double>(WallClock::now() - transmitted).count(),
              .transmitted = transmitted};
  if (ping != nullptr) {
    const Vec3 rpy = rpy_from_orientation(ping->world_from_sonar.orientation);
    heard.result.heading_deg = std::fmod(450 - degrees_from_radians(rpy.z()), 360);
    heard.result.pitch_deg = -degrees_from_radians(rpy.y());
    heard.result.roll_deg = degrees_from_radians(rpy.x());
  }
  return heard;
}

void OculusServer::pinged(const std::shared_ptr<const Heard>& heard, const std::string& failure) {
  pinging_ = false;
  if (!failure.empty()) {
    warn_once("no ping: " + failure);
  }
  if (heard && settings_) {
    const double listening = 2 * heard->result.range_resolution * heard->result.range_count / heard->result.sound_speed;
    tell_timer_.expires_at(heard->transmitted + time_of(listening));
    tell_timer_.async_wait([this, heard](error_code cancelled) {
      if (!cancelled) {
        tell(*heard);
      }
    });
  }
  if (wanted_) {
    try {
      fire(*std::exchange(wanted_, {}));
    } catch (const Error& error) {
      warn_once(fmt::format("not obeyed: {}", error.what()));
    }
  }
  schedule();
}

void OculusServer::tell(const Heard& heard) {
  std::array<OculusClient::Bytes, 2> in_layout;
  for (const Client& client : clients_) {
    OculusClient::Bytes& bytes = in_layout.at(static_cast<std::size_t>(client->layout - 1));
    if (!bytes) {
      OculusPing result = heard.result;
      result.fire.layout = client->layout;
      bytes = shared(encode(result));
    }
    if (!client->send_ping(bytes)) {
      report_.note_drop();
    }
  }
  report_.note(heard.transmitted, heard.computing_time);
}

void OculusServer::beat() {
  send_status();
  if (!asked_ || oculus_ping_rate(asked_->ping_rate) == 0) {
    const OculusClient::Bytes dummy = shared(encode(OculusMessage{.id = kOculusDummy, .source = kDevice}));
    for (const Client& client : clients_) {
      client->send(dummy);  // One that many wait for is as good as none.
    }
  }
  beat_timer_.expires_after(kBeat);
  beat_timer_.async_wait([this](error_code) { beat(); });
}

OculusStatus OculusServer::status() const {
  const Water water = sonar_.scenario().water_at(sonar_.config());
  return {.device = kDevice,
          .part_number = modes_.part_number,
          .address = network_.address.to_bytes(),
          .mask = network_.mask.to_bytes(),
          .client = last_client_.to_bytes(),
          .temperature_c = water.temperature_c,
          .pressure_bar = pressure_bar(water)};
}

void OculusServer::send_status() {
  error_code failure;
  status_socket_.send_to(net::buffer(encode(status())), {network_.broadcast, kStatusPort}, 0, failure);
  if (failure && failure != net::error::connection_refused) {  // Refused: nobody listens, on loopback.
    warn_once(fmt::format("no status to UDP {}: {}", status_address(), failure.message()));
  }
}

}  // namespace insonify
