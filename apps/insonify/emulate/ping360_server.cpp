// ping360_server.cpp -- the event loop of an emulated Ping360.

#include "emulate/ping360_server.h"

#include <algorithm>

#include "console/console.h"
#include "console/outcome.h"
#include "emulate/listening.h"

namespace insonify {

namespace net = boost::asio;
using boost::system::error_code;

namespace {

constexpr std::size_t kLongestDatagram = 2048;  // Longer ones are cut and refused: commands have at most 24 bytes.

// Message ids.
constexpr std::uint16_t kTransducer = 2601, kAutoTransmit = 2602;

}  // namespace

Ping360Server::Ping360Server(const EmulateOptions& options, EmulatedSonar& sonar)
    : sonar_(sonar), socket_(loop_.context()), fast_(options.fast), datagram_(kLongestDatagram) {
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
  if (endpoint.protocol() == Udp::v4() && options.port == kPing360Port) {
    discovery_.emplace(socket_);
  }
  if (options.serial) {
    serial_ = std::make_unique<SerialLine>(loop_.context());
  }
}

std::string Ping360Server::address() const {
  return endpoint_text(socket_.local_endpoint());
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
  while (!busy_ && !commands_.empty()) {
    const Command command = std::move(commands_.front());
    commands_.pop_front();
    act(command);
  }
  if (!busy_) {
    receive();
  }
}

void Ping360Server::become_free() {
  busy_ = false;
  work();
}

void Ping360Server::act(const Command& command) {
  const Ping360 before = instrument_;
  Ping360Answer answer = instrument_.take(command.event);
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
  } else if (!answer.frames.empty()) {
    answer_after_turn(command, std::move(answer.frames));
  }
}

// Turns the head to where the settings have it.
// @param start  When it begins to turn. @return  When it is there.
WallClock::time_point Ping360Server::turned_at(WallClock::time_point start) {
  const int from = std::exchange(head_, instrument_.settings().angle);
  return due_ = start + wall_clock_duration(fast_ ? 0 : ping360_turn_time(from, head_));
}

// Counts from when the ping was due, so that a late event does not delay those that follow; but no message comes before
// its echoes could.
WallClock::time_point Ping360Server::read_out_at(const Received& received) {
  const WallClock::duration listening = wall_clock_duration(instrument_.settings().listening_time());
  due_ += listening + wall_clock_duration(fast_ ? 0 : kPing360ReadoutTime);
  return due_ = std::max(due_, received.transmitted + listening);
}

// A transducer message that does not transmit is answered when the head is there, everything else at once.
void Ping360Server::answer_after_turn(const Command& command, std::vector<PingFrame> frames) {
  const auto answer = [this, client = command.client, frames = std::move(frames)] {
    for (const PingFrame& frame : frames) {
      if (frame.id == kPingNack) {
        report_.note_refusal();
      }
      send(frame, client);
    }
  };
  const WallClock::time_point now = WallClock::now();
  const WallClock::time_point then = command.event.frame.id == kTransducer ? turned_at(now) : now;
  if (then == now) {
    answer();
    return;
  }
  busy_ = true;
  ping_timer_.expires_at(then);
  ping_timer_.async_wait([this, answer](error_code) {
    answer();
    become_free();
  });
}

void Ping360Server::transmit_once(const Command& command, const Ping360& before) {
  busy_ = true;
  ping_timer_.expires_at(turned_at(WallClock::now()));
  ping_timer_.async_wait([this, command, before](error_code) {
    try {
      const Received received = make_ping();
      ping_timer_.expires_at(read_out_at(received));
      ping_timer_.async_wait([this, received, client = command.client](error_code) {
        send_ping(received, client);
        become_free();
      });
    } catch (const Interrupted&) {
      throw;  // The end of the program, not a wrong setting: run() catches it.
    } catch (const Error& error) {
      instrument_ = before;
      refuse(command.event.frame.id, error, command.client);
      become_free();
    }
  });
}

// Turns the head to ping `ping` of a scan, then makes it.
void Ping360Server::scan(std::uint64_t ping) {
  instrument_.turn_to(ping);
  scan_timer_.expires_at(turned_at(ping == 0 ? WallClock::now() : due_));
  scan_timer_.async_wait([this, ping, scan = scan_number_](error_code) {
    if (scan == scan_number_) {
      scan_after_turn(ping);
    }
  });
}

// Makes a ping of a scan and sends it when its samples have been read out.
void Ping360Server::scan_after_turn(std::uint64_t ping) {
  try {
    const Received received = make_ping();
    scan_timer_.expires_at(read_out_at(received));
    scan_timer_.async_wait([this, received, ping, scan = scan_number_](error_code) {
      if (scan == scan_number_) {
        send_ping(received, scan_client_);
        scan_on(ping + 1);
      }
    });
  } catch (const Interrupted&) {
    throw;  // The end of the program, not a wrong setting: run() catches it.
  } catch (const Error& error) {
    instrument_.stop();
    refuse(kAutoTransmit, error, scan_client_);
  }
}

// Continues a scan after its delay.
void Ping360Server::scan_on(std::uint64_t ping) {
  due_ += std::chrono::milliseconds(instrument_.sector()->delay);
  scan_timer_.expires_at(due_);
  scan_timer_.async_wait([this, ping, scan = scan_number_](error_code) {
    if (scan == scan_number_) {
      this->scan(ping);
    }
  });
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
