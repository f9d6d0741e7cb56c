// check_dae.cpp -- numbers the elements, links instances to what they name, and checks the depth.

#include "io/mesh/check_dae.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/xml_file.h"
#include "io/mesh/scene_depth.h"

namespace insonify {
namespace {

// The kinds of elements that an <instance_...> may name.
const std::map<std::string, std::set<std::string>> kInstances = {{"instance_geometry", {"geometry"}},
                                                                 {"instance_controller", {"controller", "geometry"}},
                                                                 {"instance_node", {"node"}}};

// Numbers all elements, each after its parent.
struct Numbering : pugi::xml_tree_walker {
  bool for_each(pugi::xml_node& node) override {
    if (node.type() != pugi::node_element) {
      return true;
    }
    const auto level = static_cast<std::size_t>(depth());
    open.resize(level + 1);
    open[level] = elements.size();
    if (level > 0) {
      links.push_back({open[level - 1], elements.size()});
    }
    elements.push_back(node);
    return true;
  }
  std::vector<pugi::xml_node> elements;
  std::vector<NodeLink> links;
  std::vector<std::size_t> open;  // The element being walked through at each level.
};

}  // namespace

void check_dae(std::string_view text, const std::filesystem::path& path) {
  const XmlFile xml(text, path.string());
  Numbering numbering;
  pugi::xml_node root = xml.root();
  root.traverse(numbering);
  const std::vector<pugi::xml_node>& elements = numbering.elements;
  std::map<std::string, std::size_t> named;  // By kind and reference: "node #ship".
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (const pugi::xml_attribute id = elements[i].attribute("id")) {
      named.emplace(fmt::format("{} #{}", elements[i].name(), id.value()), i);
    }
  }
  // Besides its parent element, a node depends on every <instance_node> that names it.
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto kinds = kInstances.find(elements[i].name());
    const std::string url = elements[i].attribute("url").value();
    if (kinds == kInstances.end() || !url.starts_with('#')) {
      continue;  // assimp refuses other references.
    }
    bool is_there = false;
    for (const std::string& kind : kinds->second) {
      if (const auto target = named.find(fmt::format("{} {}", kind, url)); target != named.end()) {
        is_there = true;
        numbering.links.push_back({i, target->second});
      }
    }
    if (!is_there) {
      throw Error(fmt::format("{}<{}> names {}, which is not in this file", xml.where(elements[i]), elements[i].name(),
                              printable(url)));
    }
  }
  check_depth(elements.size(), numbering.links, path);
}

}  // namespace insonify
