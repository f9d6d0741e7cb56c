// sanitized.h -- whether this is a build with sanitizers, which end a program in their own way.

#pragma once

namespace insonify {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace insonify
