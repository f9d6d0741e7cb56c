// streaming_server.cpp -- the event loop of a sonar that pings by itself.

#include "emulate/streaming_server.h"

#include <algorithm>

#include "console/console.h"
#include "console/outcome.h"

namespace insonify {

namespace net = boost::asio;
using boost::system::error_code;

StreamingServer::StreamingServer(const EmulateOptions& options, EmulatedSonar& sonar,
                                 std::unique_ptr<PingStreamer> streamer)
    : sonar_(sonar), streamer_(std::move(streamer)), acceptor_(loop_.context()), socket_(loop_.context()) {
  const net::ip::address address = address_of(options);
  const Tcp::endpoint endpoint(address, static_cast<unsigned short>(options.port));
  try {
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(Tcp::acceptor::reuse_address(true));
    acceptor_.bind(endpoint);
    acceptor_.listen();
    const Udp::endpoint same(address, acceptor_.local_endpoint().port());
    socket_.open(same.protocol());
    socket_.bind(same);
    socket_.non_blocking(true);
  } catch (const boost::system::system_error& failure) {
    throw Error(
        fmt::format("cannot listen on port {} of {}: {}", options.port, options.address, failure.code().message()));
  }
}

std::string StreamingServer::address() const {
  return endpoint_text(acceptor_.local_endpoint());
}

void StreamingServer::run() {
  accept();
  receive();
  loop_.run();
}

void StreamingServer::accept() {
  acceptor_.async_accept([this](error_code failure, Tcp::socket socket) {
    constexpr std::size_t kMostClients = 32;
    if (!failure && clients_.size() < kMostClients) {
      const auto client = std::make_shared<StreamClient>(
          std::move(socket),
          StreamClient::Events{.event =
                                   [this](StreamClient& from, const PingEvent& event) {
                                     for (const PingFrame& frame : take(event).frames) {
                                       from.send(encode(frame));
                                     }
                                   },
                               .gone =
                                   [this](StreamClient& from) {
                                     std::erase_if(clients_, [&](const auto& other) { return other.get() == &from; });
                                   }});
      clients_.push_back(client);
      client->read();
    }
    if (failure != net::error::operation_aborted) {
      accept();
    }
  });
}

void StreamingServer::receive() {
  socket_.async_receive_from(net::buffer(datagram_), sender_, [this](error_code failure, std::size_t size) {
    if (!failure) {
      take_datagram(size);
    }
    receive();
  });
}

void StreamingServer::take_datagram(std::size_t size) {
  PingParser parser;
  parser.add(std::span(datagram_).first(size));
  while (const std::optional<PingEvent> event = parser.last()) {
    const StreamerAnswer answer = take(*event);
    for (const PingFrame& frame : answer.frames) {
      error_code failure;  // A client that is gone or whose buffer is full loses the message.
      socket_.send_to(net::buffer(encode(frame)), sender_, 0, failure);
    }
    if (answer.accepted) {
      udp_client_ = sender_;
    }
  }
}

// Damaged frames are not answered: who sent them is not known to understand. What the simulated sonar cannot do is
// refused, and the settings before it stay.
StreamerAnswer StreamingServer::take(const PingEvent& event) {
  if (event.kind != PingEvent::Kind::kFrame) {
    return {};
  }
  std::unique_ptr<PingStreamer> asked = streamer_->clone();
  StreamerAnswer answer = asked->take(event.frame);
  if (answer.accepted) {
    try {
      sonar_.set(asked->config(sonar_.given(), sonar_.scenario()));
    } catch (const Error& error) {
      answer = {.frames = {PingStreamer::refusal(event.frame.id, error.what())}};
    }
  }
  if (answer.accepted) {
    streamer_ = std::move(asked);
    ++command_;
    warned_ = false;
    timer_.cancel();
    schedule();
  } else if (!answer.frames.empty() && answer.frames[0].id == kPingNack) {
    report_.note_refusal();
  }
  return answer;
}

void StreamingServer::schedule() {
  if (!streamer_->is_on()) {
    return;
  }
  timer_.expires_at(std::max(WallClock::now(), next_due_));
  timer_.async_wait([this, command = command_](error_code cancelled) {
    if (!cancelled && command == command_) {
      ping();
    }
  });
}

// Makes a ping, and sends it when its last echo is back.
void StreamingServer::ping() {
  const WallClock::time_point transmitted = WallClock::now();
  try {
    const Ping& made = sonar_.ping();
    const SonarConfig& config = sonar_.config();
    const auto frames = streamer_->data(made, config, sonar_.scenario().water_at(config), sonar_.time_at(transmitted));
    const double travel = 2 * config.max_range / sonar_.sound_speed();
    next_due_ = transmitted + wall_clock_duration(std::max(travel, streamer_->period()));
    timer_.expires_at(transmitted + wall_clock_duration(travel));
    timer_.async_wait([this, frames, transmitted, command = command_](error_code cancelled) {
      if (!cancelled && command == command_) {
        send(frames);
        report_.note(transmitted, sonar_.computing_time());
        schedule();
      }
    });
  } catch (const Interrupted&) {
    throw;  // The end of the program, not a wrong setting: run() catches it.
  } catch (const Error& error) {
    if (!std::exchange(warned_, true)) {
      complain(fmt::format("warning: no ping: {}", error.what()));
    }
  }
}

void StreamingServer::send(const std::vector<PingFrame>& frames) {
  for (const PingFrame& frame : frames) {
    const std::vector<std::uint8_t> bytes = encode(frame);
    for (const auto& client : clients_) {
      if (!client->send(bytes)) {
        report_.note_drop();
      }
    }
    if (udp_client_) {
      error_code failure;
      socket_.send_to(net::buffer(bytes), *udp_client_, 0, failure);
      if (failure) {
        report_.note_drop();
      }
    }
  }
}

}  // namespace insonify
