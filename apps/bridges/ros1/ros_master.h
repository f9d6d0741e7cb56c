// ros_master.h -- queries roscore: whether it answers, and what it knows of this node.

#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>
#include <string>

namespace insonify {

/// roscore's entry for a node.
struct RosRegistration {
  bool known = false;
  std::string uri = {};  ///< Address of the program that has the node's name, "http://host:port/"; empty where unknown.
};

/// A client of roscore or of a node. roscpp's own calls would block until it answers.
class RosMaster {
 public:
  /// @param uri  "http://localhost:11311"
  /// @throws InputError for any other form.
  explicit RosMaster(std::string uri);

  [[nodiscard]] const std::string& uri() const { return uri_; }

  /// Its process id; empty if it does not answer.
  [[nodiscard]] std::optional<int> pid() const;

  /// Empty if it does not answer.
  /// @param node  "/insonify"
  [[nodiscard]] std::optional<RosRegistration> lookup(const std::string& node) const;

  /// The value that a call returns; empty without an answer or on failure.
  [[nodiscard]] std::optional<XmlRpc::XmlRpcValue> call(const char* method, const XmlRpc::XmlRpcValue& request) const;

  /// Waits until it answers and returns its process id. Reports the wait if there was one.
  [[nodiscard]] int wait() const;

 private:
  std::string uri_;
  std::string host_;
  int port_ = 0;
};

/// Address of roscore: __master:=URI on the command line, or else ROS_MASTER_URI.
[[nodiscard]] std::string ros_master_uri(int argc, const char* const* argv);

}  // namespace insonify
