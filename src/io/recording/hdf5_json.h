// hdf5_json.h -- reads attributes and small datasets of an HDF5 file as JSON.

#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/file/hdf5.h"

namespace insonify {

/// Lengths of a data space's axes; empty for a scalar.
[[nodiscard]] std::vector<hsize_t> hdf5_shape(hid_t space);

/// Whether lengths, which may be anything in a damaged file, multiply to at most `most`; their product may overflow.
[[nodiscard]] bool product_is_at_most(const std::vector<hsize_t>& shape, hsize_t most);

/// All attributes of an object by their names: texts, numbers, truth values, or lists of those; null for other types
/// and for lists of more than a million values.
/// @param owner  Name of the object, for messages.
/// @throws Error with the path where they cannot be read.
[[nodiscard]] nlohmann::json hdf5_attributes_json(hid_t object, const std::filesystem::path& path,
                                                  const std::string& owner);

/// The values of a dataset, of the types and sizes that attributes may have; null for others.
/// @param name  Name of the dataset, for messages.
/// @throws Error with the path where they cannot be read.
[[nodiscard]] nlohmann::json hdf5_dataset_json(hid_t dataset, const std::filesystem::path& path,
                                               const std::string& name);

}  // namespace insonify
