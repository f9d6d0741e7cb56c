// xml_file_test.cpp -- XML elements have their position in the file, and so have errors about malformed XML.

#include "io/file/xml_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/message_of.h"

namespace insonify::xml_file_test {
namespace {

std::string fault_of(const std::string& text) {
  return message_of([&] { const XmlFile file(text, "a.sdf"); });
}

TEST(XmlFileTest, TellsLineAndColumnOfElements) {
  const XmlFile file("<?xml version='1.0'?>\n<!-- <no> -->\n<a x=\"1 > 0\"  y='&lt;'>\r\n<b/>text<c >\nin</c></a>\n",
                     "a.sdf");
  EXPECT_EQ(file.where(file.root()), "a.sdf:3:1: ");
  EXPECT_EQ(file.where(file.root().child("b")), "a.sdf:4:1: ");
  EXPECT_EQ(file.where(file.root().child("c")), "a.sdf:4:9: ");
  EXPECT_EQ(file.line_of(file.root().child("c")), 4);
}

TEST(XmlFileTest, CountsColumnsInBytesWhateverTheEncodingIsSaidToBe) {
  const XmlFile file("<?xml version='1.0' encoding='iso-8859-1'?><a>\xc3\xbc\xfc<b/></a>", "a.sdf");
  EXPECT_EQ(file.where(file.root().child("b")), "a.sdf:1:50: ");
  EXPECT_EQ(xml_text(file.root()), "\xc3\xbc\xfc");
}

TEST(XmlFileTest, HasNoPlaceForAddedElements) {
  const XmlFile file("<a/>", "a.sdf");
  const pugi::xml_node added = file.root().append_child("b");
  EXPECT_EQ(file.where(added), "a.sdf: ");
  EXPECT_EQ(file.line_of(added), 0);
}

TEST(XmlFileTest, GivesTextWithoutCommentsAndOuterSpace) {
  EXPECT_EQ(xml_text(XmlFile("<a> \n b<!-- no -->c<![CDATA[ <&lt; ]]>d&amp;&#x6c34;\t</a>", "a.sdf").root()),
            "bc <&lt; d&水");
  EXPECT_EQ(xml_text(XmlFile("<a>  <b>no</b></a>", "a.sdf").root()), "");
  EXPECT_EQ(without_outer_space(" \t a b\r\n"), "a b");
  EXPECT_EQ(without_outer_space(" \n"), "");
}

TEST(XmlFileTest, TellsWhatIsBrokenAndWhere) {
  const std::string mismatch = "not valid XML: an element is not closed, or closed twice";
  EXPECT_EQ(fault_of("<a>\n<b>\n</a>"), "a.sdf:3:3: " + mismatch);
  EXPECT_EQ(fault_of("<a>\n<b>\n</b>"), "a.sdf:3:4: " + mismatch);
  EXPECT_EQ(fault_of("<a/>\n</b>"), "a.sdf:2:3: " + mismatch);
  EXPECT_EQ(fault_of("<a/>\n<b/>"), "a.sdf:2:1: <b> follows the end of <a>");
  EXPECT_EQ(fault_of("<a/><b\u202e/>"), "a.sdf:1:5: <b\\u202e> follows the end of <a>");
  EXPECT_EQ(fault_of("<a>\n<!-- "), "a.sdf:2:5: not valid XML: Error parsing comment");
  EXPECT_EQ(fault_of("<a>\n<![CDATA[ ]"), "a.sdf:2:10: not valid XML: Error parsing CDATA section");
  EXPECT_EQ(fault_of("\n<?xml "),
            "a.sdf:2:6: not valid XML: Error parsing document declaration/processing instruction");
  EXPECT_EQ(fault_of("<a\nx='1'"), "a.sdf:2:5: not valid XML: Error parsing start element tag");
  EXPECT_EQ(fault_of("<a>\n</a"), "a.sdf:2:3: not valid XML: Error parsing end element tag");
  EXPECT_EQ(fault_of("<a x=1>"), "a.sdf:1:6: not valid XML: Error parsing element attribute");
  EXPECT_EQ(fault_of("<a x='1>"), "a.sdf:1:7: not valid XML: Error parsing element attribute");
  EXPECT_EQ(fault_of("words\n"), "a.sdf:1:1: there is no XML element in this file");
  EXPECT_EQ(fault_of(""), "a.sdf:1:1: there is no XML element in this file");
}

TEST(XmlFileTest, RefusesDeepNesting) {
  const auto nested = [](int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) {
      text += "<a>";
    }
    for (int i = 0; i < levels; ++i) {
      text += "</a>";
    }
    return text;
  };
  EXPECT_EQ(fault_of(nested(200)), "no error");
  EXPECT_EQ(fault_of(nested(201)), "a.sdf:1:601: <a> is nested too deeply: more than 200 elements are open");
  EXPECT_EQ(fault_of(nested(1'000'000)), "a.sdf:1:601: <a> is nested too deeply: more than 200 elements are open");
}

}  // namespace
}  // namespace insonify::xml_file_test
