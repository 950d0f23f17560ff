// What mistakes are told: where, what, and the cure.

#include <algorithm>

#include <gmock/gmock.h>

#include "plugins/genom_description/description.h"
#include "tests/plugins/genom_description/verdict.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(GenomDiagnosticsTest, ThePlaceTheMistakeAndTheCure) {
  EXPECT_EQ(Wrongs("struct pose { double x; };\ntypedef pos where;\n"),
            "test.gen:2:9: error: unknown type 'pos'; did you mean 'pose'?\n");
  EXPECT_THAT(WrongsInComponent("ids { double speed; };\nattribute set(in sped);"),
              HasSubstr("test.gen:3:18: error: there is no 'sped' among what is ids; it must be declared before; "
                        "did you mean 'speed'?"));
  EXPECT_THAT(WrongsInComponent("task t { perod 5 ms; };"), HasSubstr("did you mean 'period'?"));
}

TEST(GenomDiagnosticsTest, SeveralMistakesAreToldAtOnce) {
  EXPECT_THAT(
      Wrongs("typedef one a;\ncomponent c {\n  port in two p;\n  task t { priod 3; };\n  task u { period -1; };\n};\n"),
      AllOf(HasSubstr("test.gen:1:9"), HasSubstr("test.gen:3:11"), HasSubstr("test.gen:4:12"),
            HasSubstr("test.gen:5:19")));
}

TEST(GenomDiagnosticsTest, AMistakeIsNotToldAgainByItsUsers) {
  EXPECT_EQ(Wrongs("typedef unknown a;\ntypedef a b;\nstruct s { a c; };\ncomponent c { port in a p; ids { a d; };\n"
                   "  attribute e(in d = { 3 });\n  task t { codel<start> k(in d.x, in p) yield ether; }; };\n"),
            "test.gen:1:9: error: unknown type 'unknown'; a type is declared before it is used\n");
}

TEST(GenomDiagnosticsTest, AMissingSemicolonIsToldWhereItBelongs) {
  EXPECT_EQ(Wrongs("typedef long a\ntypedef a b;\n"), "test.gen:1:15: error: ';' is missing before 'typedef'\n");
}

TEST(GenomDiagnosticsTest, PlacesAreThoseOfTheTextAsWritten) {
  EXPECT_THAT(Wrongs("/* over\nlines */ typedef \\\n  unknown a;\n"), HasSubstr("test.gen:3:3"));
  EXPECT_THAT(Wrongs("#define T unknown\n\ntypedef T a;\n"), HasSubstr("test.gen:3:9"));
  EXPECT_THAT(Wrongs("#line 40 \"other.idl\"\ntypedef unknown a;\n"), HasSubstr("other.idl:40:9"));
}

// What led to it, or from it, is not wrong.
TEST(GenomDiagnosticsTest, ACodelThatIsLeftOutIsNotMissedByOthers) {
  const std::string wrongs = WrongsInComponent(
      "ids { double x; };\ntask t {\n codel<start> a() yield go;\n codel<go> b(in y) yield more;\n"
      " codel<more> c() yield ether;\n};\nactivity f() { task t; codel<start> d(in z) yield ether; };");
  EXPECT_THAT(wrongs, AllOf(HasSubstr("there is no 'y'"), HasSubstr("there is no 'z'")));
  EXPECT_EQ(std::ranges::count(wrongs, '\n'), 2) << wrongs;
}

TEST(GenomDiagnosticsTest, AMissingIncludeIsToldAndNothingBehindIt) {
  const std::string wrongs = Wrongs("#ifndef A\n#define A\ncomponent c {\n#include \"missing.gen\"\n};\n#endif\n");
  EXPECT_THAT(wrongs, HasSubstr("test.gen:4:1: error: there is no file 'missing.gen' to include"));
  EXPECT_EQ(std::ranges::count(wrongs, '\n'), 1) << wrongs;
}

TEST(GenomDiagnosticsTest, ServicesThatCanNeverStartAreWarnedOf) {
  const auto warnings = [](const std::string& items) {
    Diagnostics diagnostics;
    (void)genom::ReadDescriptionText("component c {\n" + items + "\n};", "test.gen", {}, diagnostics);
    EXPECT_TRUE(diagnostics.ok()) << "it is no error: " << diagnostics.ToString();
    return diagnostics.ToString();
  };
  EXPECT_THAT(warnings("function one() { after two; };\nfunction two() { after one; };\nfunction three();"),
              AllOf(HasSubstr("test.gen:2:10: warning: function 'one' can never start"),
                    HasSubstr("test.gen:3:10: warning: function 'two' can never start"), Not(HasSubstr("three"))));
  EXPECT_THAT(warnings("function g() { after g; };"), HasSubstr("function 'g' can never start"));
  EXPECT_THAT(warnings("function a();\nfunction b() { after a; before a; };"),
              HasSubstr("function 'b' can never start"));
  EXPECT_EQ(warnings("function a();\nfunction b() { after a; before c; };\nfunction c() { after all; };\n"
                     "function d() { before all; };"),
            "");
}

TEST(GenomDiagnosticsTest, ConstantsOutOfTheRangeOfTheirTypeAreWarnedOf) {
  for (const char* wrong : {"const long long a = 18446744073709551615;", "const long long a = 9223372036854775808;",
                            "const long a = -2147483649;", "const float a = 1e300;"}) {
    Diagnostics diagnostics;
    (void)genom::ReadDescriptionText(wrong, "test.gen", {}, diagnostics);
    EXPECT_TRUE(diagnostics.ok()) << "it is no error: " << diagnostics.ToString();
    EXPECT_THAT(diagnostics.ToString(), HasSubstr("is out of the range of")) << wrong;
  }
}

TEST(GenomDiagnosticsTest, CodelsWithNamesOfTheHeadersAreWarnedOf) {
  const auto warnings = [](const std::string& items) {
    Diagnostics diagnostics;
    (void)genom::ReadDescriptionText("component lamp {\n" + items + "\n};", "test.gen", {}, diagnostics);
    EXPECT_TRUE(diagnostics.ok()) << "it is no error: " << diagnostics.ToString();
    return diagnostics.ToString();
  };
  const std::string task = "task t { codel<start> begin() yield on; codel<on> lamp_on() yield pause::on; };";
  EXPECT_THAT(
      warnings(task),
      HasSubstr("test.gen:2:51: warning: codel 'lamp_on' has the name that event lamp::on has in the headers in C; "
                "codels do not compile with both"));
  EXPECT_THAT(warnings("task t { codel<start> lamp_pause_start() yield pause::start; };"),
              HasSubstr("lamp_pause_start"));
  EXPECT_THAT(warnings("exception dark; task t { codel<start> lamp_dark() yield ether; };"),
              HasSubstr("exception lamp::dark"));
  EXPECT_THAT(warnings("task t { codel<start> lamp_ether() yield ether; };"), HasSubstr("lamp_ether"));
  EXPECT_EQ(warnings("lang \"c++\"; " + task), "") << "where they have namespaces";
  EXPECT_EQ(warnings("function f() { codel lamp_start(); };"), "") << "no codel runs in start";
}

}  // namespace
}  // namespace runnel::test
