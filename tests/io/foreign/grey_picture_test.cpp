// grey_picture_test.cpp -- JPEG and PGM pictures as levels, and what is refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/foreign/foreign_bytes.h"

namespace insonify::grey_picture_test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const char* name) {
  return message_of([&] { static_cast<void>(load_grey_picture(name)); });
}

// ---------------------------------------------------------------- PGM

TEST(PgmTest, LevelsAreFractionsOfTheGreatest) {
  const WorkingFolder folder;
  folder.write("a.pgm", "P5\n# a comment\n3 2\n# another\n100\n" + std::string("\0\x0a\x14\x32\x4b\x64", 6));
  const GreyPicture bytes = load_grey_picture("a.pgm");
  EXPECT_EQ(bytes.columns, 3);
  EXPECT_EQ(bytes.rows, 2);
  EXPECT_THAT(bytes.values, ElementsAre(0, 0.1, 0.2, 0.5, 0.75, 1));
  folder.write("b.pgm", "P5 2 1 1023\n" + std::string("\x01\xff\x03\xff", 4));  // Most significant byte first.
  EXPECT_THAT(load_grey_picture("b.pgm").values, ElementsAre(511 / 1023.0, 1));
  folder.write("c.pgm", "P2\n2 2 4\n0 1\n2 # two\n4\n");
  EXPECT_THAT(load_grey_picture("c.pgm").values, ElementsAre(0, 0.25, 0.5, 1));
}

TEST(PgmTest, WrongFilesAreOneMessage) {
  const WorkingFolder folder;
  folder.write("text.pgm", "hello");
  EXPECT_EQ(
      refusal("text.pgm"),
      "text.pgm: byte 0: begins with \"hell\"; a JPEG file begins with \\xff\\xd8\\xff, a PGM file with P5 or P2");
  folder.write("cut.pgm", "P5 3 2 255\nabcd");
  EXPECT_EQ(refusal("cut.pgm"), "cut.pgm: byte 11: 3 x 2 pixels need 6 bytes; the file has 4 more");
  folder.write("giant.pgm", "P5 20000 20000 255\nabcd");
  EXPECT_EQ(refusal("giant.pgm"),
            "giant.pgm: has 400000000 pixels, more than 100000000; for a file that you trust: "
            "INSONIFY_LIMITS=pixels=400000000");
  folder.write("long.pgm", "P5 2000000000 1 255\nabcd");
  EXPECT_EQ(refusal("long.pgm"),
            "long.pgm: byte 3: width = \"2000000000 1\" must be a whole number from 1 to 1073741824");
  folder.write("loud.pgm", "P5 2 1 100\nab");
  EXPECT_EQ(refusal("loud.pgm"), "no error");
  folder.write("louder.pgm", "P5 2 1 97\nab");
  EXPECT_EQ(refusal("louder.pgm"), "louder.pgm: byte 11: level 98 must be at most 97, its greatest");
  folder.write("words.pgm", "P2 2 1 9\n1 two");
  EXPECT_EQ(refusal("words.pgm"), "words.pgm: byte 11: level = \"two\" must be a whole number from 0 to 9");
}

// ---------------------------------------------------------------- JPEG

// Written by Pillow at quality 100: 12 rows and 16 columns of 10 row + 8 column, exact; the same as red, green and
// blue; and 8 x 8 red pixels.
constexpr const char* kGreyJpeg =
    "ffd8ffe000104a46494600010100000100010000ffdb00430001010101010101010101010101010101010101010101010101"
    "010101010101010101010101010101010101010101010101010101010101010101010101010101ffc0000b08000c00100101"
    "1100ffc4001500010100000000000000000000000000000a05ffc40021100000030803000000000000000000000000082502"
    "06072434415361436371ffda0008010100003f003ee5b4a4d02662e1f3410016d29340998b87cd0b85b61b3a5209f8aec6ba"
    "c2002db0d9d2904fc57635d63fffd9";
constexpr const char* kGreyAsColoursJpeg =
    "ffd8ffe000104a46494600010100000100010000ffdb00430001010101010101010101010101010101010101010101010101"
    "010101010101010101010101010101010101010101010101010101010101010101010101010101ffdb004301010101010101"
    "0101010101010101010101010101010101010101010101010101010101010101010101010101010101010101010101010101"
    "0101010101010101ffc0001108000c001003012200021101031101ffc4001500010100000000000000000000000000000a05"
    "ffc4002110000003080300000000000000000000000008250206072434415361436371ffc400140101000000000000000000"
    "00000000000000ffc40014110100000000000000000000000000000000ffda000c03010002110311003f003ee5b4a4d02662"
    "e1f3410016d29340998b87cd0b85b61b3a5209f8aec6bac2002db0d9d2904fc57635d603ffd9";
