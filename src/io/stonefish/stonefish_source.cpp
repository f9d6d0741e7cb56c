// stonefish_source.cpp -- reads files, replaces arguments and follows includes.

#include "io/stonefish/stonefish_source.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "insonify/printable.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/stonefish/stonefish_files.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

// The value of the `arg NAME`, `param NAME` or `find NAME` in a $(...); nothing if it has none.
std::optional<std::string> value_of(const std::string& call, const std::map<std::string, std::string>& arguments,
                                    const fs::path& path) {
  const std::size_t space = call.find(' ');
  const std::string verb = call.substr(0, space);
  const std::string name = space == std::string::npos ? "" : without_outer_space(call.substr(space));
  if (verb == "arg" || verb == "param") {
    auto found = arguments.find(name);
    found = found == arguments.end() ? arguments.find(name.substr(name.rfind('/') + 1)) : found;
    return found == arguments.end() ? std::nullopt : std::optional(found->second);
  }
  if (verb == "find") {
    const std::optional<fs::path> folder = find_ros_package(name, path);
    return folder ? std::optional(folder->string()) : std::nullopt;
  }
  return std::nullopt;
}

// A text with each $(...) that has a value replaced by it.
std::string replaced(const std::string& text, const std::map<std::string, std::string>& arguments,
                     const fs::path& path) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t begin = text.find("$("); begin != std::string::npos; begin = text.find("$(", done)) {
    const std::size_t end = text.find(')', begin);
    if (end == std::string::npos) {
      break;
    }
    const std::optional<std::string> value = value_of(text.substr(begin + 2, end - begin - 2), arguments, path);
    result += text.substr(done, begin - done) + value.value_or(text.substr(begin, end + 1 - begin));
    done = end + 1;
  }
  return result + text.substr(done);
}

void replace_in(const XmlFile& file, const std::map<std::string, std::string>& arguments, const fs::path& path) {
  file.root().find_node([&](pugi::xml_node node) {
    for (pugi::xml_attribute attribute : node.attributes()) {
      if (std::string_view(attribute.value()).find("$(") == std::string_view::npos) {
        continue;
      }
      const std::string text = replaced(attribute.value(), arguments, path);
      if (text.size() > kLongestStonefishAttribute) {
        throw Error(fmt::format("{}<{}> {} has {} bytes with its arguments, must be at most {}", file.where(node),
                                printable(node.name()), printable(attribute.name()), text.size(),
                                kLongestStonefishAttribute));
      }
      attribute.set_value(text.c_str());
    }
    return false;
  });
}

std::shared_ptr<const XmlFile> open_scenario(const std::string& shown) {
  auto file = std::make_shared<const XmlFile>(xml_in_utf8(read_text(shown)), shown);
  if (file->root().name() != std::string_view("scenario")) {
    throw Error(fmt::format("{}the root element is <{}>, not <scenario>", file->where(file->root()),
                            printable(file->root().name())));
  }
  return file;
}

}  // namespace

StonefishSource::StonefishSource(const fs::path& file, std::span<const std::string> arguments, MissingParts& missing)
    : missing_(missing) {
  for (const std::string& argument : arguments) {
    const std::size_t equals = std::min(argument.find('='), argument.size());
    given_[argument.substr(0, equals)] = argument.substr(std::min(equals + 1, argument.size()));
  }
  read(open_scenario(file.string()), fs::absolute(file).lexically_normal(), given_);
}

void StonefishSource::read(const std::shared_ptr<const XmlFile>& file, const fs::path& path,
                           const Arguments& arguments) {
  nodes_ += file->nodes();
  check_budget(Budget::kNodes, nodes_, path.string());
  replace_in(*file, arguments, path);
  open_.insert(path);
  std::vector<StonefishElement> includes;
  for (const pugi::xml_node node : file->root().children()) {
    if (node.type() == pugi::node_element) {
      const bool is_include = node.name() == std::string_view("include");
      (is_include ? includes : elements_).push_back({node, file, path});
    }
  }
  for (const StonefishElement& element : includes) {
    include(element);
  }
  open_.erase(path);
}

// The arguments that an <include> passes, and the user's where it does not.
std::map<std::string, std::string> StonefishSource::arguments_of(const StonefishElement& include) const {
  Arguments arguments = given_;
  for (const pugi::xml_node node : include.node.children("arg")) {
    if (!node.attribute("name") || !node.attribute("value")) {
      throw Error(include.file->where(node) + "<arg> must have a name and a value");
    }
    arguments[node.attribute("name").value()] = node.attribute("value").value();
  }
  return arguments;
}

void StonefishSource::include(const StonefishElement& element) {
  std::string part = element.what();
  std::shared_ptr<const XmlFile> file;
  std::optional<fs::path> found;
  try {
    const std::string name = stonefish_text(element, "", "file");
    part += fmt::format(" '{}'", printable(name, kLongestName));
    found = find_stonefish_file(name, element.path);
    if (!found) {
      missing_.add(part, stonefish_file_not_found(name, element.path));
      return;
    }
    file = open_scenario(found->string());
  } catch (const UnreadablePart& unreadable) {
    missing_.add(unreadable);
    return;
  } catch (const Error& error) {
    missing_.add(part, fmt::format(": {}", error.what()));
    return;
  }
  if (open_.contains(*found)) {
    throw Error(part + " includes itself");
  }
  if (++included_ > kMostStonefishIncludes) {
    throw Error(fmt::format("{} is one of more than {} files that are included", part, kMostStonefishIncludes));
  }
  read(file, *found, arguments_of(element));
}

}  // namespace insonify
