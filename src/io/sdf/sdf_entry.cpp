// sdf_entry.cpp -- what the library finds in libinsonify_sdf.

#include "io/sdf/sdf_scene.h"
#include "io/sdf/sdf_sonars.h"

namespace insonify {

extern "C" const SdfReader insonify_sdf_reader{&load_sdf_scene, &load_sdf_sonars};

}  // namespace insonify
