// secondary_sampling.h -- choice of the hits from which reflected rays are traced.

#pragma once

namespace insonify {

/// From which hits of a ping reflected rays are traced.
enum class SecondarySampling {
  kNone,
  kSome,  ///< From a sample of them, see select_hits().
  kAll
};

}  // namespace insonify
