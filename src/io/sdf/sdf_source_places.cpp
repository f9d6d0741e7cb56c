// sdf_source_places.cpp -- where libsdformat's files, lines and names are in the user's files.

#include <fmt/format.h>

#include <charconv>

#include "io/sdf/sdf_elements.h"
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
  for (const auto& [copy, user] : originals_) {
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
pugi::xml_node SdfSource::find(const Source& source, int line, const std::string& element,
                               const std::string& name) const {
  pugi::xml_node found;
  int candidates = 0;
  const auto has_name = [&](pugi::xml_node node) { return node.attribute("name").value() == name; };
  for (auto [at, end] = source.lines.equal_range(line); at != end; ++at) {
    if (at->second.name() == element) {
      found = !found || (!has_name(found) && has_name(at->second)) ? at->second : found;
      ++candidates;
    }
  }
  const bool is_certain = candidates == 1 || (found && has_name(found));
  return is_certain ? found : pugi::xml_node();
}

Place SdfSource::place(const std::string& path, int line, const std::string& element, const std::string& name) const {
  const auto file = sources_.find(original(path));
  if (file == sources_.end()) {
    return {shown(path)};
  }
  const Source& source = *file->second;
  if (const pugi::xml_node found = find(source, line, element, name)) {
    return source.xml.place(found);
  }
  const auto any = source.lines.find(line);
  return any == source.lines.end() ? Place{shown(path)} : Place{shown(path), source.xml.line_of(any->second)};
}

Place SdfSource::place_within(const std::string& path, int line, const std::string& element, const std::string& name,
                              const std::string& inner, const std::string& inner_name) const {
  const auto file = sources_.find(original(path));
  const pugi::xml_node outer = file == sources_.end() ? pugi::xml_node() : find(*file->second, line, element, name);
  const pugi::xml_node found = outer.find_node(
      [&](pugi::xml_node node) { return node.name() == inner && node.attribute("name").value() == inner_name; });
  return found ? file->second->xml.place(found) : place(path, line, element, name);
}

SdfFault SdfSource::fault(const std::string& message, const std::string& path, int line,
                          const std::string& element) const {
  const Source& source = *sources_.at(sources_.contains(original(path)) ? original(path) : original(files_.back()));
  pugi::xml_node found = find(source, line, element, "");
  if (const auto any = source.lines.find(line); !found && any != source.lines.end()) {
    found = any->second;
  }
  return {place(path, line, element).text() + message, source.xml, found};
}

SdfFault SdfSource::fault(const std::string& message, const std::string& path,
                          const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    const XmlFile* first_file = nullptr;
    std::vector<pugi::xml_node> found;
    for (auto file = files_.rbegin(); file != files_.rend(); ++file) {
      const XmlFile& xml = sources_.at(original(*file))->xml;
      for (const pugi::xml_node element : sdf_elements_of(xml)) {
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
