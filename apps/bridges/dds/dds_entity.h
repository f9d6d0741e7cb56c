// dds_entity.h -- owns a handle of CycloneDDS.

#pragma once

#include <dds/dds.h>
#include <fmt/format.h>

#include <memory>
#include <string_view>
#include <utility>

#include "insonify/error.h"

namespace insonify {

/// Returns a result of CycloneDDS unchanged unless it is an error.
/// @param act  What was tried: "make a writer of rt/fls/fan".
/// @throws Error for an error code.
inline dds_return_t check_dds(dds_return_t result, std::string_view act) {
  if (result < 0) {
    throw Error(fmt::format("could not {}: CycloneDDS says {}", act, dds_strretcode(result)));
  }
  return result;
}

/// A participant, topic, reader or writer. The destructor deletes it with all entities that it owns.
class DdsEntity {
 public:
  DdsEntity() = default;
  /// @throws Error as check_dds().
  DdsEntity(dds_entity_t handle, std::string_view act) : handle_(check_dds(handle, act)) {}
  ~DdsEntity() { reset(); }
  DdsEntity(DdsEntity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  DdsEntity& operator=(DdsEntity&& other) noexcept {
    if (this != &other) {
      reset();
      handle_ = std::exchange(other.handle_, 0);
    }
    return *this;
  }

  void reset() {
    if (handle_ > 0) {
      dds_delete(std::exchange(handle_, 0));
    }
  }
  [[nodiscard]] dds_entity_t get() const { return handle_; }

 private:
  dds_entity_t handle_ = 0;
};

struct DdsQosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using DdsQos = std::unique_ptr<dds_qos_t, DdsQosDeleter>;

}  // namespace insonify
