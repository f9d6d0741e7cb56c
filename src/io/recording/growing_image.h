// growing_image.h -- a recording as HDF5 makes it, before its first row.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "io/file/hdf5.h"
#include "io/recording/growing_dataset.h"

namespace insonify {

/// The smallest page that Linux has. A write inside one page cannot be cut in two by a signal: the kernel looks for
/// signals between pages only.
inline constexpr std::uint64_t kGrowingPage = 4096;

/// Attribute of the file that says whether a recording was ended as it should.
inline constexpr const char* kStateAttribute = "state";

/// Its values.
enum class GrowingState : std::uint64_t {
  kGrowing = 0,  ///< It is being written, or what wrote it was killed.
  kWhole = 1,
  kCutShort = 2  ///< A row could not be written to a full disk; the rows before it are complete.
};

struct GrowingImage {
  std::vector<std::byte> bytes;          ///< Contents of the file.
  std::uint64_t state_address = 0;       ///< Address of the value of kStateAttribute, 8 bytes.
  std::vector<std::uint64_t> addresses;  ///< Addresses of the datasets' headers, alone in their page.
};

/// @param path      For messages.
/// @param describe  Adds what does not grow.
/// @throws Error that names the file.
[[nodiscard]] GrowingImage make_growing_image(const std::filesystem::path& path,
                                              std::span<const GrowingDataset> datasets,
                                              const std::function<void(hid_t file)>& describe);

}  // namespace insonify
