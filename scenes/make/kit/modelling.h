// modelling.h -- common includes of the models: the kit, and headers of the standard library.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "kit/curve.h"
#include "kit/fittings.h"
#include "kit/kit.h"
#include "kit/noise.h"
#include "kit/normal_map.h"
#include "kit/path.h"
#include "kit/pipe.h"
#include "kit/ripples.h"
#include "kit/seabed.h"
#include "kit/shape.h"
