// sdf_model_file.cpp -- reads model.config by way of libsdformat.

#include "io/sdf/sdf_model_file.h"

#include <exception>
#include <sdf/parser.hh>

#include "io/sdf/sdf_console.h"

namespace insonify {
namespace {

namespace fs = std::filesystem;

// The file that a model.config lists for the newest known version; an empty path if it is malformed.
fs::path listed_file(const fs::path& folder) {
  const SdfConsole quiet;
  try {
    return sdf::getModelFilePath(folder.string());
  } catch (const std::exception&) {  // Thrown for a version that is not a number.
    return {};
  }
}

}  // namespace

std::optional<fs::path> sdf_file_of_model(const fs::path& found) {
  if (!fs::is_directory(found)) {
    return found;
  }
  const bool is_listed = fs::exists(found / "model.config") || fs::exists(found / "manifest.xml");
  const fs::path file = is_listed ? listed_file(found) : found / "model.sdf";
  return fs::is_regular_file(file) ? std::optional(file.lexically_normal()) : std::nullopt;
}

}  // namespace insonify
