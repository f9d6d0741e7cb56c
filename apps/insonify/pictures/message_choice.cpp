// message_choice.cpp -- command-line options for recordings of ROS messages.

#include "pictures/message_choice.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "console/validators.h"
#include "insonify/error.h"

namespace insonify {
namespace {

CLI::Validator start_time() {
  const auto check = [](const std::string& text) -> std::string {
    try {
      (void)start_from_text(text);
      return {};
    } catch (const Error& error) {
      return error.what();
    }
  };
  return CLI::Validator(check, "");
}

}  // namespace

std::vector<std::string> MessageChoice::given() const {
  std::vector<std::string> names;
  if (fan_rate) {
    names.emplace_back("--fan-rate");
  }
  if (!start.empty()) {
    names.emplace_back("--start");
  }
  return names;
}

void add_message_choice(CLI::App& command, MessageChoice& choice, const std::string& where,
                        const std::string& default_start) {
  command
      .add_option("--fan-rate", choice.fan_rate,
                  "Fan pictures " + where + " per second of ping time, at most; 0: none [2 for a scanning " +
                      "sonar, else one per ping]")
      ->check(number_within(from_to(0, 1000)))
      ->type_name("N");
  command
      .add_option("--start", choice.start,
                  "When the run started, for the times " + where +
                      ": the pings' time 0, such as 2026-06-01T10:00:00Z " + default_start)
      ->check(start_time())
      ->type_name("TIME");
}

MessageOptions message_options(const PictureStyle& style, const MessageChoice& choice) {
  MessageOptions messages{.colour_map = style.display.colour_map, .fan_rate = choice.fan_rate};
  if (!choice.start.empty()) {
    messages.start_ns = start_from_text(choice.start);
  }
  if (style.fixed_levels) {
    messages.high_db = 10 * std::log10(style.display.full_scale);
    messages.low_db = *messages.high_db + style.display.floor_db;
  }
  return messages;
}

}  // namespace insonify
