// sdf_fuel.cpp -- reads Fuel's URIs and walks through its caches.

#include "io/world/sdf_fuel.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "base/names.h"
#include "io/file/scene_folders.h"
#include "io/file/uri.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

struct FuelUri {
  std::string server, owner, name;
  std::string version;             // "" for the highest.
  std::vector<std::string> parts;  // Folders of a path within the model.
};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('/', start), text.size());
    if (end > start) {
      words.push_back(text.substr(start, end - start));
    }
    start = end + 1;
  }
  return words;
}

bool is_number(const std::string& text) {
  return !text.empty() && text.size() < 9 && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}

// Components of the path: API version, owner, "models", name, and then version and files. Empty for any other form, and
// for a name that would lead out of its folder.
std::vector<std::string> words_of_model(const std::string& uri) {
  const std::size_t scheme = uri.find("://");
  if (scheme == std::string::npos || (uri.substr(0, scheme) != "https" && uri.substr(0, scheme) != "http")) {
    return {};
  }
  std::vector<std::string> words = split(uri.substr(scheme + 3));
  const bool safe = std::ranges::none_of(words, [](const std::string& word) {
    const std::string plain = percent_decoded(word);
    return plain == ".." || plain == "." || plain.find('/') != std::string::npos;
  });
  return safe && words.size() >= 5 && words[3] == "models" ? words : std::vector<std::string>();
}

std::optional<FuelUri> parse(const std::string& uri) {
  const std::vector<std::string> words = words_of_model(uri);
  if (words.empty()) {
    return std::nullopt;
  }
  FuelUri found{
      lower_case(words[0]), lower_case(percent_decoded(words[2])), lower_case(percent_decoded(words[4])), "", {}};
  std::size_t next = 5;
  if (next < words.size() && (words[next] == "tip" || is_number(words[next]))) {
    found.version = words[next] == "tip" ? "" : words[next];
    ++next;
  }
  next += next < words.size() && words[next] == "files" ? 1 : 0;
  for (; next < words.size(); ++next) {
    found.parts.push_back(percent_decoded(words[next]));
  }
  return found;
}

// The entry of a folder with this name, whatever its case.
std::optional<fs::path> entry(const fs::path& folder, const std::string& name) {
  std::error_code failure;
  for (fs::directory_iterator at(folder, failure), end; !failure && at != end; at.increment(failure)) {
    if (lower_case(at->path().filename().string()) == name) {
      return at->path();
    }
  }
  return std::nullopt;
}

std::optional<fs::path> version_in(const fs::path& model, const std::string& wanted) {
  std::optional<fs::path> best;
  int highest = -1;
  std::error_code failure;
  for (fs::directory_iterator at(model, failure), end; !failure && at != end; at.increment(failure)) {
    const std::string name = at->path().filename().string();
    if (!is_number(name) || !at->is_directory(failure) || (!wanted.empty() && std::stoi(name) != std::stoi(wanted))) {
      continue;
    }
    if (std::stoi(name) > highest) {
      highest = std::stoi(name);
      best = at->path();
    }
  }
  return best;
}

}  // namespace

bool is_fuel_uri(const std::string& uri) {
  return parse(uri).has_value();
}

std::string fuel_model_uri(const std::string& uri) {
  const std::vector<std::string> words = words_of_model(uri);
  if (words.empty()) {
    return uri;
  }
  const bool versioned = words.size() > 5 && is_number(words[5]);
  return fmt::format("{}://{}", uri.substr(0, uri.find("://")),
                     fmt::join(words.begin(), words.begin() + (versioned ? 6 : 5), "/"));
}

std::optional<fs::path> find_fuel_uri(const std::string& uri) {
  const std::optional<FuelUri> wanted = parse(uri);
  if (!wanted) {
    return std::nullopt;
  }
  const std::vector<std::string> known{"fuel.gazebosim.org", "fuel.ignitionrobotics.org"};
  std::vector<std::string> servers{wanted->server};
  if (std::ranges::count(known, wanted->server) > 0) {
    servers.insert(servers.end(), known.begin(), known.end());
  }
  for (const fs::path& cache : fuel_caches()) {
    for (const std::string& server : servers) {
      const auto owner = entry(cache / server, wanted->owner);
      const auto name = owner ? entry(*owner / "models", wanted->name) : std::nullopt;
      std::optional<fs::path> found = name ? version_in(*name, wanted->version) : std::nullopt;
      for (const std::string& part : wanted->parts) {
        found = found ? std::optional(*found / part) : std::nullopt;
      }
      std::error_code ignored;
      if (found && fs::exists(*found, ignored)) {
        return found;
      }
    }
  }
  return std::nullopt;
}

std::string fuel_uri_not_found() {
  std::vector<std::string> folders;
  for (const fs::path& cache : fuel_caches()) {
    folders.push_back(cache.string());
  }
  return fmt::format("is not in the caches of Fuel ({})", fmt::join(folders, ", "));
}

}  // namespace insonify
