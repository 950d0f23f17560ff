#include "core/xml/xml_document.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace runnel {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

XmlDocument Parsed(std::string_view text) {
  auto document = XmlDocument::Parse(text, "a.xml");
  if (!document) throw std::runtime_error(document.error().ToString());
  return std::move(*document);
}

std::string ErrorOf(std::string_view text) {
  const auto document = XmlDocument::Parse(text, "a.xml");
  return document ? "no error" : document.error().ToString();
}

SourcePosition At(int line, int column) { return {"a.xml", line, column}; }

TEST(XmlDocumentTest, ElementsKnowNameLineAndColumn) {
  const XmlDocument document = Parsed("<world>\n  <box/> <wall></wall>\n</world>");
  const XmlElement root = document.root();
  EXPECT_EQ(root.name(), "world");
  EXPECT_EQ(root.position(), At(1, 1));
  ASSERT_EQ(root.children().size(), 2U);
  EXPECT_EQ(root.children()[0].position(), At(2, 3));
  EXPECT_EQ(root.children()[1].name(), "wall");
  EXPECT_EQ(root.children()[1].position(), At(2, 10));
}

TEST(XmlDocumentTest, AttributesKnowLineAndColumnOfNameAndValue) {
  const XmlDocument document = Parsed("<box x=\"1\"\n     y = '2'/>");
  const XmlAttribute* y = document.root().Attribute("y");
  ASSERT_NE(y, nullptr);
  EXPECT_EQ(y->value, "2");
  EXPECT_EQ(y->position, At(2, 6));
  EXPECT_EQ(y->value_position, At(2, 11));
  EXPECT_EQ(document.root().attributes()[0].name, "x");
  EXPECT_EQ(document.root().Attribute("z"), nullptr);
}

TEST(XmlDocumentTest, ChildrenKnowTheirParentAndTheRootHasNone) {
  const XmlDocument document = Parsed("<a><b/></a>");
  EXPECT_EQ(document.root().children()[0].parent(), document.root());
  EXPECT_EQ(document.root().parent(), std::nullopt);
}

TEST(XmlDocumentTest, HandlesOutliveAMoveOfTheDocument) {
  XmlDocument first = Parsed("<a><b c='1'/></a>");
  const XmlElement b = first.root().children()[0];
  const XmlDocument second = std::move(first);
  EXPECT_EQ(b.name(), "b");
  EXPECT_EQ(b.position(), At(1, 4));
  EXPECT_EQ(b.parent(), second.root());
}

TEST(XmlDocumentTest, TextIsJoinedFromTextAndCharacterDataWithoutCommentsAndChildren) {
  const XmlDocument document =
      Parsed("<a>\n  one &lt; <!-- not this --><b>nor this</b><![CDATA[<two> & ]]>three\n</a>");
  EXPECT_EQ(document.root().text(), "one < <two> & three");
}

TEST(XmlDocumentTest, TextKnowsWhereItBegins) {
  const XmlDocument document = Parsed("<a>\n  <b>\n x</b> late <![CDATA[y]]></a>");
  EXPECT_EQ(document.root().text_position(), At(3, 8));
  EXPECT_EQ(document.root().children()[0].text_position(), At(3, 2));
  EXPECT_EQ(Parsed("<a><![CDATA[y]]></a>").root().text_position(), At(1, 4));
  EXPECT_EQ(Parsed("<a> </a>").root().text_position(), At(1, 1));
}

TEST(XmlDocumentTest, EntitiesInAttributesAreResolved) {
  const XmlDocument document = Parsed("<a b='&lt;&amp;&gt;&quot;&apos;&#65;&#x42;' c=\"it's\"/>");
  EXPECT_EQ(document.root().Attribute("b")->value, "<&>\"'AB");
  EXPECT_EQ(document.root().Attribute("c")->value, "it's");
}

TEST(XmlDocumentTest, CommentsAndCharacterDataDoNotDisturbThePlaces) {
  const XmlDocument document = Parsed("<?xml version='1.0'?>\n<!-- <x y='>'>\n -->\n<a> <![CDATA[<b>]]> <b/></a>");
  EXPECT_EQ(document.root().position(), At(4, 1));
  ASSERT_EQ(document.root().children().size(), 1U);
  EXPECT_EQ(document.root().children()[0].position(), At(4, 21));
}

TEST(XmlDocumentTest, GreaterSignInsideAValueDoesNotEndTheTag) {
  const XmlDocument document = Parsed("<a b='x > y' c='2'><d/></a>");
  EXPECT_EQ(document.root().Attribute("b")->value, "x > y");
  EXPECT_EQ(document.root().Attribute("c")->position, At(1, 14));
}

TEST(XmlDocumentTest, ByteOrderMarkIsNoColumn) {
  const XmlDocument document = Parsed("\xEF\xBB\xBF<a b='1'/>");
  EXPECT_EQ(document.root().position(), At(1, 1));
  EXPECT_EQ(document.root().Attribute("b")->position, At(1, 4));
}

