// STOP outlives the process that had it.

#include "plugins/application/internal/stop_file.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "plugins/application/application.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

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
  ~StopFileTest() override { before_ ? setenv("XDG_RUNTIME_DIR", before_->c_str(), 1) : unsetenv("XDG_RUNTIME_DIR"); }
  // Of the application in a file of this folder; each is as a process of its own.
  LoadedApplication Run(const std::string& folder = "a", bool clears = false, bool keeps = true) {
    const fs::path file = files.path() / folder / "robot.xml";
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "<application name=\"robot\"/>";
    return Application::Load(file, {.keeps_stop = keeps, .clears_stop = clears});
  }
  static bool IsStopped(const LoadedApplication& application) { return application->runtime().robot_stop().in_force(); }
  [[nodiscard]] fs::path Folder() const { return run_time.path() / "runnel"; }
  [[nodiscard]] std::size_t Files() const {
    std::error_code none;
    std::size_t count = 0;
    for (const auto& each : fs::directory_iterator(Folder(), none)) {
      const std::string name = each.path().filename().string();
      count += name.ends_with(".stop") && !name.starts_with(".");
    }
    return count;
  }

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
    EXPECT_THAT(next.diagnostics().ToString(),
                HasSubstr("begins under STOP, pressed by a viewer, in a process before"));
  }
  EXPECT_TRUE(IsStopped(Run())) << "still";
  EXPECT_EQ(Run()->runtime().robot_stop().state().by, "a viewer, in a process before this one");
  const auto other = Run("b");
  EXPECT_FALSE(IsStopped(other)) << "an application of the same name";
  EXPECT_TRUE(Run()->runtime().robot_stop().Release("a person"));
  const auto last = Run();
  EXPECT_FALSE(IsStopped(last));
  EXPECT_THAT(last.diagnostics().ToString(), IsEmpty());
}

TEST_F(StopFileTest, AnApplicationIsTheSameByWhateverLinkItIsReached) {
  Run()->runtime().robot_stop().Press("a viewer");
  fs::create_directory_symlink(files.path() / "a", files.path() / "current");
  EXPECT_TRUE(IsStopped(Run("current")));
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

// Each has its own file: the STOP of the one is neither lost nor cleared by what becomes of the other.
TEST_F(StopFileTest, TwoProcessesOfOneApplicationKeepTheirOwn) {
  auto first = std::make_unique<LoadedApplication>(Run());
  (*first)->runtime().robot_stop().Press("a viewer");
  WaitUntil("it is written", [&] { return Files() == 1; });
  {
    const auto second = Run();
    EXPECT_TRUE(IsStopped(second));
    EXPECT_THAT(second.diagnostics().ToString(), HasSubstr("pressed by a viewer, in another process that runs"));
    EXPECT_TRUE(second->runtime().robot_stop().Release("a person"));
  }
  EXPECT_EQ(Files(), 1u) << "of the first one";
  EXPECT_FALSE(IsStopped(Run("a", true))) << "cleared for this process";
  EXPECT_EQ(Files(), 1u);
  first.reset();
  EXPECT_TRUE(IsStopped(Run())) << "the first one has ended under it";
  EXPECT_TRUE(Run()->runtime().robot_stop().Release("a person"));
  EXPECT_EQ(Files(), 0u);
}

// As a process that was killed leaves it.
TEST_F(StopFileTest, WhatSeveralHaveLeftIsTakenOverAndReleasedByOne) {
  Run()->runtime().robot_stop().Press("a viewer");
  const fs::path left = *fs::directory_iterator(Folder());
  for (const char* number : {"1", "2"}) fs::copy_file(left, left.string() + number);
  const auto next = Run();
  EXPECT_TRUE(IsStopped(next));
  WaitUntil("the others' are gone", [&] { return Files() == 1; });
  EXPECT_TRUE(next->runtime().robot_stop().Release("a person"));
  WaitUntil("nothing is left", [&] { return Files() == 0; });
}

// Who has begun without it, and was never under it, does not end it.
TEST_F(StopFileTest, WhatAnotherLeavesMeanwhileStaysWhenThisOneIsReleased) {
  auto second = std::make_unique<LoadedApplication>(Run());
  {
    const auto first = Run();
    first->runtime().robot_stop().Press("a viewer");
    WaitUntil("it is written", [&] { return Files() == 1; });
  }
  (*second)->runtime().robot_stop().Press("a person");
  WaitUntil("it is written, too", [&] { return Files() == 2; });
  (void)(*second)->runtime().robot_stop().Release("a person");
  second.reset();
  const auto first = Run();
  EXPECT_TRUE(IsStopped(first));
  EXPECT_THAT(first.diagnostics().ToString(), HasSubstr("pressed by a viewer, in a process before"));
}

// A pipe that nobody reads is as a disk that does not answer.
TEST_F(StopFileTest, ADiskThatHangsDelaysNeitherTheStopNorItsAnswer) {
  Runtime runtime;
  ApplicationLog log(runtime.clock());
  RobotStop& stop = runtime.robot_stop();
  fs::create_directory(Folder());
  fs::permissions(Folder(), fs::perms::owner_all);
  StopFile file(stop, log, Folder(), "hangs-");
  stop.Press("a viewer");
  WaitUntil("it is written", [&] { return Files() == 1; });
  const fs::path name = Folder() / ("." + fs::directory_iterator(Folder())->path().filename().string());
  (void)stop.Release("a viewer");
  WaitUntil("it is gone", [&] { return Files() == 0; });
  ASSERT_EQ(mkfifo(name.c_str(), 0600), 0);
  EXPECT_TRUE(stop.Press("a viewer"));  // in this thread
  EXPECT_TRUE(stop.in_force());
  EXPECT_FALSE(file.IsKept());
  const int reader = open(name.c_str(), O_RDONLY);
  WaitUntil("it is written", [&] { return file.IsKept(); });
  close(reader);
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

// Nobody is there who could be heard.
TEST_F(StopFileTest, WhereOperatorsMustBeHeardItIsPressedFromTheStartOn) {
  const auto application =
      Application::LoadText("<application name=\"robot\"><operators timeout=\"200ms\"/></application>", {});
  ASSERT_TRUE(application) << application.diagnostics().ToString();
  WaitUntil("it is pressed", [&] { return IsStopped(application); });
  WaitUntil("it is noted by whom", [&] {
    return application->runtime().robot_stop().state().by ==
           "<operators>: none of them has been heard for 200ms, nor before";
  });
}

TEST_F(StopFileTest, ASaveAndTheEndOfARunTellOfItOnlyWhereItIsLost) {
  const auto quit = [](const LoadedApplication& application) {
    return application->service().application().hooks.quit().value();
  };
  const auto kept = Run();
  kept->runtime().robot_stop().Press("a viewer");
  ASSERT_TRUE(kept->Save({}));
  for (const ApplicationEvent& each : kept->TakeEvents())
    EXPECT_THAT(each.text, testing::Not(HasSubstr("the STOP of the robot")));
  std::ofstream(files.path() / "a" / "robot.xml") << "<application name=\"robot\"></application>";
  EXPECT_THAT(quit(kept), testing::Not(HasSubstr("not saved")))
      << "the next process has what somebody has written there";
  setenv("XDG_RUNTIME_DIR", "/no/such/folder", 1);
  const auto lost = Run("b");
  lost->runtime().robot_stop().Press("a viewer");
  EXPECT_THAT(quit(lost), HasSubstr("the STOP of the robot"));
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
