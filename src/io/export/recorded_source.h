// recorded_source.h -- properties of a sonar that messages and pictures need, from its recording.

#pragma once

#include "insonify/messages.h"
#include "insonify/recorded_pings.h"
#include "io/export/export_format.h"
#include "io/file/recorded_tables.h"

namespace insonify {

/// The pings that the tables are of.
[[nodiscard]] RecordedPings pings_of(const RecordedTables& recording);

/// @throws Error with the path for a recording without model or settings.
[[nodiscard]] EchoModel model_of(const RecordedTables& recording);
[[nodiscard]] MessageSource message_source(const RecordedTables& recording);
[[nodiscard]] std::vector<MessageSource> message_sources(RecordedSonars recordings);

/// The options, with the recordings' start unless they have their own.
[[nodiscard]] MessageOptions with_start(MessageOptions options, RecordedSonars recordings);

}  // namespace insonify
