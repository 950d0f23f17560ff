#include "core/xml/xml_reading.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace runnel {
namespace {

XmlDocument DocumentOf(std::string_view text) { return std::move(XmlDocument::Parse(text, "a.xml").value()); }

TEST(ParseNumberTest, TakesFiniteDecimalNumbersOnly) {
  EXPECT_EQ(ParseNumber("1.5"), 1.5);
  EXPECT_EQ(ParseNumber(" -2e-3\n"), -0.002);
  EXPECT_EQ(ParseNumber("+4"), 4.0);
  for (const char* text : {"", " ", "1,5", "1.5m", "0x10", "nan", "inf", "1e999", "--1", "+-1", "+"}) {
    EXPECT_EQ(ParseNumber(text), std::nullopt) << text;
  }
}

TEST(ReadNumberTest, MissingAttributeIsAnErrorAtTheElement) {
  const XmlDocument document = DocumentOf("<box>\n</box>");
  Diagnostics diagnostics;
  EXPECT_EQ(ReadNumber(document.root(), "x", diagnostics), std::nullopt);
  EXPECT_EQ(diagnostics.ToString(), "a.xml:1:1: error: <box> has no 'x'; add x=\"…\"\n");
}

TEST(ReadNumberTest, WrongNumberIsAnErrorAtItsValue) {
  const XmlDocument document = DocumentOf("<box x='1,5'/>");
  Diagnostics diagnostics;
  EXPECT_EQ(ReadNumber(document.root(), "x", diagnostics), std::nullopt);
  ASSERT_EQ(diagnostics.errors().size(), 1U);
  EXPECT_EQ(diagnostics.errors()[0].message, "x=\"1,5\" is no number");
  EXPECT_EQ(diagnostics.errors()[0].position, (SourcePosition{"a.xml", 1, 9}));
}

TEST(ReadNumberOrTest, MissingIsTheFallbackAndWrongIsStillAnError) {
  const XmlDocument document = DocumentOf("<box x='1' y='one'/>");
  Diagnostics diagnostics;
  EXPECT_EQ(ReadNumberOr(document.root(), "height", 2.5, diagnostics), 2.5);
  EXPECT_EQ(ReadNumberOr(document.root(), "x", 2.5, diagnostics), 1.0);
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_EQ(ReadNumberOr(document.root(), "y", 2.5, diagnostics), 2.5);
  EXPECT_FALSE(diagnostics.ok());
}

TEST(ReadTextTest, MissingIsAnErrorAndEmptyIsNot) {
  const XmlDocument document = DocumentOf("<box name=''/>");
  Diagnostics diagnostics;
  ASSERT_NE(ReadText(document.root(), "name", diagnostics), nullptr);
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_EQ(ReadText(document.root(), "type", diagnostics), nullptr);
  EXPECT_FALSE(diagnostics.ok());
}

TEST(CheckAttributesTest, UnknownOneIsNamedWithTheNearestNotYetGiven) {
  const XmlDocument document = DocumentOf("<cylinder x='1' y='2' raduis='1'/>");
  Diagnostics diagnostics;
  const std::vector<std::string> known{"x", "y", "radius"};
  CheckAttributes(document.root(), known, diagnostics);
  EXPECT_EQ(diagnostics.ToString(), "a.xml:1:23: error: <cylinder> knows no 'raduis'; did you mean 'radius'?\n");
}

TEST(CheckAttributesTest, HintsToLeaveItOutIfAllKnownOnesAreGiven) {
  const XmlDocument document = DocumentOf("<a x='1' z='2'/>");
  Diagnostics diagnostics;
  const std::vector<std::string> known{"x"};
  CheckAttributes(document.root(), known, diagnostics);
  EXPECT_EQ(diagnostics.ToString(), "a.xml:1:10: error: <a> knows no 'z'; leave it out\n");
}

TEST(CheckChildrenTest, TellsAllUnknownOnesAtOnceAndText) {
  const XmlDocument document = DocumentOf("<world>\n<bxo/>\nhello<wall/>\n<xyzzy/></world>");
  Diagnostics diagnostics;
  const std::vector<std::string> known{"box", "wall"};
  CheckChildren(document.root(), known, diagnostics);
  EXPECT_EQ(diagnostics.ToString(),
            "a.xml:2:1: error: no <bxo> may stand in <world>; did you mean 'box'?\n"
            "a.xml:3:1: error: no text may stand in <world>; leave out 'hello'\n"
            "a.xml:4:1: error: no <xyzzy> may stand in <world>; there is 'box', 'wall'\n");
}

TEST(CheckChildrenTest, CutsALongTextBetweenCharacters) {
  const std::string before(39, 'x');
  const XmlDocument document = DocumentOf("<world>" + before + "\xC3\xA9 and more</world>");
  Diagnostics diagnostics;
  CheckChildren(document.root(), {}, diagnostics);
  EXPECT_EQ(diagnostics.errors().front().hint, "leave out '" + before + "'");
}

}  // namespace
}  // namespace runnel
