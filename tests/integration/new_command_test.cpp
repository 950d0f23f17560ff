// What `runnel new` says of names and of what is there already. What it writes is built by installed_package.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;

class NewCommand : public testing::Test {
 protected:
  Ended New(const std::string& words) { return Runnel("new " + words + " --in " + folder_.path().string()); }
  static std::string TextOf(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  TemporaryFolder folder_;
};

TEST_F(NewCommand, NamesThatCannotBeAreRefusedWithOneThatCould) {
  const struct {
    std::string name, said;
  } cases[] = {{"WallFollower", "how about 'wall_follower'?"},
               {"wall-follower", "how about 'wall_follower'?"},
               {"2wheels", "how about 'wheels'?"},
               {"wall__follower", "how about 'wall_follower'?"},
               {"../outside", "how about 'outside'?"},
               {"''", "nothing can be called ''"},
               {"class", "a word of C++"},
               {"plugin", "the name of something else"},
               {"motion", "there is a plugin 'motion' already"}};
  for (const auto& each : cases) {
    const Ended ended = New("plugin " + each.name);
    EXPECT_EQ(ended.code, kBadInput) << each.name;
    EXPECT_THAT(ended.text, HasSubstr(each.said));
  }
  EXPECT_TRUE(fs::is_empty(folder_.path())) << "nothing is written";
}

TEST_F(NewCommand, NothingIsOverwritten) {
  fs::create_directory(folder_ / "follower");
  std::ofstream(folder_ / "follower/follower.xml") << "mine";
  const Ended ended = New("plugin follower");
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("follower.xml: error: this is there already"));
  EXPECT_EQ(TextOf(folder_ / "follower/follower.xml"), "mine");
  EXPECT_FALSE(fs::exists(folder_ / "follower/CMakeLists.txt")) << "all or nothing";
}

TEST_F(NewCommand, ModulesAreAddedToThePluginOfTheFolder) {
  EXPECT_EQ(New("module leader").code, kBadInput);
  EXPECT_THAT(New("module leader").text, HasSubstr("there is no plugin in this folder"));
  std::ofstream(folder_ / "plugin.cpp") << "#include <runnel/plugin.h>\n"
                                           "RUNNEL_PLUGIN(my_robot, types) {}\n";
  EXPECT_THAT(New("module leader").text, HasSubstr("my_robot/leader"));
  EXPECT_EQ(TextOf(folder_ / "plugin.cpp"),
            "#include <runnel/plugin.h>\n"
            "#include \"leader.h\"\n"
            "RUNNEL_PLUGIN(my_robot, types) {\n"
            "  types.Add<Leader>(\"my_robot/leader\", \"follows its input, no faster than it may\");}\n");
  EXPECT_THAT(TextOf(folder_ / "leader.h"), HasSubstr("class Leader final"));
  EXPECT_THAT(TextOf(folder_ / "leader_test.cpp"), HasSubstr("ModuleRig rig(\"my_robot/leader\""));
  EXPECT_EQ(New("module leader").code, kBadInput) << "it is there";
}

TEST_F(NewCommand, KindsThatAreNotThereAreToldWithTheNearest) {
  const Ended ended = Runnel("new modul leader");
  EXPECT_EQ(ended.code, kBadInput);
  EXPECT_THAT(ended.text, HasSubstr("did you mean 'module'?"));
}

}  // namespace
}  // namespace runnel::test
