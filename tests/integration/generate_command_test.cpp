// What `runnel check` and `runnel generate` do with descriptions of components.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GenerateCommand : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  TemporaryFolder folder_;
};

TEST_F(GenerateCommand, ChecksDescriptions) {
  const std::string right = Write("right.gen", "#include \"types.idl\"\ncomponent right { port in speed wanted; };\n");
  Write("types.idl", "typedef double speed;\n");
  const Ended good = Runnel("check " + right);
  EXPECT_EQ(good.code, 0) << good.text;
  EXPECT_THAT(good.text, HasSubstr("right.gen: no errors"));

  const std::string wrong =
      Write("wrong.gen", "component wrong {\n  port in sped wanted;\n  task t { period -1; };\n};\n");
  const Ended bad = Runnel("check " + wrong);
  EXPECT_EQ(bad.code, kBadInput);
  EXPECT_THAT(bad.text, AllOf(HasSubstr("wrong.gen:2:11: error: unknown type 'sped'"), HasSubstr("wrong.gen:3:19"),
                              HasSubstr("2 errors")));
}

TEST_F(GenerateCommand, HasAModelCheckerLookAtComponents) {
  if (std::system("spin -V > /dev/null 2>&1") != 0) GTEST_SKIP() << "the package spin is not here";
  const std::string file =
      Write("c.gen",
            "component c { task t;\n  activity a() { task t; codel<start> k() yield pause::start;\n"
            "    codel<stop> s() yield pause::stop; };\n};\n");
  EXPECT_EQ(Runnel("check " + file).code, kBadInput) << "a stop that cannot end is refused without it";
  const std::string sleeps =
      Write("d.gen",
            "component d { task t;\n  activity a() { task t; codel<start> k() yield pause::start;\n"
            "    codel<stop> s() yield pause::end_; codel<end_> e() yield ether; };\n};\n");
  EXPECT_EQ(Runnel("check " + sleeps).code, kDone);
  const Ended found = Runnel("check --spin " + sleeps);
  EXPECT_EQ(found.code, kBadInput);
  EXPECT_THAT(found.text, AllOf(HasSubstr("d.gen:1:11: error: component d can come to a standstill"),
                                HasSubstr("    activity a: s yields pause::end_\n    and nothing more")));
}

TEST_F(GenerateCommand, WritesAllThatADescriptionSays) {
  const std::string file = Write("c.gen", "#ifdef FAST\ncomponent c { task t { period 5 ms; }; };\n#endif\n");
  const Ended json = Runnel("generate json -D FAST " + file);
  EXPECT_EQ(json.code, 0) << json.text;
  EXPECT_THAT(json.text, AllOf(HasSubstr("\"components\""), HasSubstr("\"clock_rate\": 0.005")));
}

TEST_F(GenerateCommand, AMissingPackageIsTold) {
  const std::string file = Write("c.gen", "#pragma requires \"no-such-package-anywhere\"\ncomponent c;\n");
  const Ended ended = Runnel("check " + file);
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("c.gen:1:1: error: pkg-config knows no package 'no-such-package-anywhere'"));
}

TEST_F(GenerateCommand, ADescriptionWithoutAComponentIsTold) {
  const Ended ended =
      Runnel("generate mappings -o " + (folder_ / "made").string() + " " + Write("t.gen", "typedef double speed;\n"));
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text,
              HasSubstr("t.gen: error: template 'mappings' makes nothing of this; does it describe a component?"));
}

TEST_F(GenerateCommand, EntersAComponentThatWasNotMadeHere) {
  const std::string file = Write("c.gen", "component c { task t { codel<start> k() yield ether; }; };\n");
  std::filesystem::create_directory(folder_ / "codels");
  const std::string own = Write("codels/c_t_codels.c", "// somebody's\n");
  const std::string command = " -o " + folder_.path().string() + " " + file;
  EXPECT_EQ(Runnel("generate skeleton" + command).code, kBadInput);
  const Ended adopted = Runnel("generate skeleton --adopt" + command);
  EXPECT_EQ(adopted.code, kDone) << adopted.text;
  EXPECT_THAT(adopted.text, AllOf(HasSubstr("codels/c_t_codels.c: as it was"), HasSubstr("README.md: new")));
  EXPECT_EQ(Runnel("generate skeleton" + command).code, kDone) << "it is known by now";
  EXPECT_EQ(std::filesystem::file_size(own), 14U);
}

TEST_F(GenerateCommand, MakesWhatTemplatesSay) {
  const std::string file = Write("c.gen", "component c { task t { codel<start> k() yield ether; }; };\n");
  const std::string into = " -o " + (folder_ / "made").string() + " ";
  const Ended made = Runnel("generate skeleton" + into + "--depfile " + (folder_ / "deps").string() + " " + file);
  EXPECT_EQ(made.code, 0) << made.text;
  EXPECT_THAT(made.text, HasSubstr("codels/c_t_codels.c: new"));
  EXPECT_THAT(Runnel("generate skeleton" + into + file).text, HasSubstr("codels/c_t_codels.c: as it was"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "deps"));
  EXPECT_EQ(Runnel("generate docs" + into + file).code, 0);
  const Ended unknown = Runnel("generate skeletn" + into + file);
  EXPECT_EQ(unknown.code, kBadInput);
  EXPECT_THAT(unknown.text, HasSubstr("there is no template 'skeletn'; did you mean 'skeleton'?"));
}

}  // namespace
}  // namespace runnel::test
