// error.cpp -- printable messages that begin with a place, and the search for the place of a setting.

#include "insonify/error.h"

#include "insonify/printable.h"

namespace insonify {
namespace {

// "sonars[0].position[2]" is in "sonars[0].position", and that in "sonars[0]", in "sonars", in "".
std::string holder_of(const std::string& name) {
  const std::size_t end = name.find_last_of(".[");
  return name.substr(0, end == std::string::npos ? 0 : end);
}

}  // namespace

std::string Place::text() const {
  std::string text = file;
  for (const int number : {line, column}) {
    text += number > 0 ? ":" + std::to_string(number) : "";
  }
  return text.empty() ? text : text + ": ";
}

std::string member_name(std::string_view object, std::string_view key) {
  std::string name(object);
  name += object.empty() || key.empty() ? "" : ".";
  return name += key;
}

Error::Error(const std::string& message) : Error(message, About{}) {}

Error::Error(std::string_view object, std::string_view field, std::string_view rest, std::vector<std::string> related)
    : Error(printable(member_name(object, field), kLongestName) + std::string(rest),
            About{std::string(object), std::string(field), std::move(related), {}}) {}

Error::Error(const std::string& message, About about)
    : std::runtime_error(printable(message, kLongestMessage)),
      about_(std::make_shared<const About>(std::move(about))) {}

Error Error::at(const Place& place) const {
  if (!about_->place.file.empty()) {
    return *this;
  }
  About about = *about_;
  about.place = place;
  return {place.text() + what(), std::move(about)};
}

Error Error::located(const Places& places) const {
  std::string name = member_name(object(), field());
  if (name.empty()) {
    return *this;
  }
  std::vector<std::string> names = {name};
  if (const std::size_t index = field().find('[');
      index != std::string::npos) {  // The place of an element is that of its list.
    names.push_back(member_name(object(), field().substr(0, index)));
  }
  names.insert(names.end(), related().begin(), related().end());
  while (!name.empty()) {
    name = holder_of(name);
    names.push_back(name);
  }
  for (const std::string& candidate : names) {
    if (const auto found = places.find(candidate); found != places.end()) {
      return at(found->second);
    }
  }
  return *this;
}

}  // namespace insonify
