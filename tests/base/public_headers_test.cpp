// public_headers_test.cpp -- insonify.h has every public header, and two of them in one program get along.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "insonify/insonify.h"

namespace insonify::public_headers_test {
namespace {

TEST(PublicHeadersTest, AreAllInInsonifyH) {
  const std::filesystem::path root = INSONIFY_SOURCE_DIR "/include";
  std::ostringstream all;
  all << std::ifstream(root / "insonify/insonify.h").rdbuf();
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "insonify")) {
    const std::string name = entry.path().lexically_relative(root).string();
    if (entry.path().extension() == ".h" && name != "insonify/insonify.h") {
      EXPECT_NE(all.str().find("#include \"" + name + "\"\n"), std::string::npos) << name;
      ++count;
    }
  }
  EXPECT_GT(count, 30);
  EXPECT_STRNE(kVersion, "");
  EXPECT_GT(absorption_db_per_m(720e3, Water()), 0);
}

}  // namespace
}  // namespace insonify::public_headers_test