TEST(XmlDocumentTest, LineEndsOfWindowsCountOnce) {
  const XmlDocument document = Parsed("<a>\r\n\r\n  <b/>\r\n</a>\r\n");
  EXPECT_EQ(document.root().children()[0].position(), At(3, 3));
}

TEST(XmlDocumentTest, ColumnsCountCharactersNotBytes) {
  const XmlDocument document = Parsed("<a b='äöü€' c='1'/>");
  EXPECT_EQ(document.root().Attribute("c")->position, At(1, 13));
}

TEST(XmlDocumentErrorTest, WrongEndTagNamesWhatIsOpenAndWhere) {
  EXPECT_EQ(ErrorOf("<a>\n  <b>\n  </a>"),
            "a.xml:3:3: </a> where <b> of line 2, column 3 is still open; write </b> first");
}

TEST(XmlDocumentErrorTest, UnclosedElementIsNamedWhereItBegins) {
  EXPECT_EQ(ErrorOf("<a>\n <b/>"), "a.xml:1:1: <a> is never closed; add </a>");
}

TEST(XmlDocumentErrorTest, NothingButWhiteSpaceIsNoDocument) {
  EXPECT_EQ(ErrorOf(""), "a.xml:1:1: there is no element");
  EXPECT_EQ(ErrorOf(" \n "), "a.xml:2:2: there is no element");
  EXPECT_EQ(ErrorOf("<!-- only -->"), "a.xml:1:14: there is no element");
}

TEST(XmlDocumentErrorTest, ControlCharactersAreRefusedWithTheirPlace) {
  EXPECT_EQ(ErrorOf(std::string_view("<a>\n \0</a>", 10)), "a.xml:2:2: control character 0x00");
  EXPECT_EQ(ErrorOf(std::string_view("<a b='\0'/>", 10)), "a.xml:1:7: control character 0x00");
}

TEST(XmlDocumentErrorTest, OtherEncodingsAreRefused) {
  EXPECT_THAT(ErrorOf("<a b='\xE4'/>"), StartsWith("a.xml:1:7: byte 0xe4, which is no UTF-8"));
  EXPECT_THAT(ErrorOf(std::string_view("\xFF\xFE<\0", 4)), StartsWith("a.xml:1:1: the file is UTF-16"));
}

TEST(XmlDocumentErrorTest, NamesAreUtf8Too) {
  EXPECT_THAT(ErrorOf("<a>\n<n\xE4me/></a>"), StartsWith("a.xml:2:3: byte 0xe4, which is no UTF-8"));
  EXPECT_THAT(ErrorOf("<a n\xC3\xA4=''\xFF=''/>"), StartsWith("a.xml:1:9: byte 0xff, which is no UTF-8"));
  EXPECT_THAT(ErrorOf("<a></a\xE4>"), StartsWith("a.xml:1:7: byte 0xe4, which is no UTF-8"));
  EXPECT_TRUE(XmlDocument::Parse("<\xC3\xA4 \xC3\xB6=''></\xC3\xA4>", "a.xml"));
}

TEST(XmlDocumentErrorTest, EntitiesHaveLettersOnly) {
  EXPECT_THAT(ErrorOf("<a b='&am\xE4p;'/>"), StartsWith("a.xml:1:7: '&' begins an entity that no ';' ends"));
  EXPECT_THAT(ErrorOf("<a>&am\1p;</a>"), StartsWith("a.xml:1:4: '&' begins an entity that no ';' ends"));
}

TEST(XmlDocumentErrorTest, DeclaredEncodingMustBeOneThatIsRead) {
  EXPECT_THAT(ErrorOf("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><a/>"),
              StartsWith("a.xml:1:1: the file says that it is ISO-8859-1"));
  for (const char* readable : {"UTF-8", "utf-8", "US-ASCII"}) {
    const std::string declaration = std::string("<?xml version='1.0' encoding='") + readable + "'?>";
    EXPECT_TRUE(XmlDocument::Parse(declaration + "<a/>", "a.xml")) << readable;
  }
}

TEST(XmlDocumentErrorTest, AttributeTwiceIsRefusedAtTheSecond) {
  EXPECT_EQ(ErrorOf("<a b='1' b='2'/>"), "a.xml:1:10: attribute 'b' stands here twice; leave one out");
}

TEST(XmlDocumentErrorTest, AttributesOfWrongFormAreRefused) {
  EXPECT_THAT(ErrorOf("<a b=1/>"), StartsWith("a.xml:1:6: the value of 'b' is not in quotes"));
  EXPECT_EQ(ErrorOf("<a b/>"), "a.xml:1:4: attribute 'b' has no value");
  EXPECT_EQ(ErrorOf("<a b='1'c='2'/>"), "a.xml:1:9: no space before attribute 'c'");
  EXPECT_THAT(ErrorOf("<a b='1/>\n<c/>"), StartsWith("a.xml:1:4: the value of 'b' has no closing quote"));
  EXPECT_THAT(ErrorOf("<a b='1"), StartsWith("a.xml:1:4: the value of 'b' has no closing quote"));
  EXPECT_EQ(ErrorOf("<a 1b='1'/>"), "a.xml:1:4: an attribute must begin with a letter");
}

