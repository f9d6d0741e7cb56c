// water_shapes.cpp -- compares the words of names, and the sides of boxes around shapes.

#include "io/world/water_shapes.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string>
#include <vector>

namespace insonify {
namespace {

// "SeaSurface_2" gives sea, surface.
std::vector<std::string> words_of_name(std::string_view name) {
  std::vector<std::string> words(1);
  bool was_lower = false;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    const bool begins = std::isupper(letter) != 0 && was_lower;
    if ((begins || std::isalpha(letter) == 0) && !words.back().empty()) {
      words.emplace_back();
    }
    if (std::isalpha(letter) != 0) {
      words.back() += static_cast<char>(std::tolower(letter));
    }
    was_lower = std::islower(letter) != 0;
  }
  if (words.back().empty()) {
    words.pop_back();
  }
  return words;
}

bool is_water_word(const std::string& word) {
  static const std::set<std::string_view> kWater = {
      "ocean",    "oceans", "sea",        "water",        "waters",       "wave",       "waves",     "wavefield",
      "seawater", "swell",  "seasurface", "watersurface", "oceansurface", "waterplane", "waterlevel"};
  return kWater.contains(word);
}

// Words that say nothing about what something is.
bool is_general_word(const std::string& word) {
  static const std::set<std::string_view> kGeneral = {
      "animated", "base",  "body",   "coast",   "collision", "dynamic", "fluid",  "geom",
      "geometry", "level", "link",   "main",    "mesh",      "model",   "plane",  "root",
      "shape",    "sheet", "static", "surface", "top",       "visual",  "volume", "world"};
  return word.size() == 1 || kGeneral.contains(word);
}

}  // namespace

bool is_water_name(std::string_view name) {
  while (!name.empty()) {
    const std::size_t colons = name.rfind("::");
    const std::vector<std::string> words =
        words_of_name(colons == std::string_view::npos ? name : name.substr(colons + 2));
    const bool has_water = std::ranges::any_of(words, is_water_word);
    const bool has_others = std::ranges::any_of(
        words, [](const std::string& word) { return !is_water_word(word) && !is_general_word(word); });
    if (has_water || has_others) {
      return !has_others;
    }
    name = name.substr(0, colons == std::string_view::npos ? 0 : colons);
  }
  return false;
}

bool is_level_sheet(const Instance& instance) {
  constexpr double kLeastLength = 1, kSlimness = 20;  // [m], 1
  Box3 box{Vec3::Constant(INFINITY), Vec3::Constant(-INFINITY)};
  for (const Vec3f& vertex : instance.mesh->vertices) {
    const Vec3 point = instance.world_from_mesh * vertex.cast<double>();
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  const Vec3 size = box.high - box.low;
  const double length = std::min(size.x(), size.y());
  return length >= kLeastLength && size.z() * kSlimness <= length;
}

}  // namespace insonify
