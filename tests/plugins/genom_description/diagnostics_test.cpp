// What mistakes are told: where, what, and the cure.

#include <gmock/gmock.h>

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
  EXPECT_THAT(Wrongs("typedef one a;\ncomponent c {\n  port in two p;\n  task t { priod 3; };\n  task u { period -1; };\n};\n"),
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

}  // namespace
}  // namespace runnel::test
