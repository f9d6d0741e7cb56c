// export_xyz.cpp -- soundings as lines of text: x y z, or longitude, latitude and depth.

#include <fmt/format.h>

#include "insonify/error.h"
#include "io/export/survey_file.h"
#include "io/export/swath_line.h"

namespace insonify {

void export_xyz(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  const SwathLine line(recordings, options);
  if (line.extent().found == 0) {
    throw Error(fmt::format("{}: there is no sounding to write: no beam found the bottom", file.string()));
  }
  RecordFile out(file);
  line.for_each([&](std::size_t, const SwathPing& ping) {
    std::string text;
    for (const SwathBeam& beam : ping.beams) {
      if (!beam.sounding.found()) {
        continue;
      }
      const auto [x, y] = line.place_of(beam.position);
      text += options.origin ? fmt::format("{:.9f} {:.9f} {:.4f}", x, y, beam.depth)
                             : fmt::format("{:.4f} {:.4f} {:.4f}", x, y, beam.position.z());
      if (options.uncertainty) {
        text += fmt::format(" {:.4f}", beam.vertical_deviation);
      }
      text += '\n';
    }
    out.append(std::as_bytes(std::span(text)));
  });
  out.finish();
}

}  // namespace insonify
