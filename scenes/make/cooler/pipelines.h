// pipelines.h -- the lines that lead to, from and past the cooler, and what they are carried and covered by.

#pragma once

#include "kit/modelling.h"

/// Pipelines, spools and umbilical, in the world.
[[nodiscard]] Shape make_pipelines();

/// Mattresses, sleepers and grout bags, in the world.
[[nodiscard]] Shape make_pipeline_supports();
