// xml_scan_test.cpp -- tags are found where they stand, and broken XML is told with its line.

#include "io/file/xml_scan.h"

#include "support/message_of.h"

namespace insonify {
namespace {

std::string fault_of(const std::string& text) {
  return message_of([&] { std::ignore = scan_xml(text, "a.sdf"); });
}

TEST(XmlScanTest, ListsElementsInOrderWithParentLineAndContent) {
  const std::string text =
      "<?xml version='1.0'?>\n<!-- <no> -->\n<a x=\"1 > 0\"  y='&lt;'>\n<b/>text<c >\nin</c></a>\n";
  const std::vector<XmlTag> tags = scan_xml(text, "a.sdf");
  ASSERT_EQ(tags.size(), 3);
  EXPECT_EQ(tags[0].name, "a");
  EXPECT_EQ(tags[0].line, 3);
  EXPECT_EQ(tags[0].parent, -1);
  EXPECT_EQ(tags[0].attributes.at("x"), "1 > 0");
  EXPECT_EQ(tags[0].attributes.at("y"), "<");
  EXPECT_EQ(tags[1].name, "b");
  EXPECT_EQ(tags[1].parent, 0);
  EXPECT_EQ(tags[1].content_begin, tags[1].content_end);
  EXPECT_EQ(tags[2].name, "c");
  EXPECT_EQ(tags[2].line, 4);
  EXPECT_EQ(text.substr(tags[2].content_begin, tags[2].content_end - tags[2].content_begin), "\nin");
  EXPECT_EQ(text.substr(tags[1].begin, tags[1].end - tags[1].begin), "<b/>");
  EXPECT_EQ(text.substr(tags[2].begin, tags[2].end - tags[2].begin), "<c >\nin</c>");
}

TEST(XmlScanTest, TakesNothingInsideCommentsAndCdataForElements) {
  EXPECT_EQ(scan_xml("<a><!-- <b> --><![CDATA[<c>]]></a>", "a.sdf").size(), 1);
}

TEST(XmlScanTest, DecodesWhatEncodeWrites) {
  const std::string text = "a<b>&\"c\" 'd' &amp;lt;";
  EXPECT_EQ(xml_decode(xml_encode(text)), text);
  EXPECT_EQ(xml_encode("R&D/<x>"), "R&amp;D/&lt;x&gt;");
}

TEST(XmlScanTest, DecodesContentWithoutCommentsAndOuterSpace) {
  EXPECT_EQ(xml_decode(" \n a<!-- no -->b<![CDATA[ <&lt; ]]>c\t"), "ab <&lt; c");
  EXPECT_EQ(xml_decode("  "), "");
  EXPECT_EQ(xml_decode("a<!-- open"), "a");
  EXPECT_EQ(xml_decode("a<![CDATA[b"), "ab");
}

TEST(XmlScanTest, TellsWhatIsBrokenAndWhere) {
  EXPECT_EQ(fault_of("<a>\n<b>\n</a>"), "a.sdf:3:1: </a> stands where <b> of line 2 should be closed");
  EXPECT_EQ(fault_of("<a>\n<b>\n</b>"), "a.sdf:1:1: <a> is never closed");
  EXPECT_EQ(fault_of("<a/>\n</b>"), "a.sdf:2:1: </b> closes nothing");
  EXPECT_EQ(fault_of("<a/>\n<b/>"), "a.sdf:2:1: <b> stands behind the end of <a>");
  EXPECT_EQ(fault_of("<a>\n<!-- "), "a.sdf:2:1: this comment is never closed");
  EXPECT_EQ(fault_of("<a>\n<![CDATA[ ]"), "a.sdf:2:1: this CDATA section is never closed");
  EXPECT_EQ(fault_of("\n<?xml "), "a.sdf:2:1: this declaration is never closed");
  EXPECT_EQ(fault_of("<a\nx='1'"), "a.sdf:1:1: the tag <a> is never closed");
  EXPECT_EQ(fault_of("<a>\n</a"), "a.sdf:2:1: </a is never closed");
  EXPECT_EQ(fault_of("<a x=1>"), "a.sdf:1:1: the tag <a> has an attribute without a quoted value");
  EXPECT_EQ(fault_of("<a x>"), "a.sdf:1:1: the tag <a> has an attribute without a quoted value");
  EXPECT_EQ(fault_of("<a x='1>"), "a.sdf:1:1: the tag <a> has an attribute without a quoted value");
  EXPECT_EQ(fault_of("words\n"), "a.sdf:2:1: there is no XML element in this file");
  EXPECT_EQ(fault_of(""), "a.sdf:1:1: there is no XML element in this file");
}

}  // namespace
}  // namespace insonify
