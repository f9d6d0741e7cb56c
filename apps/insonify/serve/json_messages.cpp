// json_messages.cpp -- reads members of messages and checks their types.

#include "serve/json_messages.h"

#include <fmt/format.h>

namespace insonify {
namespace {

using nlohmann::json;

double number_in(const json& value, const char* key) {
  if (!value.is_number()) {
    throw FormError(fmt::format("\"{}\" must be a number", key));
  }
  return value.get<double>();
}

}  // namespace

const json& member(const json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end()) {
    throw FormError(fmt::format("a message of this op must have \"{}\"", key));
  }
  return *found;
}

std::string text_of(const json& message, const char* key) {
  const json& value = member(message, key);
  if (!value.is_string()) {
    throw FormError(fmt::format("\"{}\" must be a text", key));
  }
  return value.get<std::string>();
}

bool switch_of(const json& message, const char* key) {
  const json& value = member(message, key);
  if (!value.is_boolean()) {
    throw FormError(fmt::format("\"{}\" must be true or false", key));
  }
  return value.get<bool>();
}

double number_of(const json& message, const char* key) {
  return number_in(member(message, key), key);
}

std::vector<std::string> texts_of(const json& message, const char* key) {
  const json& value = member(message, key);
  std::vector<std::string> texts;
  for (const json& one : value.is_array() ? value : json::array({nullptr})) {
    if (!one.is_string()) {
      throw FormError(fmt::format("\"{}\" must be a list of texts", key));
    }
    texts.push_back(one.get<std::string>());
  }
  return texts;
}

Eigen::VectorXd numbers_of(const json& message, const char* key, int count) {
  const json& value = member(message, key);
  if (!value.is_array() || value.size() != static_cast<std::size_t>(count)) {
    throw FormError(fmt::format("\"{}\" must be a list of {} numbers", key, count));
  }
  Eigen::VectorXd numbers(count);
  for (int i = 0; i < count; ++i) {
    numbers[i] = number_in(value[static_cast<std::size_t>(i)], key);
  }
  return numbers;
}

}  // namespace insonify
