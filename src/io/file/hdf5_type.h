// hdf5_type.h -- checks datatype messages, which HDF5 trusts, before it reads them.

#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "io/file/hdf5.h"

namespace insonify {

// The threat: HDF5 opens a damaged or crafted recording without an error, then reads and writes beyond its memory as it
// decodes a datatype: a crash, or code of the file's author, in whatever opens a stranger's file (SECURITY.md).

/// The fault of a datatype message (HDF5 File Format Specification 3.0, IV.A.2.d), or "": a name or a member beyond the
/// message's end, or sizes that contradict each other. HDF5 1.10 checks neither, and reads and writes beyond its
/// memory.
[[nodiscard]] std::string datatype_fault(std::span<const char> message);

/// Checks the datatypes of an object and of its attributes, as its header has them, without opening it. Objects with a
/// version 2 header, which recordings do not have, and datatypes that objects share pass unchecked.
/// @param file  Or a group in it.
/// @param name  Of the object, from there.
/// @throws Error "PATH: NAME is damaged: REASON"
void check_object(hid_t file, const std::string& name, const std::filesystem::path& path);

}  // namespace insonify
