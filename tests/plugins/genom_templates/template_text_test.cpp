#include <algorithm>

#include <gtest/gtest.h>

#include "plugins/genom_templates/template_run.h"

namespace runnel::genom {
namespace {

std::string Program(const std::string& text) {
  const auto program = ProgramOf(text);
  return program ? *program : program.error().ToString();
}

TEST(TemplateTextTest, TextScriptsAndValues) {
  EXPECT_EQ(Program("a\nb"), " write_text(\"a\\n\")\n write_text(\"b\")");
  EXPECT_EQ(Program("a<%= x %>b"), " write_text(\"a\") write_value( x ) write_text(\"b\")");
  EXPECT_EQ(Program("say \"\\\""), " write_text(\"say \\\"\\\\\\\"\")");
}

TEST(TemplateTextTest, AScriptThatIsAloneInItsLineLeavesNone) {
  EXPECT_EQ(Program("a\n  <% x() %>  \nb\n"), " write_text(\"a\\n\")\n  x() \n  write_text(\"b\\n\")\n");
  EXPECT_EQ(Program("<% x() %>\n<% y() %> <% z() %>\nb"), "  x() \n   y()    z() \n  write_text(\"b\")");
  EXPECT_EQ(Program("a <% x() %>\n"), " write_text(\"a \")  x()   write_text(\"\\n\")\n");
}

TEST(TemplateTextTest, LinesOfTheProgramAreThoseOfTheTemplate) {
  const std::string text = "one\n<% if x then\n   y() %>\ntwo <%= z\n%> three\n<% end %>\nfour\n";
  const std::string program = Program(text);
  EXPECT_EQ(std::count(program.begin(), program.end(), '\n'), std::count(text.begin(), text.end(), '\n'));
}

TEST(TemplateTextTest, MarkersHaveTwoHalves) {
  const auto open = ProgramOf("a\n b <% c");
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().message, "'<%' has no end");
  EXPECT_EQ(open.error().position, (SourcePosition{"", 2, 4}));
  const auto closed = ProgramOf("a %>");
  ASSERT_FALSE(closed);
  EXPECT_EQ(closed.error().position, (SourcePosition{"", 1, 3}));
}

}  // namespace
}  // namespace runnel::genom
