// message_source.cpp -- properties of a sonar that its messages need, and names of its topics.

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "insonify/error.h"
#include "insonify/files.h"
#include "insonify/messages.h"
#include "insonify/printable.h"
#include "io/message/ros_name.h"

namespace insonify {

MessageSource message_source(const Scenario& scenario, const SonarConfig& sonar) {
  MessageSource source{sonar,
                       scenario.model,
                       scenario.receiver_of(sonar),
                       scenario.text.empty() ? to_yaml(scenario) : scenario.text,
                       {}};
  if (!source.sonar.assumed_sound_speed) {
    source.sonar.assumed_sound_speed = scenario.water_at(sonar).true_sound_speed();
  }
  std::vector<std::string> names;
  for (const SonarConfig& other : scenario.sonars) {
    names.push_back(other.name);
  }
  if (const auto own = std::ranges::find(names, sonar.name); own != names.end()) {
    source.name = ros_names(names)[static_cast<std::size_t>(own - names.begin())];
  }
  return source;
}

void name_topics(std::vector<MessageSource>& sources) {
  std::vector<std::string> names;
  std::set<std::string> sonars;
  for (const MessageSource& source : sources) {
    if (!sonars.insert(source.sonar.name).second) {
      throw Error(fmt::format("there are two sonars called {}; their names must differ", printable(source.sonar.name)));
    }
    names.push_back(source.name.empty() ? source.sonar.name : source.name);
  }
  names = ros_names(names);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    sources[i].name = names[i];
  }
}

}  // namespace insonify
