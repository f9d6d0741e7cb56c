// python_recording.h -- a recording in Python: its pings and tables, read on demand.

#pragma once

#include <algorithm>
#include <complex>
#include <string>
#include <vector>

#include "bind.h"
#include "insonify/recorded_pings.h"
#include "insonify/recording_info.h"
#include "insonify/stored_tables.h"

namespace insonify::python {

struct PythonRecording {
  std::filesystem::path path;
  RecordedPings pings;
  StoredTables tables;
  RecordingState state;                          ///< When it was opened.
  std::shared_ptr<const SonarFacts> facts = {};  ///< Once a ping was asked for.

  /// @param sonar  Name; "" for the only one.
  explicit PythonRecording(const std::filesystem::path& file, const std::string& sonar = "")
      : path(file), pings(file, sonar), tables(file, sonar), state(recording_state(file)) {}

  /// Number of pings in every table; a recording may grow while it is opened.
  [[nodiscard]] std::uint64_t ping_count() const {
    const StoredTable* intensity = tables.find("intensity");
    return intensity == nullptr ? pings.ping_count() : std::min(pings.ping_count(), intensity->shape.front());
  }

  const std::shared_ptr<const SonarFacts>& known() {
    if (facts == nullptr) {
      const EchoModel model = pings.model() == "paper" ? EchoModel::kPaper : EchoModel::kCalibrated;
      facts = std::make_shared<SonarFacts>(SonarFacts{
          pings.sonar_config(), model, pings.receiver_config(),
          std::make_shared<LabelNames>(LabelNames{tables.texts("instance_names"), tables.texts("material_names")})});
    }
    return facts;
  }
};

template <typename Value>
constexpr NumberType number_type_of() {
  if constexpr (std::is_same_v<Value, std::uint8_t>) {
    return NumberType::kUint8;
  } else if constexpr (std::is_same_v<Value, std::uint16_t>) {
    return NumberType::kUint16;
  } else {
    return NumberType::kFloat32;  // Complex numbers are pairs of these.
  }
}

/// Reads one ping of a table; leaves `values` empty if the file does not have it.
template <typename Value>
void read_table(const PythonRecording& recording, std::uint64_t ping, const std::string& name,
                std::vector<Value>& values) {
  const StoredTable* table = recording.tables.find(name);
  if (table == nullptr || !table->by_ping || table->type != number_type_of<Value>() || ping >= table->shape[0]) {
    return;
  }
  std::vector<TableSlice> slices = {{.start = ping, .count = 1}};
  std::size_t bytes = size_of(table->type);
  for (std::size_t axis = 1; axis < table->shape.size(); ++axis) {
    slices.push_back({.count = table->shape[axis]});
    bytes *= table->shape[axis];
  }
  std::vector<Value> read(bytes / sizeof(Value));
  recording.tables.read(*table, slices, std::as_writable_bytes(std::span(read)));
  values = std::move(read);
}

}  // namespace insonify::python
