// describe.h -- lists the keys of a scenario file with unit, limits, default and meaning, for `insonify describe` and
// the manual.

#pragma once

#include <string>
#include <vector>

namespace insonify {

/// One key, as users write and read it.
struct KeyDescription {
  std::string key;            ///< "azimuth_aperture_deg"
  std::string unit;           ///< "deg"; may be "".
  std::string allowed;        ///< "greater than 0, at most 360", "fls, msis", "text" ...
  std::string default_value;  ///< "120"; "-": none.
  std::string help;           ///< One sentence.
};

/// One part of a scenario.
struct SectionDescription {
  std::string name;  ///< "scenario" for the top level, else the part's key: "water", "sonars" ...
  std::string help;  ///< One or two sentences.
  std::vector<KeyDescription> keys;
};

/// Every part of a scenario, in the order of the manual; made from the configurations' field lists.
[[nodiscard]] std::vector<SectionDescription> describe_scenario();

}  // namespace insonify
