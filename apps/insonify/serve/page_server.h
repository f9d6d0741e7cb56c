// page_server.h -- the viewer's page, its connections and Foxglove's on one port.

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "insonify/messages.h"
#include "serve/ping_source.h"

namespace insonify {

class FoxgloveFeed;
class Hub;
class NetServer;

struct PageServerOptions {
  int port = 8765;  ///< 0: any that is free.
  std::string address = "127.0.0.1";
  std::string token;                 ///< "" for none: loopback only.
  std::vector<std::string> origins;  ///< Other pages that may connect without a token.
  bool quiet = false;                ///< Print only the address, warnings and errors.
  MessageOptions messages;           ///< How Foxglove is told of pings.
  std::filesystem::path page;        ///< Folder to serve the page from; empty: that in the program.
};

class PageServer {
 public:
  /// Binds the port.
  /// @throws InputError for options that cannot be, Error for a port that is in use.
  explicit PageServer(const PageServerOptions& options);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// Starts a source, prints the addresses, and serves until SIGINT or SIGTERM; then ends the source. Once.
  /// @param recording  A file that names of recordings are made from.
  /// @param started    Called when the source has been started, before the addresses are printed.
  /// @throws Error as PingSource::end(), and what `started` throws.
  void show(PingSource& source, const std::filesystem::path& recording, const std::function<void()>& started = {});

 private:
  PageServerOptions options_;
  Hub* hub_ = nullptr;            // While show() runs, as ...
  FoxgloveFeed* feed_ = nullptr;  // ... this one.
  std::unique_ptr<NetServer> server_;
};

}  // namespace insonify
