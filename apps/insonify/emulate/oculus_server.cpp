// oculus_server.cpp -- the event loop of an emulated Oculus.

#include "emulate/oculus_server.h"

#include <algorithm>
#include <array>
#include <boost/asio/post.hpp>

#include "console/console.h"
#include "console/outcome.h"

namespace insonify {

namespace net = boost::asio;
using boost::system::error_code;

namespace {

constexpr unsigned short kStatusPort = 52102;
constexpr std::size_t kMostClients = 32;
constexpr std::size_t kMostWarnings = 100;
constexpr std::chrono::seconds kBeat{1};

OculusClient::Bytes shared(std::vector<std::uint8_t> bytes) {
  return std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
}

}  // namespace

OculusServer::OculusServer(const EmulateOptions& options, EmulatedSonar& sonar)
    : silence_(options.silence),
      pings_(sonar),
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
      accept();
    } else {
      warn_once(fmt::format("a client could not connect: {}", failure.message()));
      accept_timer_.expires_after(kBeat);  // Retries later: file descriptors, for example, may become free.
      accept_timer_.async_wait([this](error_code) { accept(); });
    }
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
      OculusClient::Events{.message = [this](OculusClient& from, const OculusMessage& message) { take(from, message); },
                           .skipped =
                               [this](OculusClient& from, std::uint64_t bytes) {
                                 refuse(from, fmt::format("{} bytes that are not a message", bytes));
                               },
                           .gone = [this](OculusClient& from) { forget(from); }});
  clients_.push_back(client);
  last_client_ = client->address();
  client->start();
}

void OculusServer::forget(OculusClient& client) {
  std::erase_if(clients_, [&](const Client& other) { return other.get() == &client; });
  if (clients_.empty()) {  // Resets the settings for the next client.
    asked_.reset();
    settings_.reset();
    wanted_.reset();
    ping_timer_.cancel();
    send_timer_.cancel();
    last_client_ = {};
  }
}

void OculusServer::refuse(const OculusClient& client, const std::string& reason) {
  report_.note_refusal();
  warn_once(fmt::format("ignored, from {}: {}", client.address().to_string(), reason));
}

void OculusServer::warn_once(const std::string& text) {
  if (warnings_.size() < kMostWarnings && warnings_.insert(text).second) {
    complain("warning: " + text);
    if (warnings_.size() == kMostWarnings) {
      complain("warning: further ones are counted only, for the report");
    }
  }
}

void OculusServer::take(OculusClient& client, const OculusMessage& message) {
  switch (message.id) {
    case kOculusFire:
      try {
        const OculusFire asked = decode_fire(message);
        client.layout = asked.layout;
        wanted_ = asked;
        net::post(loop_.context(), [this] { obey(); });  // Once for all messages that arrived together.
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

// Applies the settings of the last fire message, but not while a ping is being made.
void OculusServer::obey() {
  if (pinging_ || !wanted_) {
    return;
  }
  const OculusFire asked = *std::exchange(wanted_, {});
  if (asked_ == asked) {
    return;
  }
  std::vector<std::string> notes;
  try {
    settings_ = pings_.apply(asked, notes);
    asked_ = asked;
    schedule();
  } catch (const Error& error) {
    report_.note_refusal();
    notes.push_back(fmt::format("ignored: {}", error.what()));
  }
  for (const std::string& note : notes) {
    warn_once(note);
  }
}

// A ping that takes longer than the period delays the next, and later ones catch up. The schedule restarts after a loss
// of a whole period.
void OculusServer::schedule() {
  ping_timer_.cancel();
  if (!settings_ || settings_->plan.period == 0) {
    return;
  }
  const WallClock::duration period = wall_clock_duration(settings_->plan.period);
  const WallClock::time_point earliest = std::max(WallClock::now(), listening_until_);
  const WallClock::time_point due = last_due_ && *last_due_ + 2 * period > earliest ? *last_due_ + period : earliest;
  ping_timer_.expires_at(std::max(due, earliest));
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
    std::shared_ptr<const OculusPings::Received> received;
    std::string failure;
    try {
      received = std::make_shared<const OculusPings::Received>(pings_.make(*settings));
    } catch (const Interrupted&) {
      return;  // The end of the program: EventLoop sees it too.
    } catch (const Error& error) {
      failure = error.what();
    }
    net::post(loop_.context(), [this, received, failure] { pinged(received, failure); });
  });
}

void OculusServer::pinged(const std::shared_ptr<const OculusPings::Received>& received, const std::string& failure) {
  pinging_ = false;
  if (!failure.empty()) {
    warn_once("no ping: " + failure);
  }
  if (received && settings_) {
    listening_until_ = received->received_at();
    send_timer_.expires_at(listening_until_);
    send_timer_.async_wait([this, received](error_code cancelled) {
      if (!cancelled) {
        send_ping(*received);
      }
    });
  }
  obey();
  schedule();
}

void OculusServer::send_ping(const OculusPings::Received& received) {
  std::array<OculusClient::Bytes, 2> in_layout;
  for (const Client& client : clients_) {
    OculusClient::Bytes& bytes = in_layout.at(static_cast<std::size_t>(client->layout - 1));
    if (!bytes) {
      OculusPing result = received.result;
      result.fire.layout = client->layout;
      bytes = shared(encode(result));
    }
    if (!client->send_ping(bytes)) {
      report_.note_drop();
    }
  }
  report_.note(received.transmitted, received.computing_time);
}

// Drivers send fire or dummy messages all the time. One that is gone without a word would keep its place.
void OculusServer::end_silent_clients() {
  const auto now = std::chrono::steady_clock::now();
  for (const Client& client : std::vector<Client>(clients_)) {  // forget() changes the list.
    if (now - client->last_heard() > silence_) {
      warn_once(fmt::format("{} has sent nothing for {:.6g} s: disconnected", client->address().to_string(),
                            silence_.count()));
      client->end();
    }
  }
}

void OculusServer::beat() {
  end_silent_clients();
  send_status();
  if (!asked_ || oculus_ping_rate(asked_->ping_rate) == 0) {
    const OculusClient::Bytes dummy =
        shared(encode(OculusMessage{.id = kOculusDummy, .source = pings_.status().device}));
    for (const Client& client : clients_) {
      client->send(dummy);  // May be dropped if the queue is full.
    }
  }
  beat_timer_.expires_after(kBeat);
  beat_timer_.async_wait([this](error_code) { beat(); });
}

OculusStatus OculusServer::status() const {
  OculusStatus status = pings_.status();
  status.address = network_.address.to_bytes();
  status.mask = network_.mask.to_bytes();
  status.client = last_client_.to_bytes();
  return status;
}

void OculusServer::send_status() {
  error_code failure;
  status_socket_.send_to(net::buffer(encode(status())), {network_.broadcast, kStatusPort}, 0, failure);
  if (failure && failure != net::error::connection_refused) {  // Refused: no listener, on loopback.
    warn_once(fmt::format("no status to UDP {}: {}", status_address(), failure.message()));
  }
}

}  // namespace insonify
