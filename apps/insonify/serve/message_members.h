// message_members.h -- members of a page's messages, checked for their form.

#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "insonify/error.h"

namespace insonify {

/// What is wrong with the form of a message: it ends the connection. What is wrong with a value is answered.
class FormError : public Error {
 public:
  using Error::Error;
};

/// @throws FormError where a message lacks the key, or its value is of another kind: all functions here.
[[nodiscard]] const nlohmann::json& member(const nlohmann::json& message, const char* key);
[[nodiscard]] std::string text_of(const nlohmann::json& message, const char* key);
[[nodiscard]] bool switch_of(const nlohmann::json& message, const char* key);
[[nodiscard]] double number_of(const nlohmann::json& message, const char* key);
[[nodiscard]] std::vector<std::string> texts_of(const nlohmann::json& message, const char* key);

/// A list of `count` numbers.
[[nodiscard]] Eigen::VectorXd numbers_of(const nlohmann::json& message, const char* key, int count);

}  // namespace insonify