constexpr const char* kRedJpeg =
    "ffd8ffe000104a46494600010100000100010000ffdb0043001b12141714111b1716171e1c1b2028422b28252528513a3d30"
    "42605565645f555d5b6a7899816a7190735b5d85b586909ea3abadab6780bcc9baa6c799a8aba4ffdb0043011c1e1e282328"
    "4e2b2b4ea46e5d6ea4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4"
    "a4a4a4a4a4a4a4a4ffc00011080008000803012200021101031101ffc4001500010100000000000000000000000000000005"
    "ffc40014100100000000000000000000000000000000ffc4001501010100000000000000000000000000000405ffc4001411"
    "0100000000000000000000000000000000ffda000c03010002110311003f009600abafffd9";

std::string unhex(const char* digits) {
  std::string bytes;
  for (; *digits != '\0'; digits += 2) {
    bytes += static_cast<char>(std::stoi(std::string(digits, 2), nullptr, 16));
  }
  return bytes;
}

TEST(JpegTest, LevelsAreThoseOfThePixels) {
  const WorkingFolder folder;
  folder.write("grey.jpg", unhex(kGreyJpeg));
  folder.write("colours.JPEG", unhex(kGreyAsColoursJpeg));
  folder.write("unnamed", unhex(kGreyJpeg));
  for (const char* name : {"grey.jpg", "colours.JPEG", "unnamed"}) {
    EXPECT_TRUE(is_picture(name));
    const GreyPicture picture = load_grey_picture(name);
    ASSERT_EQ(picture.columns, 16) << name;
    ASSERT_EQ(picture.rows, 12) << name;
    for (int row = 0; row < 12; ++row) {
      for (int column = 0; column < 16; ++column) {
        EXPECT_NEAR(picture.values[row * 16 + column], (10 * row + 8 * column) / 255.0, 1e-12) << name;
      }
    }
  }
}

TEST(JpegTest, ColoursAndDamageAreOneMessage) {
  const WorkingFolder folder;
  folder.write("red.jpg", unhex(kRedJpeg));
  EXPECT_EQ(refusal("red.jpg"), "red.jpg: the pixel in column 0, row 0 is coloured; a comparison needs a grey picture");
  const std::string whole = unhex(kGreyJpeg);
  folder.write("cut.jpg", whole.substr(0, whole.size() - 40));
  EXPECT_EQ(refusal("cut.jpg"), "cut.jpg: cannot be read: Premature end of JPEG file");
  folder.write("head.jpg", whole.substr(0, 100));
  EXPECT_THAT(refusal("head.jpg"), HasSubstr("head.jpg: cannot be read: "));
  std::string giant = whole;
  const std::size_t size = giant.find("\xff\xc0") + 5;  // Height and width, most significant byte first.
  giant.replace(size, 4, "\xff\xff\xff\xff");
  folder.write("giant.jpg", giant);
  EXPECT_EQ(refusal("giant.jpg"), "giant.jpg: cannot be read: Maximum supported image dimension is 65500 pixels");
  giant.replace(size, 4, std::string("\xff\0\xff\0", 4));
  folder.write("large.jpg", giant);
  EXPECT_EQ(refusal("large.jpg"),
            "large.jpg: has 4261478400 pixels, more than 100000000; for a file that you trust: "
            "INSONIFY_LIMITS=pixels=4261478400");
}

TEST(JpegTest, RealCropsAreGrey) {
  INSONIFY_REAL_DATA(crops, "nksid_oculus_m750d_crops/cylinder.zip");
  const WorkingFolder folder;
  const std::string unpack = fmt::format("\"" INSONIFY_PYTHON "\" -m zipfile -e \"{}\" .", crops.string());
  ASSERT_EQ(std::system(unpack.c_str()), 0);  // NOLINT: only in tests.
  const GreyPicture crop = load_grey_picture("cylinder/img_1.jpg");
  EXPECT_EQ(crop.columns, 33);
  EXPECT_EQ(crop.rows, 36);
  EXPECT_THAT(crop.values, Each(testing::AllOf(testing::Ge(0), testing::Le(1))));
}

// As a recording: one ping of as many beams as columns.
TEST(GreyPictureTest, APictureIsAPingOfAFan) {
  const WorkingFolder folder;
  folder.write("a.pgm", "P5 3 2 100\n" + std::string("\0\x0a\x14\x32\x4b\x64", 6));
  const RecordedPings pings("a.pgm");
  EXPECT_EQ(pings.ping_count(), 1U);
  EXPECT_EQ(pings.beam_count(), 3);
  EXPECT_EQ(pings.foreign_format(), "picture");
  EXPECT_EQ(static_cast<float>(pings.intensity(0)[1]), 0.1F);
  EXPECT_THAT(pings.assumed(),
              ElementsAre("its rows are taken as bins of 0.01 m, the first as the nearest, its columns "
                          "as a fan of 120 deg"));
}

}  // namespace
}  // namespace insonify::grey_picture_test
