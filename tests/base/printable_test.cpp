// printable_test.cpp -- any text is shown as one short line without characters that control a terminal.

#include "insonify/printable.h"

#include <gtest/gtest.h>

#include <random>

#include "base/log_line.h"
#include "insonify/error.h"

namespace insonify::printable_test {
namespace {

TEST(PrintableTest, LeavesOrdinaryTextAsItIs) {
  for (const std::string text : {"", "plain words, 1.5 m", "C:\\n\\x1b", "Prüfkörper № 3, 水中, 🐟"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(PrintableTest, WritesOutWhatATerminalObeys) {
  EXPECT_EQ(printable("a\nb\rc\td"), "a\\nb\\rc\\td");
  EXPECT_EQ(printable("\x1b[31mred\x1b[0m\x07"), "\\x1b[31mred\\x1b[0m\\x07");
  EXPECT_EQ(printable(std::string("a\0b\x7f", 4)), "a\\x00b\\x7f");
  EXPECT_EQ(printable("\u009b2J"), "\\u009b2J");                       // One character that begins what ESC [ does.
  EXPECT_EQ(printable("abc\u202ecba\u200b"), "abc\\u202ecba\\u200b");  // Right-to-left override; zero-width space.
  EXPECT_EQ(printable("\ufeffa\u2028b"), "\\ufeffa\\u2028b");
}

TEST(PrintableTest, WritesOutBytesThatAreNoUtf8) {
  EXPECT_EQ(printable("a\x80\xff"), "a\\x80\\xff");
  EXPECT_EQ(printable("\xe6\xb0"), "\\xe6\\xb0");                    // Last byte missing.
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");                    // Overlong form of "/".
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // A surrogate.
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // Above U+10FFFF.
  EXPECT_EQ(printable("\ufffd"), "\ufffd");
}

TEST(PrintableTest, LeavesOutTheMiddleOfLongText) {
  const std::string text = "0123456789abcdefghijklmnopqrstuvwxyz";
  EXPECT_EQ(printable(text, 36), text);
  EXPECT_EQ(printable(text, 35), "0123456789abcdefghijkl...qrstuvwxyz");
  EXPECT_EQ(printable(std::string(3'000'000, 'x')).size(), kLongestQuote);
  // Whole characters and whole escapes only: 10 bytes have room for 5 at the beginning and 2 at the end.
  EXPECT_EQ(printable("ü水水水水水水水水水ü", 10), "ü水...ü");
  EXPECT_EQ(printable("\x1b\x1b\x1b\x1b\x1b\x1b", 10), "\\x1b...");
}

// The same bytes on every run.
TEST(PrintableTest, IsShortAndPrintableAndStaysSoWhateverItIsGiven) {
  std::mt19937 random(20240611);
  for (int i = 0; i < 20'000; ++i) {
    std::string text(random() % 100, ' ');
    for (char& c : text) {
      c = static_cast<char>(random() % 3 == 0 ? random() % 128 : random());
    }
    const std::size_t longest = 10 + random() % 100;
    const std::string shown = printable(text, longest);
    ASSERT_LE(shown.size(), longest);
    ASSERT_EQ(printable(shown, longest), shown);
    for (const unsigned char c : shown) {
      ASSERT_TRUE(c >= 0x20 && c != 0x7f);
    }
  }
}

TEST(PrintableTest, ErrorsAndTheLogAreAlwaysPrintable) {
  const std::string nasty = "a.sdf:1:1: \x1b[2J" + std::string(3'000'000, 'x') + "\nis not known";
  const std::string shown = "a.sdf:1:1: \\x1b[2Jxxx";
  const std::string error = Error(nasty).what();
  EXPECT_EQ(error.size(), kLongestMessage);
  EXPECT_TRUE(error.starts_with(shown)) << error;
  EXPECT_TRUE(error.ends_with("xx\\nis not known")) << error;
  std::string logged;
  log_line([&](Severity, const std::string& message) { logged = message; }, Severity::kInfo, nasty);
  EXPECT_EQ(logged, error);
}

}  // namespace
}  // namespace insonify::printable_test
