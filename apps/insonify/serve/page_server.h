// page_server.h -- serves the viewer's page, its connections and Foxglove's on one port.

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "console/command.h"
#include "insonify/messages.h"
#include "serve/ping_source.h"

namespace insonify {

class FoxgloveFeed;
class Hub;
class NetServer;

struct PageServerOptions {
  int port = 8765;  ///< 0: any free port.
  std::string address = "127.0.0.1";
  std::string token;                 ///< "": a new one.
  bool no_token = false;             ///< None; loopback only.
  std::vector<std::string> origins;  ///< Other pages allowed to connect without a token.
  bool quiet = false;                ///< Print only the address, warnings and errors.
  MessageOptions messages;           ///< For Foxglove's messages.
  std::filesystem::path page;        ///< Folder to serve the page from; empty: the embedded page.
};

/// Adds the options of a server.
void add_server_options(const Command& command, PageServerOptions& options);

class PageServer {
 public:
  /// Binds the port.
  /// @throws InputError for invalid options, Error for a port in use.
  explicit PageServer(const PageServerOptions& options);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// Starts a source, prints the addresses, serves until SIGINT or SIGTERM, then ends the source. To be called once.
  /// @param recording  File name from which names of recordings are derived.
  /// @param started    Called after the source has started, before the addresses are printed.
  /// @throws Error as PingSource::end(), and what `started` throws.
  void show(PingSource& source, const std::filesystem::path& recording, const std::function<void()>& started = {});

 private:
  PageServerOptions options_;
  Hub* hub_ = nullptr;            // Set while show() runs, and so is ...
  FoxgloveFeed* feed_ = nullptr;  // ... this one.
  std::unique_ptr<NetServer> server_;
};

}  // namespace insonify
