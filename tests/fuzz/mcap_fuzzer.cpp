// mcap_fuzzer.cpp -- reads MCAP recordings with words changed as the input says: in the file, or in its messages, which
// are then sealed again with right lengths and checksums; or any bytes. The first byte says which.

#include <numeric>

#include "fuzz/recordings.h"
#include "io/mcap/mcap_reader.h"
#include "io/mcap/mcap_writer.h"

namespace insonify::mcap_fuzzer {
namespace {

std::string with_any_words(const std::string& whole, fuzz::Bytes changes) {
  std::vector<std::size_t> places(whole.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  return fuzz::with_words(whole, places, changes);
}

// Writes the messages and metadata of a file to another, with changes in both.
void seal(const std::filesystem::path& from, const std::filesystem::path& to, fuzz::Bytes changes) {
  const McapReader reader(from);
  McapWriter writer(to, "fuzzer", true);
  const auto next = [&] {
    const fuzz::Bytes taken = changes.first(std::min<std::size_t>(changes.size(), 3));
    changes = changes.subspan(taken.size());
    return taken;
  };
  for (auto [name, texts] : reader.metadata()) {
    for (auto& [key, text] : texts) {
      text = text.empty() ? text : with_any_words(text, next());
    }
    writer.add_metadata(name, texts);
  }
  std::uint64_t time = 0;
  for (const auto& [topic, type] : reader.topics()) {
    const std::uint16_t channel = writer.add_channel(topic, type, "");
    for (const McapReader::Entry& entry : reader.messages(topic)) {
      const std::vector<std::byte> message = reader.read(entry);
      const std::string text = with_any_words({reinterpret_cast<const char*>(message.data()), message.size()}, next());
      const auto bytes = std::as_bytes(std::span(text));
      const McapWriter::Message changed{channel, {bytes.begin(), bytes.end()}};
      writer.add(time = std::max(time, entry.time), std::span(&changed, 1));
    }
  }
  writer.close();
}

void take(fuzz::Bytes bytes) {
  static const fuzz::InputFile file;
  static const std::filesystem::path whole = file.folder() / "whole.mcap";
  static const bool made = [] {
    record_ping([&](const Scenario& scenario, const Scene& scene, const SonarConfig& sonar, const Ping& ping) {
      McapOptions options{.run = run_facts(scenario, scene)};
      options.messages.fan_rate = 0;
      McapRecording(whole, {message_source(scenario, sonar)}, options).add(0, ping);
    });
    fuzz::read_recording(whole);
    return true;
  }();
  if (bytes.empty() || !made) {
    return;
  }
  const fuzz::Bytes rest = bytes.subspan(1);
  const std::filesystem::path path = file.folder() / "a.mcap";
  fuzz::expect_error_or_nothing(
      [&] {
        if (bytes[0] % 4 == 0) {
          file.write("a.mcap", fuzz::text_of(rest));
        } else if (bytes[0] % 4 == 1) {
          file.write("a.mcap", with_any_words(fuzz::bytes_of(whole), rest));
        } else {
          seal(whole, path, rest);
        }
        fuzz::read_recording(path);
      },
      path);
}

const fuzz::Listed kListed("mcap", take);

}  // namespace
}  // namespace insonify::mcap_fuzzer
