// all.h -- every law, after those that it uses. C++ reads it through laws.h; a shader includes it.

// clang-format off
#include "echo/laws/prelude.h"
#include "echo/laws/absorption.h"
#include "echo/laws/relief.h"
#include "echo/laws/hit_footprint.h"
#include "echo/laws/normal_turn.h"
#include "echo/laws/selection.h"
#include "echo/laws/facet_lobe.h"
#include "echo/laws/primary_echo.h"
#include "echo/laws/mirror_facet.h"
#include "echo/laws/face_return.h"
#include "echo/laws/facet_return.h"
#include "echo/laws/double_passage.h"
#include "echo/laws/path_footprint.h"
#include "echo/laws/ray_tube.h"
#include "echo/laws/mirror_echo.h"
#include "echo/laws/water_return.h"
#include "echo/laws/scatterers.h"
#include "echo/laws/one_look.h"
#ifdef __cplusplus  // A shader includes it with Real as double.
#include "echo/laws/window_rung.h"
#endif
// clang-format on
