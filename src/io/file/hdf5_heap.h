// hdf5_heap.h -- checks variable-length texts, which HDF5 does not, before it reads them.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/file/hdf5.h"

namespace insonify {

// The threat: as hdf5_type.h, by the references to texts. A recording that was cut off while it was copied is enough
// for it.

/// Texts of variable length are stored in global heaps (HDF5 File Format Specification 3.0, III.E); a dataset or an
/// attribute holds their lengths, addresses and numbers. HDF5 1.10 follows these unchecked, in damaged files beyond the
/// ends of its memory. These functions check them by reading the file's own bytes.
///
/// check_heap_texts() checks a contiguous dataset, which is what a recording has; other layouts pass unchecked.
/// checked_attributes() checks all attributes of a group or dataset with a version 1 object header, which is what a
/// recording has, and returns their names: HDF5's own list of them crashes over an attribute that cannot be decoded.
/// Those of other headers pass unchecked.
/// @param name  Of the object, for messages.
/// @throws Error "PATH: NAME is damaged: REASON"
void check_heap_texts(hid_t file, hid_t dataset, const std::filesystem::path& path, const std::string& name);
[[nodiscard]] std::vector<std::string> checked_attributes(hid_t object, const std::filesystem::path& path,
                                                          const std::string& name);

}  // namespace insonify
