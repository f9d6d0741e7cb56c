// viewer_client.h -- the connection to one page: subprotocol insonify.viewer.v1 (docs/design/viewer.md).

#pragma once

#include "serve/hub.h"

namespace insonify {

inline constexpr std::string_view kViewerProtocol = "insonify.viewer.v1";

/// @param hub  Must outlive the client.
[[nodiscard]] std::unique_ptr<Client> make_viewer_client(Connection& connection, Hub& hub);

}  // namespace insonify
