// export_mcap.cpp -- the pings of several recordings, in the order of their times, into one MCAP file.

#include <fmt/format.h>

#include "insonify/mcap_recording.h"
#include "insonify/printable.h"
#include "insonify/words.h"
#include "io/export/export_format.h"

namespace insonify {
namespace {

RunFacts run_of(const RecordedTables& recording) {
  RunFacts run;
  run.version = recording.text("version");
  run.engine = recording.text("engine");
  if (const auto seed = recording.attributes().find("seed");
      seed != recording.attributes().end() && seed->is_number()) {
    run.seed = seed->get<std::uint64_t>();
  }
  for (const RecordedNames& names : recording.names()) {
    if (names.name == "instance_names") {
      run.instance_names = names.texts;
    } else if (names.name == "material_names") {
      run.material_names = names.texts;
    }
  }
  return run;
}

}  // namespace

RecordedPings pings_of(const RecordedTables& recording) {
  return RecordedPings(recording.path(), recording.text("sonar"));
}

EchoModel model_of(const RecordedTables& recording) {
  const std::string model = recording.text("model");
  for (const auto& [word, value] : words_of<EchoModel>()) {
    if (word == model) {
      return value;
    }
  }
  throw Error(fmt::format("{}: its attribute model is \"{}\", must be calibrated or paper", recording.path().string(),
                          printable(model)));
}

MessageSource message_source(const RecordedTables& recording) {
  const RecordedPings pings = pings_of(recording);
  MessageSource source{
      pings.sonar_config(), model_of(recording), pings.receiver_config(), recording.text("scenario"), {}};
  if (const auto stored = recording.attributes().find("absorption_db_per_m");
      stored != recording.attributes().end() && stored->is_number()) {
    source.absorption = stored->get<double>();
  }
  return source;
}

std::vector<MessageSource> message_sources(RecordedSonars recordings) {
  std::vector<MessageSource> sources;
  for (const auto& recording : recordings) {
    sources.push_back(message_source(*recording));
  }
  return sources;
}

MessageOptions with_start(MessageOptions options, RecordedSonars recordings) {
  for (const auto& recording : recordings) {
    if (const std::string start = recording->text("start"); !start.empty() && !options.start_ns) {
      options.start_ns = start_from_text(start);
    }
  }
  return options;
}

void export_mcap(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  McapRecording out(file, message_sources(recordings),
                    {.messages = with_start(options.messages, recordings),
                     .run = run_of(*recordings.front()),
                     .log = options.log,
                     .replace = options.replace,
                     .only_whole = true});
  write_pings(recordings, out, options);
}

}  // namespace insonify
