// message_members.h -- reads members of a page's messages and checks their types.

#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "insonify/error.h"

namespace insonify {

/// A malformed message: it ends the connection. Invalid values are answered with an error instead.
class FormError : public Error {
 public:
  using Error::Error;
};

/// All functions here throw FormError for a missing key or a value of the wrong type.
[[nodiscard]] const nlohmann::json& member(const nlohmann::json& message, const char* key);
[[nodiscard]] std::string text_of(const nlohmann::json& message, const char* key);
[[nodiscard]] bool switch_of(const nlohmann::json& message, const char* key);
[[nodiscard]] double number_of(const nlohmann::json& message, const char* key);
[[nodiscard]] std::vector<std::string> texts_of(const nlohmann::json& message, const char* key);

/// A list of `count` numbers.
[[nodiscard]] Eigen::VectorXd numbers_of(const nlohmann::json& message, const char* key, int count);

}  // namespace insonify
