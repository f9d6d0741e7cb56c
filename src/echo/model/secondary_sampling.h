// followed.h -- which hits of a ping are followed.

#pragma once

namespace insonify {

/// From which hits of a ping sound is followed on to a second surface.
enum class SecondarySampling {
  kNone,
  kSome,  ///< See select_hits().
  kAll
};

}  // namespace insonify
