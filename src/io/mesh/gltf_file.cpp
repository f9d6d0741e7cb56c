// gltf_file.cpp -- parses glTF and GLB, loads buffers, and converts the numbers of accessors.

#include "io/mesh/gltf_file.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "base/utf8.h"
#include "insonify/error.h"
#include "insonify/printable.h"
#include "io/file/budgets.h"
#include "io/file/input_file.h"
#include "io/file/uri.h"

namespace insonify {
namespace {

constexpr std::size_t kMost = std::size_t{1} << 40;  // Largest count or offset: their products do not overflow.

std::size_t bytes_of_component(int type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

std::size_t components_of(const std::string& type) {
  static const std::map<std::string, std::size_t> kComponents = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  const auto found = kComponents.find(type);
  return found == kComponents.end() ? 0 : found->second;
}

// A number in a buffer; a normalised one as -1..1, or 0..1 without a sign.
template <typename Stored>
float stored_number(const char* at, bool normalized) {
  Stored value{};
  std::memcpy(&value, at, sizeof value);
  const auto number = static_cast<double>(value);
  if (!normalized || std::is_floating_point_v<Stored>) {
    return static_cast<float>(number);
  }
  return static_cast<float>(std::max(number / static_cast<double>(std::numeric_limits<Stored>::max()), -1.0));
}

float number_of_type(int type, const char* at, bool normalized) {
  switch (type) {
    case 5120:
      return stored_number<std::int8_t>(at, normalized);
    case 5121:
      return stored_number<std::uint8_t>(at, normalized);
    case 5122:
      return stored_number<std::int16_t>(at, normalized);
    case 5123:
      return stored_number<std::uint16_t>(at, normalized);
    case 5125:
      return stored_number<std::uint32_t>(at, normalized);
    default:
      return stored_number<float>(at, normalized);
  }
}

// Four characters are three bytes. What is not one of the 64 is skipped; the first '=' ends the text.
std::string base64_decoded(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) {
      continue;
    }
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xffU);
    }
  }
  return bytes;
}

// The bytes of "data:application/octet-stream;base64,AAAA".
std::string bytes_of_data_uri(const std::string& uri) {
  const std::size_t comma = std::min(uri.find(','), uri.size() - 1);
  const std::string_view data = std::string_view(uri).substr(comma + 1);
  return uri.substr(0, comma).find(";base64") == std::string::npos ? percent_decoded(data) : base64_decoded(data);
}

// A backslash in JSON is two.
constexpr std::string_view kJsonEscape = "\\\\x";

std::uint32_t number_at(const std::string& text, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, text.data() + at, sizeof number);
  return number;
}

}  // namespace

GltfFile::GltfFile(const std::filesystem::path& path) : path_(path) {
  std::string text = read_text(path);
  if (ending_of(path) == ".glb") {
    read_glb(text);
    return;
  }
  text = as_utf8(text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0), kJsonEscape);
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::string_view before = std::string_view(text).substr(0, std::max<std::size_t>(error.byte, 1) - 1);
    const auto line = static_cast<int>(std::ranges::count(before, '\n')) + 1;
    const auto column = static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1;
    throw Error("not valid JSON").at({path_.string(), line, column});
  }
}

// A header of 12 bytes, then chunks, each with its length and its kind before it: JSON, and bytes of the first buffer.
void GltfFile::read_glb(const std::string& text) {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (text.size() < kHeader + kChunkHeader || !text.starts_with("glTF")) {
    fail("what it holds is not GLB");
  }
  if (number_at(text, 8) != text.size()) {
    fail(fmt::format("its header says that it has {} bytes, not {}", number_at(text, 8), text.size()));
  }
  std::vector<std::string> chunks;
  for (std::size_t at = kHeader; at + kChunkHeader <= text.size();) {
    const std::size_t size = number_at(text, at);
    if (size > text.size() - at - kChunkHeader) {
      fail("a chunk is longer than the file");
    }
    chunks.push_back(text.substr(at + kChunkHeader, size));
    at += kChunkHeader + size;
  }
  try {
    json = nlohmann::json::parse(as_utf8(chunks.front(), kJsonEscape));
  } catch (const nlohmann::json::parse_error&) {
    fail("its first chunk is not valid JSON");
  }
  chunk_ = chunks.size() > 1 ? std::move(chunks[1]) : "";
}

void GltfFile::fail(const std::string& reason) const {
  throw Error(fmt::format("{}: {}", path_.string(), reason));
}

const nlohmann::json& GltfFile::at(const char* list, std::size_t index) const {
  const auto found = json.find(list);
  if (found == json.end() || !found->is_array() || index >= found->size()) {
    fail(fmt::format("there is no {}[{}]", list, index));
  }
  return (*found)[index];
}

