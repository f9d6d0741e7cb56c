// ros_master.h -- whether roscore answers, and who this node is to it.

#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>
#include <string>

namespace insonify {

/// What roscore says of a node.
struct RosRegistration {
  bool known = false;
  std::string uri = {};  ///< Address of the program that has the node's name, "http://host:port/"; empty where unknown.
};

/// Speaks with roscore, or with a node. The calls of roscpp itself would wait until it answers.
class RosMaster {
 public:
  /// @param uri  "http://localhost:11311"
  /// @throws InputError for another form.
  explicit RosMaster(std::string uri);

  [[nodiscard]] const std::string& uri() const { return uri_; }

  /// Its process; empty where it does not answer.
  [[nodiscard]] std::optional<int> pid() const;

  /// Empty where it does not answer.
  /// @param node  "/insonify"
  [[nodiscard]] std::optional<RosRegistration> lookup(const std::string& node) const;

  /// The value that a call returns; empty where there is no answer or it is a refusal.
  [[nodiscard]] std::optional<XmlRpc::XmlRpcValue> call(const char* method, const XmlRpc::XmlRpcValue& request) const;

  /// Returns its process once it answers, and says so if that was not at once.
  [[nodiscard]] int wait() const;

 private:
  std::string uri_;
  std::string host_;
  int port_ = 0;
};

/// The address of roscore: __master:=URI among the words of the command line, or else ROS_MASTER_URI.
[[nodiscard]] std::string ros_master_uri(int argc, const char* const* argv);

}  // namespace insonify
