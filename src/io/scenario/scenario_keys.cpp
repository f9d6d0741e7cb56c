// scenario_keys.cpp -- lists of keys, from the configurations' lists of fields and parts.

#include "io/scenario/scenario_keys.h"

#include "insonify/scenario.h"
#include "io/scenario/preset_choice.h"
#include "io/scenario/yaml_read.h"

namespace insonify {
namespace {

// Adds the keys of parts that are single structs, as paths: "water.depth". Keys within lists have no fixed path.
template <typename Config>
void add_paths(const std::string& object, std::vector<std::string>& paths) {
  const Config config{};
  Config::visit_parts(config, [&]<typename Member>(const Part& part, const Member&) {
    const auto add_keys = [&](const std::vector<std::string>& keys) {
      for (const std::string& key : keys) {
        paths.push_back(member_name(member_name(object, part.name), key));
      }
    };
    if constexpr (requires(Member member) { member.has_value(); }) {
      add_keys(keys_of<typename Member::value_type>());
    } else if constexpr (!requires(Member member) { member.begin(); }) {
      add_keys(keys_of<Member>());
    }
  });
}

}  // namespace

std::vector<std::string> scenario_keys() {
  return keys_of<Scenario>();
}

std::vector<std::string> sonar_keys() {
  std::vector<std::string> keys = keys_of<PresetChoice>();
  const std::vector<std::string> own = keys_of<SonarConfig>();
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

std::vector<std::string> part_keys(const std::string& sonar) {
  std::vector<std::string> paths;
  add_paths<Scenario>("", paths);
  add_paths<SonarConfig>(sonar, paths);
  return paths;
}

}  // namespace insonify
