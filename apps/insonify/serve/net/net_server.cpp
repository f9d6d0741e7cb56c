// net_server.cpp -- accepts connections, and closes them all at a signal.

#include "serve/net/net_server.h"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <csignal>

#include "console/outcome.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "serve/net/net_session.h"

namespace insonify {

namespace net = boost::asio;
using boost::system::error_code;
using net::ip::tcp;

namespace {

constexpr std::chrono::milliseconds kClosingTime{500};  // For closing connections at the end.

}  // namespace

struct NetServer::State {
  explicit State(NetServerOptions options)
      : acceptor(context), signals(context), shared(std::make_shared<NetShared>()) {
    shared->options = std::move(options);
  }

  void accept() {
    acceptor.async_accept([this](error_code failure, tcp::socket socket) {
      if (failure == net::error::operation_aborted) {
        return;
      }
      if (!failure) {
        make_session(std::move(socket), shared)->start();
        accept();
        return;
      }
      // Possibly out of file descriptors: tries again after a pause.
      retry.expires_after(std::chrono::milliseconds(100));
      retry.async_wait([this](error_code) { accept(); });
    });
  }

  void repeat(std::chrono::milliseconds interval, const std::shared_ptr<net::steady_timer>& timer,
              const std::function<void()>& function) {
    timer->expires_after(interval);
    timer->async_wait([this, interval, timer, function](error_code failure) {
      if (!failure && !ending) {
        function();
        repeat(interval, timer, function);
      }
    });
  }

  void end() {
    if (std::exchange(ending, true)) {
      return;
    }
    error_code ignored;
    acceptor.close(ignored);
    signals.cancel(ignored);
    for (NetSession* session : std::vector<NetSession*>(shared->sessions)) {
      session->shut();
    }
    last.expires_after(kClosingTime);
    last.async_wait([this](error_code) { context.stop(); });
    watch_end();
  }

  // Ends with the last connection.
  void watch_end() {
    if (shared->sessions.empty()) {
      context.stop();
      return;
    }
    retry.expires_after(std::chrono::milliseconds(10));
    retry.async_wait([this](error_code) { watch_end(); });
  }

  net::io_context context{1};
  tcp::acceptor acceptor;
  net::signal_set signals;
  net::steady_timer retry{context}, last{context};
  std::shared_ptr<NetShared> shared;
  bool ending = false;
};

NetServer::NetServer(NetServerOptions options) : state_(std::make_unique<State>(std::move(options))) {
  State& state = *state_;
  const NetServerOptions& chosen = state.shared->options;
  error_code failure;
  const net::ip::address address =
      net::ip::make_address(chosen.address == "localhost" ? "127.0.0.1" : chosen.address, failure);
  if (failure) {
    throw InputError(fmt::format("--address {} must be an IP address, such as 127.0.0.1 or ::1, or localhost",
                                 printable(chosen.address)));
  }
  const tcp::endpoint endpoint(address, chosen.port);
  const auto attempt = [&](const auto& function) {
    if (!failure) {
      function();
    }
  };
  attempt([&] { state.acceptor.open(endpoint.protocol(), failure); });
  attempt([&] { state.acceptor.set_option(tcp::acceptor::reuse_address(true), failure); });
  attempt([&] { state.acceptor.bind(endpoint, failure); });
  attempt([&] { state.acceptor.listen(net::socket_base::max_listen_connections, failure); });
  if (failure) {
    throw Error(fmt::format("cannot listen on port {} of {}: {}", chosen.port, chosen.address, failure.message()));
  }
}

NetServer::~NetServer() = default;

std::uint16_t NetServer::port() const {
  return state_->acceptor.local_endpoint().port();
}

void NetServer::watch_signals() {
  State& state = *state_;
  state.signals.add(SIGINT);
  state.signals.add(SIGTERM);
  state.signals.add(SIGHUP);
  state.signals.async_wait([&state](error_code failure, int) {
    if (!failure) {
      state.end();
    }
  });
}

void NetServer::run() {
  State& state = *state_;
  state.accept();
  state.context.run();
  for (NetSession* session : state.shared->sessions) {
    session->forget_client();
  }
}

void NetServer::stop() {
  post([this] { state_->end(); });
}

void NetServer::post(std::function<void()> function) {
  net::post(state_->context, std::move(function));
}

void NetServer::every(std::chrono::milliseconds interval, const std::function<void()>& function) {
  state_->repeat(interval, std::make_shared<net::steady_timer>(state_->context), function);
}

}  // namespace insonify
