// page_server.cpp -- checks access options, prints the addresses, and shuts down in the right order.

#include "serve/page_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <random>

#include "console/console.h"
#include "console/outcome.h"
#include "insonify/printable.h"
#include "serve/foxglove_feed.h"
#include "serve/hub.h"
#include "serve/page_files.h"

namespace insonify {
namespace {

bool is_link_local(const sockaddr& address) {
  if (address.sa_family == AF_INET) {
    constexpr in_addr_t kMask = 0xffff0000, kLinkLocal = 0xa9fe0000;  // 169.254.0.0/16, RFC 3927.
    return (ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr) & kMask) == kLinkLocal;
  }
  return IN6_IS_ADDR_LINKLOCAL(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr);
}

std::vector<std::string> addresses_of(const ifaddrs* interfaces, int family, socklen_t size) {
  std::vector<std::string> found;
  for (const ifaddrs* one = interfaces; one != nullptr; one = one->ifa_next) {
    const bool serves = (one->ifa_flags & IFF_UP) != 0 && (one->ifa_flags & IFF_LOOPBACK) == 0;
    if (!serves || one->ifa_addr == nullptr || one->ifa_addr->sa_family != family || is_link_local(*one->ifa_addr)) {
      continue;
    }
    std::array<char, NI_MAXHOST> text{};
    if (getnameinfo(one->ifa_addr, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) == 0) {
      found.emplace_back(text.data());
    }
  }
  return found;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data() : "localhost";
}

// Numeric addresses of the active network interfaces except loopback and link-local ones: IPv4, then IPv6 if requested.
// The name of this machine if there are none.
std::vector<std::string> own_addresses(bool with_ipv6) {
  std::vector<std::string> found;
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) == 0) {
    found = addresses_of(interfaces, AF_INET, sizeof(sockaddr_in));
    if (with_ipv6) {
      const std::vector<std::string> more = addresses_of(interfaces, AF_INET6, sizeof(sockaddr_in6));
      found.insert(found.end(), more.begin(), more.end());
    }
    freeifaddrs(interfaces);
  }
  if (found.empty()) {
    found.push_back(host_name());
  }
  return found;
}

// The query that a browser needs.
std::string url_of(const PageServerOptions& options, const std::string& host, std::uint16_t port) {
  const bool bracket = host.find(':') != std::string::npos;
  return fmt::format("http://{}{}{}:{}/{}{}", bracket ? "[" : "", host, bracket ? "]" : "", port,
                     options.token.empty() ? "" : "?token=", encoded(options.token));
}

// The first line is the address; others may follow when listening on all interfaces.
void print_addresses(const PageServerOptions& options, std::uint16_t port) {
  const bool all = options.address == "0.0.0.0" || options.address == "::";
  std::vector<std::string> hosts = all ? own_addresses(options.address == "::") : std::vector{options.address};
  hosts.resize(options.quiet ? 1 : hosts.size());
  for (const std::string& host : hosts) {
    say("{}\n", url_of(options, host, port));
  }
  flush_output();
}

// Says which engine computes, where `auto` has chosen it.
void print_engine(PingSource& source, bool quiet) {
  const LiveLoop* const loop = source.simulation();
  if (loop != nullptr && !quiet && !loop->world()->engine_choice.empty()) {
    say("{}\n", loop->world()->engine_choice);
    flush_output();
  }
}

void check(const PageServerOptions& options) {
  for (const std::string& origin : options.origins) {
    if (!is_origin(origin)) {
      throw InputError(
          fmt::format("--allow-origin {} must be a scheme and a host, such as https://app.example or "
                      "http://localhost:8080, without a path",
                      printable(origin)));
    }
  }
  if (options.no_token && !options.token.empty()) {
    throw InputError("--token and --no-token exclude each other");
  }
  if (options.no_token && !is_loopback(options.address)) {
    throw InputError(fmt::format("--address {} can be reached by others: --no-token is only for this machine",
                                 printable(options.address)));
  }
  if (!options.no_token && !options.origins.empty()) {
    throw InputError("--allow-origin has no effect without --no-token: pages of any origin may connect with the token");
  }
}

// 128 random bits.
std::string new_token() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

PageServerOptions with_token(PageServerOptions options) {
  if (options.token.empty() && !options.no_token) {
    options.token = new_token();
  }
  return options;
}

// Ends a source before its listeners, also on an exception.
class SourceEnd {
 public:
  explicit SourceEnd(PingSource& source) : source_(source) {}
  ~SourceEnd() {
    try {
      source_.end();
    } catch (const Error& error) {
      complain(error.what());
    }
  }
  SourceEnd(const SourceEnd&) = delete;
  SourceEnd& operator=(const SourceEnd&) = delete;

 private:
  PingSource& source_;
};

}  // namespace

void add_server_options(const Command& command, PageServerOptions& options) {
  command.option("--port", "N", &options.port, "Port; 0: any free port [8765]", whole_number(0, 65535));
  command.option("--address", "IP", &options.address, "Address to listen on [127.0.0.1]");
  command.option("--token", "T", &options.token, "Secret that every connection must send [a new one at each start]",
                 not_empty("a secret"));
  command.flag("--no-token", &options.no_token, "Programs and users of this machine connect without one");
  command.option("--allow-origin", "ORIGIN", &options.origins,
                 "With --no-token: web page of another origin that may connect; may be repeated");
  command.flag("-q,--quiet", &options.quiet, "Print only the address, warnings and errors");
  command.under("").option("--page", "DIR", &options.page, "Serve the page from this folder");
}

PageServer::PageServer(const PageServerOptions& options) : options_(with_token(options)) {
  check(options);
  server_ = std::make_unique<NetServer>(NetServerOptions{
      .address = options.address,
      .port = static_cast<std::uint16_t>(options.port),
      .access = {.token = options_.token, .origins = options.origins},
      .protocols = {std::string(kViewerProtocol), std::string(kFoxgloveSdkProtocol), std::string(kFoxgloveProtocol)},
      .file = [this](std::string_view path) { return page_file(path, options_.page); },
      .client =
          [this](Connection& connection, const std::string& protocol) {
            return protocol == kViewerProtocol ? make_viewer_client(connection, *hub_) : feed_->client(connection);
          }});
}

PageServer::~PageServer() = default;

void PageServer::show(PingSource& source, const std::filesystem::path& recording,
                      const std::function<void()>& started) {
  Hub hub(source, *server_, recording, options_.quiet);
  FoxgloveFeed feed(hub, options_.messages);
  hub_ = &hub;
  feed_ = &feed;
  const SourceEnd end(source);

  server_->watch_signals();
  source.start(hub);
  if (started) {
    started();
  }
  server_->every(std::chrono::seconds(1), [&hub] { hub.send_state(); });
  print_addresses(options_, server_->port());
  print_engine(source, options_.quiet);
  server_->run();
  source.end();
}

}  // namespace insonify
