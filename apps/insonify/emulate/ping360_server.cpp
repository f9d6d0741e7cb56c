// ping360_server.cpp -- the event loop of an emulated Ping360.

#include "emulate/ping360_server.h"

#include "console/console.h"
#include "console/outcome.h"
#include "emulate/listening.h"

namespace insonify {

namespace net = boost::asio;
using boost::system::error_code;

namespace {

constexpr std::size_t kLongestDatagram = 2048;  // Longer ones are cut and refused: commands have at most 24 bytes.

// Message ids of the commands that ping.
constexpr std::uint16_t kAutoTransmit = 2602;

}  // namespace

Ping360Server::Ping360Server(const EmulateOptions& options, EmulatedSonar& sonar)
    : sonar_(sonar), socket_(loop_.context()), datagram_(kLongestDatagram) {
  const Udp::endpoint endpoint(address_of(options), static_cast<std::uint16_t>(options.port));
  error_code failure;
  socket_.open(endpoint.protocol(), failure);
  if (!failure) {
    socket_.bind(endpoint, failure);
  }
  if (failure) {
    throw Error(
        fmt::format("cannot listen on UDP port {} of {}: {}", options.port, options.address, failure.message()));
  }
  socket_.non_blocking(true);
  if (options.serial) {
    serial_ = std::make_unique<SerialLine>(loop_.context());
  }
}

std::string Ping360Server::address() const {
  const Udp::endpoint local = socket_.local_endpoint();
  const std::string host = local.address().to_string();
  return local.address().is_v6() ? fmt::format("[{}]:{}", host, local.port())
                                 : fmt::format("{}:{}", host, local.port());
}

void Ping360Server::run() {
  receive();
  loop_.run();
}

void Ping360Server::receive() {
  if (!receiving_datagram_) {
    receiving_datagram_ = true;
    socket_.async_receive_from(net::buffer(datagram_), sender_, [this](error_code failure, std::size_t size) {
      receiving_datagram_ = false;
      receive_datagram(failure ? 0 : size);
    });
  }
  if (serial_ && !receiving_bytes_) {
    receiving_bytes_ = true;
    serial_->receive([this](std::span<const std::uint8_t> bytes) {
      receiving_bytes_ = false;
      receive_bytes(bytes);
    });
  }
}

// Only the first of several damaged frames in a datagram is answered, so that a reply is not much longer than its
// request.
void Ping360Server::receive_datagram(std::size_t size) {
  PingParser parser;
  parser.add(std::span(datagram_).first(size));
  bool damaged = false;
  while (const std::optional<PingEvent> event = parser.last()) {
    const bool repeated = event->kind == PingEvent::Kind::kDamaged && std::exchange(damaged, true);
    if (!repeated && event->kind != PingEvent::Kind::kBreak) {
      commands_.push_back({*event, sender_});
    }
  }
  work();
}

void Ping360Server::receive_bytes(std::span<const std::uint8_t> bytes) {
  serial_parser_.add(bytes);
  while (const std::optional<PingEvent> event = serial_parser_.next()) {
    commands_.push_back({*event, {}});
  }
  work();
}

void Ping360Server::work() {
  while (!pinging_ && !commands_.empty()) {
    const Command command = std::move(commands_.front());
    commands_.pop_front();
    act(command);
  }
  if (!pinging_) {
    receive();
  }
}

void Ping360Server::act(const Command& command) {
  const Ping360 before = instrument_;
  const Ping360Answer answer = instrument_.take(command.event);
  for (const PingFrame& frame : answer.frames) {
    if (frame.id == 2) {
      report_.note_refusal();
    }
    send(frame, command.client);
  }
  if (answer.scan_changed) {
    ++scan_number_;
    scan_timer_.cancel();
    if (instrument_.sector()) {
      scan_client_ = command.client;
      scan(0);
    }
  }
  if (answer.transmit) {
    transmit_once(command, before);
  }
}

void Ping360Server::transmit_once(const Command& command, const Ping360& before) {
  try {
    const Received received = make_ping();
    pinging_ = true;
    ping_timer_.expires_at(received.transmitted + wall_clock_duration(instrument_.settings().listening_time()));
    ping_timer_.async_wait([this, received, client = command.client](error_code) {
      send_ping(received, client);
      pinging_ = false;
      work();
    });
  } catch (const Interrupted&) {
    throw;  // The end of the program, not a wrong setting: run() catches it.
  } catch (const Error& error) {
    instrument_ = before;
    refuse(command.event.frame.id, error, command.client);
  }
}

// Makes ping `ping` of a scan, sends it when its echoes have arrived, and continues after the delay.
void Ping360Server::scan(std::uint64_t ping) {
  instrument_.turn_to(ping);
  try {
    const Received received = make_ping();
    scan_timer_.expires_at(received.transmitted + wall_clock_duration(instrument_.settings().listening_time()));
    scan_timer_.async_wait([this, received, ping, scan = scan_number_](error_code) {
      if (scan != scan_number_) {
        return;
      }
      send_ping(received, scan_client_);
      scan_timer_.expires_after(std::chrono::milliseconds(instrument_.sector()->delay));
      scan_timer_.async_wait([this, ping, scan](error_code) {
        if (scan == scan_number_) {
          this->scan(ping + 1);
        }
      });
    });
  } catch (const Interrupted&) {
    throw;  // The end of the program, not a wrong setting: run() catches it.
  } catch (const Error& error) {
    instrument_.stop();
    refuse(kAutoTransmit, error, scan_client_);
  }
}

void Ping360Server::apply_settings() {
  Ping360Settings wanted = instrument_.settings();
  wanted.angle = 0;  // These affect the head and the samples, not the simulated sonar.
  wanted.gain_setting = 0;
  wanted.mode = 0;
  if (applied_ == wanted) {
    return;
  }
  const auto config = ping360_config(sonar_.given(), sonar_.scenario(), wanted, sonar_.sound_speed());
  if (config) {
    sonar_.set(*config);
    levels_ = sonar_.levels();
  }
  config_ = config;
  applied_ = wanted;
}

Ping360Server::Received Ping360Server::make_ping() {
  const WallClock::time_point transmitted = WallClock::now();
  apply_settings();
  const Ping360Settings& settings = instrument_.settings();
  const Ping* ping = config_ ? &sonar_.ping(ping360_head_angle(settings.angle)) : nullptr;
  const int blank = ping360_blank_samples(sonar_.given(), settings, sonar_.sound_speed());
  return {ping360_samples(ping, sonar_.config(), levels_, settings, blank), transmitted};
}

void Ping360Server::send_ping(const Received& received, const Client& client) {
  send(instrument_.data(received.samples), client);
  report_.note(received.transmitted, sonar_.computing_time());
}

void Ping360Server::send(const PingFrame& frame, const Client& client) {
  const std::vector<std::uint8_t> bytes = encode(frame);
  if (client) {
    error_code failure;  // UDP: a client that is gone or whose buffer is full loses the message.
    socket_.send_to(net::buffer(bytes), *client, 0, failure);
    if (failure) {
      report_.note_drop();
    }
  } else if (!serial_->send(bytes)) {
    report_.note_drop();
  }
}

void Ping360Server::refuse(std::uint16_t id, const Error& error, const Client& client) {
  report_.note_refusal();
  send(instrument_.refusal(id, error.what()), client);
  if (!std::exchange(warned_, true)) {
    complain(fmt::format("warning: no ping: {}", error.what()));
  }
}

}  // namespace insonify
