// debris.h -- what lies on the bed round the ferry.

#pragma once

#include "kit/modelling.h"

/// Container, lifeboat, plates, bollard, pipe, tyres, anchor and chain; in the world's frame.
[[nodiscard]] Shape make_debris();
