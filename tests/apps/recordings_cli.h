// recordings_cli.h -- what tests of recordings by the command line share.

#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "apps/cli.h"

namespace insonify {

class RecordingsCliTest : public CliTest {
 protected:
  /// What `insonify info` says of one file.
  static nlohmann::json info(const std::string& file) {
    const Outcome said = shell("insonify info " + file + " --json");
    EXPECT_EQ(said.status, 0) << said.err;
    return nlohmann::json::parse(said.out).at(0);
  }
};

}  // namespace insonify
