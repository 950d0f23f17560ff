// What is changed of a text, and that nothing else is.

#include "core/xml/xml_editor.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace runnel {
namespace {

std::string Edited(const std::string& text, const std::function<void(XmlEditor&, XmlElement root)>& change) {
  const auto document = XmlDocument::Parse(text, "test.xml");
  if (!document) return document.error().ToString();
  XmlEditor editor(*document, text);
  change(editor, document->root());
  std::string result = editor.Finish();
  const auto again = XmlDocument::Parse(result, "result.xml");
  EXPECT_TRUE(again) << again.error().ToString() << '\n' << result;
  return result;
}

const NewElement kNew{.name = "new", .attributes = {{"a", "1"}}};

TEST(XmlSpans, AreThoseOfTheBytesOfTheFile) {
  const std::string text = "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<a ü='x y'>t<b/><c>d</c ></a>\n";
  const auto document = XmlDocument::Parse(text, "test.xml");
  ASSERT_TRUE(document) << document.error().ToString();
  const auto of = [&](TextSpan span) { return text.substr(span.begin, span.size()); };
  const XmlElement root = document->root();
  EXPECT_EQ(of(root.spans().whole), "<a ü='x y'>t<b/><c>d</c ></a>");
  EXPECT_EQ(of(root.spans().start_tag), "<a ü='x y'>");
  EXPECT_EQ(of(root.spans().end_tag), "</a>");
  EXPECT_EQ(of(root.attributes()[0].span), "ü='x y'");
  EXPECT_EQ(of(root.attributes()[0].value_span), "x y");
  EXPECT_EQ(of(root.children()[0].spans().whole), "<b/>");
  EXPECT_EQ(root.children()[0].spans().end_tag.size(), 0u);
  EXPECT_EQ(of(root.children()[1].spans().whole), "<c>d</c >");
  EXPECT_EQ(of(root.children()[1].spans().end_tag), "</c >");
}

TEST(XmlEditor, SetsTextsAndLeavesComments) {
  const auto set = [](const std::string& text) {
    return Edited(text, [](XmlEditor& editor, XmlElement root) {
      for (const XmlElement child : root.children()) editor.SetText(child, "a<b");
    });
  };
  EXPECT_EQ(set("<r><v> 1 </v></r>"), "<r><v> a&lt;b </v></r>");
  EXPECT_EQ(set("<r><v/><v></v></r>"), "<r><v>a&lt;b</v><v>a&lt;b</v></r>");
  EXPECT_EQ(set("<r><v><!-- x -->1<!-- y -->2</v></r>"), "<r><v><!-- x -->a&lt;b<!-- y --></v></r>");
  EXPECT_EQ(set("<r><v><![CDATA[1]]></v></r>"), "<r><v>a&lt;b</v></r>");
  EXPECT_EQ(set("<r><v>a&lt;b<!-- x --></v></r>"), "<r><v>a&lt;b<!-- x --></v></r>");
}

TEST(XmlEditor, LeavesWhatIsNotChangedAsItIs) {
  const std::string text = "\xEF\xBB\xBF<?xml version='1.0'?>\r\n<!-- ä -->\r\n<a  x = '&#65;' >\r\n\t<b/></a>\r\n\r\n";
  EXPECT_EQ(Edited(text, [](XmlEditor&, XmlElement) {}), text);
}

TEST(XmlEditor, RewritesAnAttributeWithinItsQuotes) {
  const auto set = [](XmlEditor& editor, XmlElement root) { editor.SetAttribute(root, "x", "\"&<'\n"); };
  EXPECT_EQ(Edited("<a w='1'  x = 'old' y='2'/>", set), "<a w='1'  x = '\"&amp;&lt;&apos;&#10;' y='2'/>");
  EXPECT_EQ(Edited("<a x=\"old\"/>", set), "<a x=\"&quot;&amp;&lt;'&#10;\"/>");
}

TEST(XmlEditor, AddsAnAttributeBehindTheOthers) {
  const auto set = [](XmlEditor& editor, XmlElement root) { editor.SetAttribute(root, "x", "1"); };
  EXPECT_EQ(Edited("<a\n  w='1' />", set), "<a\n  w='1' x=\"1\" />");
  EXPECT_EQ(Edited("<a></a>", set), "<a x=\"1\"></a>");
}

TEST(XmlEditor, RemovesAnAttributeWithTheWhitespaceBeforeIt) {
  const auto remove = [](XmlEditor& editor, XmlElement root) {
    editor.RemoveAttribute(root, "x");
    editor.RemoveAttribute(root, "none");
  };
  EXPECT_EQ(Edited("<a w='1'\n   x='2' y='3'/>", remove), "<a w='1' y='3'/>");
  EXPECT_EQ(Edited("<a x='2'/>", remove), "<a/>");
}

TEST(XmlEditor, TakesWordsOutOfAList) {
  const auto without = [](std::set<std::size_t> words) {
    return Edited("<a to=' one  two\n three '/>",
                  [&](XmlEditor& editor, XmlElement root) { editor.RemoveWords(*root.Attribute("to"), words); });
  };
  EXPECT_EQ(without({0}), "<a to=' two\n three '/>");
  EXPECT_EQ(without({1}), "<a to=' one\n three '/>");
  EXPECT_EQ(without({2}), "<a to=' one  two '/>");
  EXPECT_EQ(without({0, 1}), "<a to=' three '/>");
  EXPECT_EQ(without({0, 2}), "<a to=' two '/>");
  EXPECT_EQ(without({1, 2}), "<a to=' one '/>");
}

TEST(XmlEditor, RemovesAnElementWithItsLine) {
  const auto remove = [](XmlEditor& editor, XmlElement root) { editor.Remove(root.children()[0]); };
  EXPECT_EQ(Edited("<a>\n  <!-- c -->\n  <b>\n  </b> \n  <d/>\n</a>", remove), "<a>\n  <!-- c -->\n  <d/>\n</a>");
  EXPECT_EQ(Edited("<a>\r\n  <b/>\r\n  <d/>\r\n</a>", remove), "<a>\r\n  <d/>\r\n</a>");
  EXPECT_EQ(Edited("<a>\n  <b/> <d/>\n</a>", remove), "<a>\n  <d/>\n</a>");
  EXPECT_EQ(Edited("<a>\n  <b/> <!-- c -->\n</a>", remove), "<a>\n  <!-- c -->\n</a>");
  EXPECT_EQ(Edited("<a><b/><d/></a>", remove), "<a><d/></a>");
}

TEST(XmlEditor, RemovesNeighboursOfOneLine) {
  EXPECT_EQ(Edited("<a>\n  <b/> <c/> <d/>\n</a>",
                   [](XmlEditor& editor, XmlElement root) {
                     editor.Remove(root.children()[0]);
                     editor.Remove(root.children()[1]);
                   }),
            "<a>\n  <d/>\n</a>");
}

TEST(XmlEditor, AppendsInTheMannerOfTheFile) {
  const auto append = [](XmlEditor& editor, XmlElement root) { editor.Append(root, kNew); };
  EXPECT_EQ(Edited("<a>\n\t<b/>\n</a>", append), "<a>\n\t<b/>\n\t<new a=\"1\"/>\n</a>");
  EXPECT_EQ(Edited("<a>\r\n    <b/>\r\n</a>", append), "<a>\r\n    <b/>\r\n    <new a=\"1\"/>\r\n</a>");
  EXPECT_EQ(Edited("<a/>\n", append), "<a>\n  <new a=\"1\"/>\n</a>\n");
  EXPECT_EQ(Edited("<a x='1' />", append), "<a x='1'>\n  <new a=\"1\"/>\n</a>");
  EXPECT_EQ(Edited("<a></a>", append), "<a>\n  <new a=\"1\"/>\n</a>");
  EXPECT_EQ(Edited("<a><b/></a>", append), "<a><b/>\n  <new a=\"1\"/>\n</a>");
}

TEST(XmlEditor, AppendsToAnInnerElementThatWasEmpty) {
  EXPECT_EQ(Edited("<a>\n   <b x='1'/>\n</a>",
                   [](XmlEditor& editor, XmlElement root) {
                     editor.SetAttribute(root.children()[0], "y", "2");
                     editor.Append(root.children()[0], kNew);
                     editor.Append(root.children()[0], {.name = "p", .children = {kNew}});
                   }),
            "<a>\n   <b x='1' y=\"2\">\n      <new a=\"1\"/>\n      <p>\n         <new a=\"1\"/>\n"
            "      </p>\n   </b>\n</a>");
}

TEST(XmlEditor, InsertsBehindASibling) {
  const auto insert = [](XmlEditor& editor, XmlElement root) { editor.InsertAfter(root.children()[0], kNew); };
  EXPECT_EQ(Edited("<a>\n  <b/>\n  <c/>\n</a>", insert), "<a>\n  <b/>\n  <new a=\"1\"/>\n  <c/>\n</a>");
  EXPECT_EQ(Edited("<a>\n  <b/> <!-- of b -->\n</a>", insert), "<a>\n  <b/>\n  <new a=\"1\"/> <!-- of b -->\n</a>");
}

TEST(XmlEditor, InsertsAsTheFirst) {
  const auto insert = [](XmlEditor& editor, XmlElement root) { editor.InsertFirst(root, kNew); };
  EXPECT_EQ(Edited("<a>\n\n  <b/>\n</a>", insert), "<a>\n  <new a=\"1\"/>\n\n  <b/>\n</a>");
  EXPECT_EQ(Edited("<a/>", insert), "<a>\n  <new a=\"1\"/>\n</a>");
}

TEST(XmlEditor, CutsWhereItAlsoAppends) {
  EXPECT_EQ(Edited("<a>\n  <b/>\n</a>\n",
                   [](XmlEditor& editor, XmlElement root) {
                     editor.Append(root, kNew);
                     editor.Remove(root.children()[0]);
                   }),
            "<a>\n  <new a=\"1\"/>\n</a>\n");
}

}  // namespace
}  // namespace runnel
