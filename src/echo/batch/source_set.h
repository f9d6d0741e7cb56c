// source_set.h -- the echo sources of one ping, and the rays that they have asked for.

#pragma once

#include <memory>
#include <vector>

#include "echo/batch/echo_source.h"

namespace insonify {

/// One source and its part of a round.
struct AskingSource {
  explicit AskingSource(std::unique_ptr<EchoSource> its_source) : source(std::move(its_source)) {}

  std::unique_ptr<EchoSource> source;
  RayList asked, more;  ///< Rays of this round, and of the next.
  std::vector<Hit> hits, sights;
  std::vector<double> passed;  ///< [sight]; empty where nothing transmits sound.
  EchoList found;

  // Lines of sight that continue behind a surface.
  std::vector<std::size_t> of;  ///< Their indices in `asked`.
  std::vector<Ray> continued;
  std::vector<Hit> met;
};

/// The sources of one ping, in the order in which their echoes are added.
using SourceSet = std::vector<AskingSource>;

}  // namespace insonify