TEST(XmlDocumentErrorTest, EntitiesUnknownOrUnfinishedAreRefused) {
  EXPECT_EQ(ErrorOf("<a b='&nbsp;'/>"), "a.xml:1:7: no entity '&nbsp;'; write &amp; for the character '&'");
  EXPECT_THAT(ErrorOf("<a>R&D</a>"), HasSubstr("a.xml:1:5: '&' begins an entity"));
  EXPECT_THAT(ErrorOf("<a>&#0;</a>"), HasSubstr("no entity '&#0;'"));
  EXPECT_THAT(ErrorOf("<a>&#xD800;</a>"), HasSubstr("no entity"));
}

TEST(XmlDocumentErrorTest, UnfinishedConstructsAreNamedWhereTheyBegin) {
  EXPECT_THAT(ErrorOf("<a><!-- b</a>"), StartsWith("a.xml:1:4: a comment that is never closed"));
  EXPECT_THAT(ErrorOf("<a><![CDATA[ b</a>"), StartsWith("a.xml:1:4: a CDATA section that is never closed"));
  EXPECT_EQ(ErrorOf("<a b='1'"), "a.xml:1:1: the tag <a> has no '>'");
  EXPECT_THAT(ErrorOf("<a>1 < 2</a>"), StartsWith("a.xml:1:6: '<' without a name"));
  EXPECT_EQ(ErrorOf("<a></a"), "a.xml:1:4: an end tag without '>'");
}

TEST(XmlDocumentErrorTest, OneRootAndNothingBesideIt) {
  EXPECT_THAT(ErrorOf("<a/>\n<b/>"), StartsWith("a.xml:2:1: a second root element <b>"));
  EXPECT_EQ(ErrorOf("<a/> b"), "a.xml:1:6: text outside of the root element");
  EXPECT_EQ(ErrorOf("</a>"), "a.xml:1:1: </a> closes nothing");
  EXPECT_THAT(ErrorOf("<!DOCTYPE a><a/>"), StartsWith("a.xml:1:1: a document type declaration"));
  EXPECT_THAT(ErrorOf("<a/><?b?>"), StartsWith("a.xml:1:5: '<?' must stand"));
}

TEST(XmlDocumentErrorTest, NestingBeyondTheLimitIsRefusedRatherThanOverflowingTheStack) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_EQ(ErrorOf(deep), "a.xml:1:271: elements nested too deeply");
}

/// Whatever is cut off or changed in a document, it is read or refused with a place, never worse.
TEST(XmlDocumentErrorTest, DamagedTextIsReadOrRefusedWithItsPlace) {
  const std::string whole = "<?xml version='1.0'?>\n<a b='1' c=\"&lt;\"><!-- x --><b>t&amp;</b><![CDATA[<]]></a>";
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const std::string& piece : {std::string(), std::string("<"), std::string(">"), std::string("&"),
                                     std::string("\""), std::string("\xC3")}) {
      for (const std::string& damaged :
           {whole.substr(0, i) + piece, whole.substr(0, i) + piece + whole.substr(i + 1)}) {
        const auto document = XmlDocument::Parse(damaged, "a.xml");
        if (document) continue;
        EXPECT_GT(document.error().position.line, 0) << damaged;
        EXPECT_GT(document.error().position.column, 0) << document.error().ToString() << damaged;
      }
    }
  }
}

class XmlFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "." + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path Write(const std::string& name, std::string_view text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  static std::string LoadError(const std::filesystem::path& path) {
    const auto document = XmlDocument::Load(path);
    return document ? "no error" : document.error().ToString();
  }

  std::filesystem::path folder_;
};

TEST_F(XmlFileTest, LoadReadsAFileAndNamesItInPositions) {
  const auto path = Write("cup.xml", "<a/>");
  const auto document = XmlDocument::Load(path);
  ASSERT_TRUE(document);
  EXPECT_EQ(document->root().position().file, path.string());
}

TEST_F(XmlFileTest, MissingFileIsNamedWithItsNearestNeighbour) {
  Write("cup.xml", "<a/>");
  EXPECT_EQ(LoadError(folder_ / "cpu.xml"),
            (folder_ / "cpu.xml").string() + ": there is no such file; did you mean 'cup.xml'?");
  EXPECT_THAT(LoadError(folder_ / "nowhere" / "cup.xml"), HasSubstr("there is no such file"));
}

TEST_F(XmlFileTest, FolderInPlaceOfAFileIsRefused) {
  EXPECT_THAT(LoadError(folder_), HasSubstr("is a folder, not a file"));
}

TEST_F(XmlFileTest, EmptyFileIsRefused) {
  EXPECT_THAT(LoadError(Write("empty.xml", "")), HasSubstr("empty.xml:1:1: there is no element"));
}

}  // namespace
}  // namespace runnel
