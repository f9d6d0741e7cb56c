// json_messages.cpp -- reads members of messages and checks their types.

#include "serve/json_messages.h"

#include <fmt/format.h>

#include <algorithm>

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

json parse_message(std::string_view text) {
  static constexpr int kDeepest = 32;
  const auto check_depth = [](int depth, json::parse_event_t event, const json& /*value*/) {
    const bool opens = event == json::parse_event_t::object_start || event == json::parse_event_t::array_start;
    if (opens && depth >= kDeepest) {
      throw FormError(fmt::format("the message is more than {} brackets deep", kDeepest));
    }
    return true;
  };
  return json::parse(text, check_depth, false);
}

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
  if (!value.is_array() || !std::ranges::all_of(value, [](const json& one) { return one.is_string(); })) {
    throw FormError(fmt::format("\"{}\" must be a list of texts", key));
  }
  return value.get<std::vector<std::string>>();
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
