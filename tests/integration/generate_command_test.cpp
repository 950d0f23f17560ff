// What `runnel check` and `runnel generate` do with descriptions of components.

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

  const std::string wrong = Write("wrong.gen", "component wrong {\n  port in sped wanted;\n  task t { period -1; };\n};\n");
  const Ended bad = Runnel("check " + wrong);
  EXPECT_EQ(bad.code, kBadInput);
  EXPECT_THAT(bad.text, AllOf(HasSubstr("wrong.gen:2:11: error: unknown type 'sped'"), HasSubstr("wrong.gen:3:19"),
                              HasSubstr("2 errors")));
}

TEST_F(GenerateCommand, WritesAllThatADescriptionSays) {
  const std::string file = Write("c.gen", "#ifdef FAST\ncomponent c { task t { period 5 ms; }; };\n#endif\n");
  const Ended json = Runnel("generate json -D FAST " + file);
  EXPECT_EQ(json.code, 0) << json.text;
  EXPECT_THAT(json.text, AllOf(HasSubstr("\"components\""), HasSubstr("\"clock_rate\": 0.005")));
  EXPECT_EQ(Runnel("generate nothing " + file).code, kBadInput);
}

TEST_F(GenerateCommand, AMissingPackageIsTold) {
  const std::string file = Write("c.gen", "#pragma requires \"no-such-package-anywhere\"\ncomponent c;\n");
  const Ended ended = Runnel("check " + file);
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("c.gen:1:1: error: pkg-config knows no package 'no-such-package-anywhere'"));
}

}  // namespace
}  // namespace runnel::test
