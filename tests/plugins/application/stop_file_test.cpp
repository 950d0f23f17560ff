// STOP outlives the process that had it.

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "plugins/application/application.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
namespace fs = std::filesystem;

class StopFileTest : public testing::Test {
 protected:
  StopFileTest() {
    if (const char* const before = std::getenv("XDG_RUNTIME_DIR")) before_ = before;
    setenv("XDG_RUNTIME_DIR", run_time.path().c_str(), 1);
  }
  ~StopFileTest() override {
    before_ ? setenv("XDG_RUNTIME_DIR", before_->c_str(), 1) : unsetenv("XDG_RUNTIME_DIR");
  }
  // Of the application in a file of this folder; each is as a process of its own.
  LoadedApplication Run(const std::string& folder = "a", bool clears = false, bool keeps = true) {
    const fs::path file = files.path() / folder / "robot.xml";
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "<application name=\"robot\"/>";
    return Application::Load(file, {.keeps_stop = keeps, .clears_stop = clears});
  }
  static bool IsStopped(const LoadedApplication& application) {
    return application->runtime().robot_stop().in_force();
  }
  [[nodiscard]] fs::path Folder() const { return run_time.path() / "runnel"; }

  TemporaryFolder run_time;
  TemporaryFolder files;

 private:
  std::optional<std::string> before_;
};

TEST_F(StopFileTest, TheNextProcessBeginsUnderStopAndSaysSoUntilItIsReleased) {
  Run()->runtime().robot_stop().Press("a viewer");
  {
    const auto next = Run();
    ASSERT_TRUE(next) << next.diagnostics().ToString();
    EXPECT_TRUE(IsStopped(next));
    EXPECT_THAT(next.diagnostics().ToString(), HasSubstr("begins under STOP, pressed by a viewer, in a process before"));
  }
  EXPECT_TRUE(IsStopped(Run())) << "still";
  const auto other = Run("b");
  EXPECT_FALSE(IsStopped(other)) << "an application of the same name";
  EXPECT_TRUE(Run()->runtime().robot_stop().Release("a person"));
  const auto last = Run();
  EXPECT_FALSE(IsStopped(last));
  EXPECT_THAT(last.diagnostics().ToString(), IsEmpty());
}

TEST_F(StopFileTest, ClearedItBeginsWithoutAndWritesItAgain) {
  Run()->runtime().robot_stop().Press("a viewer");
  {
    const auto cleared = Run("a", true);
    EXPECT_FALSE(IsStopped(cleared));
    EXPECT_FALSE(IsStopped(Run()));
    cleared->runtime().robot_stop().Press("a viewer");
  }
  EXPECT_TRUE(IsStopped(Run()));
}

TEST_F(StopFileTest, WhoDoesNotKeepItNeitherLooksNorWrites) {
  Run("a", false, false)->runtime().robot_stop().Press("a viewer");
  EXPECT_FALSE(fs::exists(Folder()));
}

// A file there might have been removed by anybody.
TEST_F(StopFileTest, AFolderThatIsOpenToOthersIsAnError) {
  fs::create_directory(Folder());
  fs::permissions(Folder(), fs::perms::all);
  const auto refused = Run();
  EXPECT_FALSE(refused);
  EXPECT_THAT(refused.diagnostics().ToString(), HasSubstr("whether a STOP is in force cannot be known"));
  const auto cleared = Run("a", true);
  EXPECT_TRUE(cleared);
  EXPECT_THAT(cleared.diagnostics().ToString(), HasSubstr("cannot be known"));
}

TEST_F(StopFileTest, WhereThereCanBeNoFolderItSaysThatStopEndsWithTheProcess) {
  setenv("XDG_RUNTIME_DIR", "/no/such/folder", 1);
  const auto application = Run();
  ASSERT_TRUE(application);
  EXPECT_THAT(application.diagnostics().ToString(), HasSubstr("a STOP will end with this process"));
}

TEST_F(StopFileTest, ASavedFileNeverHasIt) {
  const auto application = Run();
  application->runtime().robot_stop().Press("a viewer");
  ASSERT_TRUE(application->Save((files.path() / "saved.xml").string()));
  std::ifstream saved(files.path() / "saved.xml");
  const std::string text{std::istreambuf_iterator<char>(saved), {}};
  EXPECT_THAT(text, testing::Not(HasSubstr("stop")));
}

}  // namespace
}  // namespace runnel::test
