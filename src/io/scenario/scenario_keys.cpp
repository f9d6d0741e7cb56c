// scenario_keys.cpp -- lists of keys, made from what each configuration says of its fields.

#include "io/scenario/scenario_keys.h"

#include <array>

#include "insonify/scenario.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

// Keys that stand for a part of the scenario instead of a plain value.
constexpr std::array kPartKeys = {"water",       "materials", "sonars",     "receiver", "paper", "points",
                                  "interferers", "surface",   "trajectory", "motions",  "view"};

}  // namespace

std::vector<std::string> scenario_keys() {
  std::vector<std::string> keys = keys_of<Scenario>();
  keys.push_back(keys_of<MaterialRules>().front());
  keys.insert(keys.end(), kPartKeys.begin(), kPartKeys.end());
  return keys;
}

std::vector<std::string> sonar_keys() {
  std::vector<std::string> keys = keys_of<SonarConfig>();
  keys.insert(keys.end(), {"preset", "mode", "sampling"});
  return keys;
}

std::vector<std::string> part_keys(const char* sampling) {
  std::vector<std::string> all;
  for (const auto& [part, keys] :
       {std::pair{"water", keys_of<Water>()}, std::pair{"receiver", keys_of<ReceiverConfig>()},
        std::pair{"paper", keys_of<PaperModel>()}, std::pair{"surface", keys_of<SeaSurface>()},
        std::pair{"view", keys_of<ViewConfig>()}, std::pair{sampling, keys_of<Sampling>()}}) {
    for (const std::string& key : keys) {
      all.push_back(member_name(part, key));
    }
  }
  return all;
}

}  // namespace insonify
