// What template `runnel` makes of descriptions compiles, or is refused by name.

#include <cstdlib>

#include <gmock/gmock.h>

#include "plugins/genom_description/description.h"
#include "plugins/genom_templates/template_run.h"
#include "tests/support/temporary_folder.h"

namespace runnel::genom {
namespace {

using testing::HasSubstr;

Result<TemplateOutput> ModuleOf(const std::string& text, const std::string& name = "runnel") {
  Diagnostics diagnostics;
  const auto description = ReadDescriptionText(text, "c.gen", {}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  return RunTemplate(std::string(RUNNEL_GENOM_TEMPLATE_FOLDER "/") + name, DescriptionJson(*description), {});
}

std::string Refusal(const std::string& text) {
  const auto output = ModuleOf(text);
  return output ? "" : output.error().ToString();
}

TEST(ModuleTemplateTest, ASequenceOfAUnionThatIsAnnounced) {
  if (std::system("g++ --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no compiler";
  const auto output = ModuleOf(
      "union either; typedef sequence<either> many; struct all { many each; };\n"
      "union either switch (boolean) { case TRUE: long number; case FALSE: double real; };\n"
      "component c { port in all seen; ids { all last; }; task t { codel<start> k(in seen, out last) yield ether; }; "
      "};\n");
  ASSERT_TRUE(output) << output.error().ToString();
  const test::TemporaryFolder folder;
  Diagnostics diagnostics;
  (void)WriteFiles(folder.path(), output->files, WhatIsThere::kIsMerged, diagnostics);
  const std::string command = "cd '" + folder.path().string() +
                              "' && g++ -std=c++20 -fsyntax-only -Wall -Werror -I. -I" RUNNEL_TEST_ROOT
                              " c_module.cpp 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

TEST(ModuleTemplateTest, WordsOfCxxAreNoNames) {
  EXPECT_THAT(Refusal("component c {\n  ids { long class; }; };\n"),
              HasSubstr("a member of 'c::ids' cannot be called 'class', which is a word of C++; give it another name"));
  EXPECT_THAT(Refusal("component c { function f(in long new) { codel g(in new::other); }; };\n"),
              HasSubstr("c.gen:1:34: a parameter or variable of 'f' cannot be called 'new'"));
  EXPECT_THAT(Refusal("component c { ids { long x; }; function f() { codel g(in x::this); }; };\n"),
              HasSubstr("a parameter of codel 'g' cannot be called 'this'"));
  EXPECT_THAT(Refusal("struct template { long x; }; component c { port in template p; };\n"),
              HasSubstr("c.gen:1:8: a struct cannot be called 'template'"));
  EXPECT_EQ(Refusal("module m { struct template { long x; }; }; component c { port in m::template p; };\n"), "")
      << "m_template";
}

TEST(ModuleTemplateTest, WordsOfCxxAreNoNamesOfWhatCodelsInCxxSeeOfAComponent) {
  const auto refusal_of = [](const std::string& before, const std::string& name, const std::string& items) {
    return Refusal("typedef double real;\n" + before + "\ncomponent " + name + " {\n" + items + " };\n");
  };
  EXPECT_THAT(refusal_of("", "c", "lang \"c++\"; port in real class;"),
              HasSubstr("c.gen:4:26: a port cannot be called 'class', which is a word of C++; give it another name"));
  EXPECT_THAT(refusal_of("interface far { function delete(in long a); };", "c", "lang \"c++\"; uses far;"),
              HasSubstr("a remote cannot be called 'delete'"));
  EXPECT_THAT(refusal_of("interface new { port in real p; };", "c", "lang \"c++\"; provides new;"),
              HasSubstr("an interface cannot be called 'new'"));
  EXPECT_THAT(refusal_of("", "this", "lang \"c++\"; port in real p;"),
              HasSubstr("c.gen:3:11: a component cannot be called 'this'"));
  EXPECT_EQ(refusal_of("interface new { port in real p; }; interface far { function delete(in long a); };", "this",
                       "lang \"c\"; provides new; uses far; port in real class;"),
            "")
      << "this_class, new_p, this_delete";
  const auto mappings = ModuleOf("typedef double real; component c { lang \"c++\"; port in real class; };", "mappings");
  ASSERT_FALSE(mappings) << "its headers alone, too";
  EXPECT_THAT(mappings.error().ToString(), HasSubstr("a port cannot be called 'class'"));
}

TEST(ModuleTemplateTest, PartsOfWhatMayNotBeThereAreNoParameters) {
  const auto refusal_of = [](const std::string& rest) {
    return Refusal(
        "struct p { double x, y; }; struct q { sequence<p> all; sequence<long, 4> few; };\n"
        "union note switch (boolean) { case TRUE: string text; case FALSE: double number; };\n"
        "component c { ids { q held; optional<p> last; note said; p pair[2]; };\n" +
        rest + " };\n");
  };
  EXPECT_THAT(refusal_of("attribute get(out held.all[7].x);"),
              HasSubstr("c.gen:4:19: 'x' is a part of 'held.all', which may have no such element; take 'held.all' as a "
                        "whole, and let the codel look"));
  EXPECT_THAT(refusal_of("attribute set(in held.few[2]);"), HasSubstr("'held.few', which may have no such element"));
  EXPECT_THAT(refusal_of("function f() { codel g(in last.x); };"), HasSubstr("'last', which may be absent"));
  EXPECT_THAT(refusal_of("attribute get(out said.text);"), HasSubstr("'said', which may have another member"));
  EXPECT_THAT(refusal_of("function f(in optional<p> to) { codel g(local in to.x); };"),
              HasSubstr("'to', which may be absent"));
  EXPECT_EQ(refusal_of("attribute set(in pair[1].x, in held.all, in last);"), "");
}

}  // namespace
}  // namespace runnel::genom
