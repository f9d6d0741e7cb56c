// export_mcap.cpp -- the pings of several recordings, in the order of their times, into one MCAP file.

#include <fmt/format.h>

#include <cstring>

#include "insonify/mcap_recording.h"
#include "insonify/printable.h"
#include "insonify/words.h"
#include "io/export/export_format.h"
#include "io/export/recorded_source.h"

namespace insonify {
namespace {

const RecordedTable* table_named(const RecordedTables& recording, const std::string& name) {
  for (const RecordedTable& table : recording.tables()) {
    if (table.name == name) {
      return &table;
    }
  }
  return nullptr;
}

// The pings of one recording, one after the other, with the elevations of the ground truth where there are any.
class Source {
 public:
  explicit Source(const RecordedTables& recording)
      : recording_(&recording), pings_(pings_of(recording)), elevation_(table_named(recording, "elevation")) {
    advance();
  }

  [[nodiscard]] bool done() const { return done_; }
  [[nodiscard]] const Ping& ping() const { return ping_; }

  void advance() {
    done_ = next_ >= recording_->ping_count();
    if (done_) {
      return;
    }
    ping_ = pings_.ping(next_);
    if (elevation_ != nullptr && elevation_->type == "<f4") {
      const std::vector<std::byte> bytes = recording_->row(*elevation_, next_);
      ping_.elevation.resize(bytes.size() / sizeof(float));
      std::memcpy(ping_.elevation.data(), bytes.data(), bytes.size());
    }
    ++next_;
  }

 private:
  const RecordedTables* recording_;
  RecordedPings pings_;
  const RecordedTable* elevation_;
  std::uint64_t next_ = 0;
  bool done_ = false;
  Ping ping_;
};

RunFacts run_of(const RecordedTables& recording) {
  RunFacts run;
  run.version = recording.text("version");
  run.engine = recording.text("engine");
  if (const auto seed = recording.attributes().find("seed");
      seed != recording.attributes().end() && seed->is_number()) {
    run.seed = seed->get<std::uint64_t>();
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
  return {pings.sonar_config(), model_of(recording), pings.receiver_config(), recording.text("scenario"), {}};
}

void export_mcap(RecordedSonars recordings, const std::filesystem::path& file, const ExportOptions& options) {
  std::vector<MessageSource> sources;
  std::vector<Source> pings;
  for (const auto& recording : recordings) {
    sources.push_back(message_source(*recording));
    pings.emplace_back(*recording);
  }
  McapRecording out(file, std::move(sources),
                    {.messages = options.messages,
                     .run = run_of(*recordings.front()),
                     .replace = options.replace,
                     .only_whole = true});
  while (true) {
    check_stop(options);
    Source* next = nullptr;
    for (Source& source : pings) {
      if (!source.done() && (next == nullptr || source.ping().time < next->ping().time)) {
        next = &source;
      }
    }
    if (next == nullptr) {
      break;
    }
    out.add(static_cast<std::size_t>(next - pings.data()), next->ping());
    next->advance();
  }
  out.close();
}

}  // namespace insonify