std::size_t GltfFile::whole(const nlohmann::json& object, const char* key, long otherwise) const {
  const auto found = object.find(key);
  if (found == object.end() && otherwise >= 0) {
    return static_cast<std::size_t>(otherwise);
  }
  if (found == object.end() || !found->is_number_unsigned() || found->get<std::size_t>() > kMost) {
    fail(fmt::format("\"{}\" must be a whole number", key));
  }
  return found->get<std::size_t>();
}

nlohmann::json& GltfFile::list(const char* name) {
  nlohmann::json& found = json[name];
  if (!found.is_array()) {
    found = nlohmann::json::array();
  }
  return found;
}

const std::string& GltfFile::buffer(std::size_t index) {
  const auto [entry, is_new] = buffers_.try_emplace(index);
  if (!is_new) {
    return entry->second;
  }
  const std::string uri = at("buffers", index).value("uri", std::string());
  if (uri.empty()) {
    return entry->second = index == 0 ? chunk_ : "";
  }
  return entry->second = uri.starts_with("data:") ? bytes_of_data_uri(uri) : read_text(path_.parent_path() / uri);
}

std::vector<float> GltfFile::numbers(const Layout& layout) {
  const nlohmann::json& view = at("bufferViews", layout.view);
  const std::string& bytes = buffer(whole(view, "buffer"));
  const std::size_t component = bytes_of_component(layout.component_type), size = component * layout.components;
  const std::size_t stride = std::max(whole(view, "byteStride", 0), size);
  const std::size_t start = whole(view, "byteOffset", 0) + layout.offset;
  if (component == 0) {
    fail(fmt::format("there is no component type {}", layout.component_type));
  }
  if (layout.count > 0 && (layout.offset + size > whole(view, "byteLength") ||
                           (layout.count - 1) * stride > whole(view, "byteLength") - layout.offset - size ||
                           start + (layout.count - 1) * stride + size > bytes.size())) {
    fail(fmt::format("an accessor of {} elements leads out of its buffer", layout.count));
  }
  std::vector<float> numbers;
  numbers.reserve(layout.count * layout.components);
  for (std::size_t i = 0; i < layout.count; ++i) {
    for (std::size_t j = 0; j < layout.components; ++j) {
      const char* at = bytes.data() + start + i * stride + j * component;
      numbers.push_back(number_of_type(layout.component_type, at, layout.normalized));
    }
  }
  return numbers;
}

std::vector<float> GltfFile::numbers(std::size_t index) {
  const nlohmann::json& accessor = at("accessors", index);
  Layout layout{.offset = whole(accessor, "byteOffset", 0),
                .component_type = static_cast<int>(whole(accessor, "componentType")),
                .components = components_of(accessor.value("type", std::string())),
                .count = whole(accessor, "count"),
                .normalized = accessor.value("normalized", false)};
  if (layout.components == 0) {
    fail(fmt::format("accessors[{}] has no type that is read", index));
  }
  // Several may lie on the same bytes.
  numbers_ += static_cast<double>(layout.count * layout.components);
  check_budget(Budget::kTriangles, numbers_ / 9, path_.string());
  std::vector<float> values;
  if (accessor.contains("bufferView")) {
    layout.view = whole(accessor, "bufferView");
    values = numbers(layout);
  } else {
    constexpr std::size_t kMostZeros = 10'000'000;
    if (layout.count > kMostZeros / layout.components) {
      fail(fmt::format("accessors[{}] has {} elements without bytes for them, more than {}", index, layout.count,
                       kMostZeros / layout.components));
    }
    values.resize(layout.count * layout.components);
  }
  if (const auto sparse = accessor.find("sparse"); sparse != accessor.end()) {
    const nlohmann::json &places = sparse->at("indices"), &given = sparse->at("values");
    layout.count = whole(*sparse, "count");
    layout.view = whole(given, "bufferView");
    layout.offset = whole(given, "byteOffset", 0);
    const std::vector<float> changed = numbers(layout);
    const Layout of_places{.view = whole(places, "bufferView"),
                           .offset = whole(places, "byteOffset", 0),
                           .component_type = static_cast<int>(whole(places, "componentType")),
                           .count = layout.count};
    const std::vector<float> indices = numbers(of_places);
    for (std::size_t i = 0; i < layout.count * layout.components; ++i) {
      const auto at = static_cast<std::size_t>(indices[i / layout.components]) * layout.components;
      if (at >= values.size()) {
        fail(fmt::format("accessors[{}] is sparse, and changes an element that it does not have", index));
      }
      values[at + i % layout.components] = changed[i];
    }
  }
  return values;
}

}  // namespace insonify
