// sdf_source_places.cpp -- where libsdformat's files, lines and names are in the user's files.

#include <fmt/format.h>

#include <charconv>
#include <ranges>

#include "io/sdf/sdf_source.h"

namespace insonify {

namespace fs = std::filesystem;

std::string SdfSource::original(const std::string& path) const {
  const auto entry = originals_.find(path);
  return entry == originals_.end() ? path : entry->second;
}

std::string SdfSource::shown(const std::string& path) const {
  const std::string whole = original(path);
  return whole == fs::absolute(file_).lexically_normal() ? file_.string() : whole;
}

// libsdformat writes "path:L16", or the path alone.
std::string SdfSource::with_users_places(std::string text) const {
  for (const auto& [copy, user] : originals_ | std::views::reverse) {  // "fd/12" before "fd/1".
    for (std::size_t at = text.find(copy); at != std::string::npos; at = text.find(copy, at)) {
      const std::string_view rest = std::string_view(text).substr(at + copy.size());
      int line = 0;
      const char* end = rest.data();
      if (rest.starts_with(":L")) {
        end = std::from_chars(rest.data() + 2, rest.data() + rest.size(), line).ptr;
      }
      const Place found = place(copy, line, "");
      const std::string shown_place = found.line > 0 ? fmt::format("{}:{}", found.file, found.line) : shown(copy);
      text.replace(at, copy.size() + static_cast<std::size_t>(end - rest.data()), shown_place);
      at += shown_place.size();
    }
  }
  return text;
}

// The element at a line; null if it is ambiguous.
pugi::xml_node SdfSource::find(const std::string& path, int line, const std::string& element,
                               const std::string& name) const {
  const auto lines = lines_.find(path);
  if (lines == lines_.end()) {
    return {};
  }
  pugi::xml_node found;
  int candidates = 0;
  const auto has_name = [&](pugi::xml_node node) { return node.attribute("name").value() == name; };
  for (auto [at, end] = lines->second.equal_range(line); at != end; ++at) {
    if (at->second.name() == element) {
      found = !found || (!has_name(found) && has_name(at->second)) ? at->second : found;
      ++candidates;
    }
  }
  const bool is_certain = candidates == 1 || (found && has_name(found));
  return is_certain ? found : pugi::xml_node();
}

// Any element at a line; null if there is none.
pugi::xml_node SdfSource::any_at(const std::string& path, int line) const {
  const auto lines = lines_.find(path);
  const auto any = lines == lines_.end() ? Lines::const_iterator() : lines->second.find(line);
  return lines == lines_.end() || any == lines->second.end() ? pugi::xml_node() : any->second;
}

Place SdfSource::place(const std::string& path, int line, const std::string& element, const std::string& name) const {
  const auto file = sources_.find(original(path));
  if (file == sources_.end()) {
    return {shown(path)};
  }
  const XmlFile& xml = file->second->xml;
  if (const pugi::xml_node found = find(path, line, element, name)) {
    return xml.place(found);
  }
  const pugi::xml_node any = any_at(path, line);
  return any ? Place{shown(path), xml.line_of(any)} : Place{shown(path)};
}

Place SdfSource::place_within(const std::string& path, int line, const std::string& element, const std::string& name,
                              const std::string& inner, const std::string& inner_name) const {
  const pugi::xml_node found = find(path, line, element, name).find_node([&](pugi::xml_node node) {
    return node.name() == inner && node.attribute("name").value() == inner_name;
  });
  return found ? sources_.at(original(path))->xml.place(found) : place(path, line, element, name);
}

SdfFault SdfSource::fault(const std::string& message, const std::string& path, int line,
                          const std::string& element) const {
  const std::string& read = lines_.contains(path) ? path : portions_.back();
  const pugi::xml_node found = find(read, line, element, "");
  return {place(path, line, element).text() + message, sources_.at(original(read))->xml,
          found ? found : any_at(read, line)};
}

SdfFault SdfSource::fault(const std::string& message, const std::string& path,
                          const std::vector<std::string>& names) const {
  std::vector<std::string> files = includes_;
  files.push_back(portions_.back());
  for (const std::string& name : names) {
    const XmlFile* first_file = nullptr;
    std::vector<pugi::xml_node> found;
    for (auto file = files.rbegin(); file != files.rend(); ++file) {
      const XmlFile& xml = sources_.at(original(*file))->xml;
      for (const pugi::xml_node element : whole_sdf(xml.root()).elements) {
        if (element.find_attribute([&](pugi::xml_attribute attribute) { return attribute.value() == name; })) {
          found.push_back(element);
          first_file = first_file == nullptr ? &xml : first_file;
        }
      }
    }
    if (!found.empty()) {
      return {first_file->where(found[0]) + message, *first_file, found.size() == 1 ? found[0] : pugi::xml_node()};
    }
  }
  return {shown(path) + ": " + message, sources_.begin()->second->xml, pugi::xml_node()};
}

}  // namespace insonify
