// hdf5.h -- HDF5 identifiers that close themselves, and HDF5's failures as Errors.

#pragma once

#define H5_USE_110_API  // Functions and structures of HDF5 1.10, which newer ones have too.
#include <hdf5.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "insonify/error.h"

namespace insonify {

/// Owns an HDF5 identifier: a file, a dataset, a dataspace ...
class H5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  H5Handle() = default;
  H5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~H5Handle() { reset(); }
  H5Handle(H5Handle&& other) noexcept : id_(other.release()), close_(other.close_) {}
  H5Handle& operator=(H5Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = other.release();
      close_ = other.close_;
    }
    return *this;
  }

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] explicit operator bool() const { return id_ >= 0; }

  /// Closes it now.
  void reset() {
    if (id_ >= 0) {
      close_(release());
    }
  }

  /// Releases it without closing, for a caller that must know whether closing succeeded.
  [[nodiscard]] hid_t release() { return std::exchange(id_, hid_t{H5I_INVALID_HID}); }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// HDF5 prints nothing to standard error during the life of this object. Its error handler is restored afterwards,
/// since a program that links this library may use HDF5 too.
class H5Quiet {
 public:
  H5Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~H5Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  H5Quiet(const H5Quiet&) = delete;
  H5Quiet& operator=(const H5Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Why the last HDF5 call failed, one line: the innermost entry of its error stack, or the system's own reason where
/// there is one ("No space left on device").
[[nodiscard]] std::string h5_failure();

/// Returns the result of an HDF5 function.
/// @throws Error "PATH: cannot DOING: REASON" if it is negative.
template <typename Result>
Result h5_check(Result result, const std::filesystem::path& path, std::string_view doing) {
  if (result < 0) {
    throw Error(path.string() + ": cannot " + std::string(doing) + ": " + h5_failure());
  }
  return result;
}

/// As h5_check, for a function that returns an identifier: `h5_own(H5Dopen2(...), H5Dclose, path, "open /elevation")`.
[[nodiscard]] inline H5Handle h5_own(hid_t id, H5Handle::Close close, const std::filesystem::path& path,
                                     std::string_view doing) {
  return {h5_check(id, path, doing), close};
}

/// Opens a dataset, a group or a type.
/// @throws Error for one that is in another file or has its values there: by an external link, external storage or as a
///         virtual dataset. A stranger's file could show any file of this machine so.
[[nodiscard]] H5Handle h5_open_object(hid_t where, const std::string& name, const std::filesystem::path& path);

/// Opens a file for reading, also a recording that is being written: HDF5 asks for the file's size and then reads, at
/// its start, where it ends, so opening fails if the file grows between the two. It is then tried again.
/// @throws Error "PATH: cannot open it as HDF5: REASON"
[[nodiscard]] H5Handle h5_open_to_read(const std::filesystem::path& path);

/// The same for a recording.
/// @throws Error "PATH: is not a recording: it is neither HDF5 nor MCAP" too.
[[nodiscard]] H5Handle h5_open_recording(const std::filesystem::path& path);

}  // namespace insonify
