// draw.cpp -- insonify draw: draws pictures of a recording's pings.

#include <fmt/format.h>

#include <algorithm>

#include "commands.h"
#include "console.h"
#include "earlier_run.h"
#include "insonify/recorded_pings.h"
#include "output_folder.h"
#include "pictures.h"

namespace insonify {
namespace {

EchoModel model_of(const RecordedPings& recording, const std::filesystem::path& path) {
  if (recording.model() != "calibrated" && recording.model() != "paper") {
    throw InputError(fmt::format("{}: its attribute model is \"{}\", must be calibrated or paper", path.string(),
                                 recording.model()));
  }
  return recording.model() == "paper" ? EchoModel::kPaper : EchoModel::kCalibrated;
}

PictureChoice choice_of(const DrawOptions& options, const RecordedPings& recording) {
  PictureChoice choice = PictureChoice::parse(options.pictures.pictures);
  for (const std::uint64_t ping : options.pings) {
    if (ping >= recording.ping_count()) {
      throw InputError(fmt::format("{}: --ping {} must be below {}, the number of its pings",
                                   options.recording.string(), ping, recording.ping_count()));
    }
  }
  choice.only = options.pings;
  return choice;
}

// The first ping of a fan sets the scale for all; a picture of a scan shows all pings so far.
void draw_pings(const RecordedPings& recording, const SonarConfig& sonar, const PictureChoice& choice,
                PingPictures& pictures) {
  const std::uint64_t count = recording.ping_count();
  const bool scans = sonar.type == SonarType::kMechanicallyScanned;
  for (std::uint64_t number = 0; number < count; ++number) {
    if (scans || number == 0 || choice.takes(number, count)) {
      pictures.add(recording.ping(number));
    }
  }
  if (scans) {
    pictures.finish({});
  }
}

}  // namespace

int draw(const DrawOptions& options) {
  try {
    const RecordedPings recording(options.recording);
    const SonarConfig sonar = recording.sonar_config();
    const PictureStyle style =
        picture_style(options.pictures, model_of(recording, options.recording), recording.receiver_config());
    const PictureChoice choice = choice_of(options, recording);
    if (recording.ping_count() == 0) {
      throw InputError(fmt::format("{}: there is no ping in it", options.recording.string()));
    }
    const std::filesystem::path beside =
        options.recording.has_parent_path() ? options.recording.parent_path() : std::filesystem::path(".");
    const std::filesystem::path folder =
        output_folder(options.folder.empty() ? beside : options.folder, options.recording);
    if (!options.force) {
      refuse_earlier_pictures(folder, sonar.name);
    }
    make_output_folder(folder);
    PictureFolder into(folder, {sonar.name});
    PingPictures pictures(into, sonar, style, choice, recording.ping_count());
    draw_pings(recording, sonar, choice, pictures);
    into.put_in_place();
    for (const std::filesystem::path& file : pictures.files()) {
      say("{}\n", file.string());
    }
    return kDone;
  } catch (const InputError&) {
    throw;
  } catch (const Error& error) {
    throw InputError(error.what());
  }
}

}  // namespace insonify
