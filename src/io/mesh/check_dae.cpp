// check_dae.cpp -- one pass over the elements.

#include "io/mesh/check_dae.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/xml_scan.h"
#include "io/mesh/scene_depth.h"

namespace insonify {
namespace {

// The kinds of elements that an <instance_...> may name.
const std::map<std::string, std::set<std::string>> kInstances = {{"instance_geometry", {"geometry"}},
                                                                 {"instance_controller", {"controller", "geometry"}},
                                                                 {"instance_node", {"node"}}};

}  // namespace

void check_dae(std::string_view text, const std::filesystem::path& path) {
  const std::vector<XmlTag> tags = scan_xml(text, path.string());
  std::map<std::string, std::size_t> named;  // By kind and reference: "node #ship".
  for (std::size_t i = 0; i < tags.size(); ++i) {
    named.emplace(fmt::format("{} #{}", tags[i].name, tags[i].attribute("id")), i);
  }
  // A node hangs on what it stands in; and what an <instance_node> names, on that element.
  std::vector<NodeLink> links;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (tags[i].parent >= 0) {
      links.push_back({static_cast<std::size_t>(tags[i].parent), i});
    }
    const auto kinds = kInstances.find(tags[i].name);
    const std::string url = tags[i].attribute("url");
    if (kinds == kInstances.end() || !url.starts_with('#')) {
      continue;  // assimp refuses other references.
    }
    bool is_there = false;
    for (const std::string& kind : kinds->second) {
      if (const auto target = named.find(fmt::format("{} {}", kind, url)); target != named.end()) {
        is_there = true;
        links.push_back({i, target->second});
      }
    }
    if (!is_there) {
      throw Error(fmt::format("{}<{}> names {}, which is not in this file", tags[i].where(path.string()), tags[i].name,
                              printable(url)));
    }
  }
  check_depth(tags.size(), links, path);
}

}  // namespace insonify
