// What Spin finds in the models of components, and in which words that is told.

#include "apps/generate/component_check.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plugins/genom_description/description.h"
#include "plugins/genom_templates/template_run.h"
#include "plugins/model_checker/spin.h"
#include "tests/support/temporary_folder.h"

namespace runnel {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

std::string ModelOf(const std::string& text) {
  Diagnostics diagnostics;
  const auto description = genom::ReadDescriptionText(text, "test.gen", {}, diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << diagnostics.ToString();
  return description ? genom::DescriptionJson(*description) : "{}";
}

// A task that drives and one that looks, with an activity each, and what is asked between them.
std::string Component(const std::string& drive, const std::string& look, const std::string& more = "") {
  return "component robot { ids { long speed; boolean seen; };\n"
         "task drive { period 20 ms; codel<start> init(out speed) yield ether; codel<stop> quiet(out speed) yield "
         "ether; };\n"
         "task look;\n"
         "activity go(in long s) { task drive; interrupts go;\n  " +
         drive +
         " };\n"
         "activity watch() { task look;\n  " +
         look + " };\n" + more + "};\n";
}

const std::string kGoes =
    "codel<start> begin(local in s, out speed) yield turn; codel<turn> turn(in speed) yield pause::turn, ether;\n"
    "  codel<stop> brake(inout speed) yield ether, pause::stop;";
const std::string kWatches = "codel<start> w_start(out seen) yield pause::start, ether;";
const std::string kClears = "function clear() { codel f_clear(out speed, in seen); interrupts watch; };\n";

std::string ErrorsOf(const std::string& text) {
  Diagnostics diagnostics;
  CheckBySpin(ModelOf(text), diagnostics);
  EXPECT_THAT(diagnostics.warnings(), IsEmpty()) << diagnostics.ToString();
  return diagnostics.ToString();
}

class ComponentCheckTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("spin -V > /dev/null 2>&1") != 0) GTEST_SKIP() << "the package spin is not here";
  }
};

TEST_F(ComponentCheckTest, FindsNothingWhereNothingIsWrong) {
  EXPECT_EQ(ErrorsOf(Component(kGoes, kWatches, kClears)), "");
}

// Once it holds, it never gets to ether again.
TEST_F(ComponentCheckTest, FindsAnActivityThatDoesNotEndWhenItIsInterrupted) {
  std::string stays = kGoes;
  stays.replace(stays.find("yield ether, pause::stop"), 24,
                "yield ether, hold; codel<hold> h_hold() yield pause::hold");
  const std::string errors = ErrorsOf(Component(stays, kWatches));
  EXPECT_THAT(errors, AllOf(HasSubstr("test.gen:4:10: error: activity go can "),
                            HasSubstr("\n    activity go: brake yields hold\n"), HasSubstr("\n  over and over:\n"),
                            HasSubstr("\n    activity go: h_hold yields pause::hold")));
}

// Its task wakes up when something else happens, and nothing does.
TEST_F(ComponentCheckTest, FindsAStandstill) {
  const std::string errors =
      ErrorsOf(Component(kGoes,
                         "codel<start> w_start(out seen) yield pause::start; codel<stop> w_stop() yield pause::done;\n"
                         "  codel<done> w_done() yield ether;"));
  EXPECT_THAT(errors, AllOf(HasSubstr("test.gen:1:11: error: component robot can come to a standstill:\n"),
                            HasSubstr("\n    the component is told to end\n"),
                            HasSubstr("\n    activity watch: w_stop yields pause::done\n    and nothing more")));
}

// Without mutual exclusion: what it is there for is seen.
TEST_F(ComponentCheckTest, CodelsThatConflictAreKeptApartByExclusion) {
  const auto made = genom::RunTemplate(RUNNEL_GENOM_TEMPLATE_FOLDER "/promela",
                                       ModelOf(Component(kGoes, kWatches, kClears)), {{"exclusion", "none"}});
  ASSERT_TRUE(made) << made.error().ToString();
  const auto answer = RunSpin(made->files.at(0).text, {.options = {"-bfs"}});
  ASSERT_TRUE(answer) << answer.error().ToString();
  ASSERT_FALSE(answer->holds);
  EXPECT_THAT(answer->run.back(),
              AllOf(HasSubstr("fault test.gen\t"), HasSubstr(" can run at once, and both use ids.")));
}

// Whether a process called `pan`, or whatever its name is, works somewhere below the folder.
bool HasProcess(const std::filesystem::path& folder, const std::string& name) {
  std::error_code error;
  for (const auto& process : std::filesystem::directory_iterator("/proc", error)) {
    const auto works_in = std::filesystem::read_symlink(process.path() / "cwd", error).string();
    const auto program = std::filesystem::read_symlink(process.path() / "exe", error).string();
    if (works_in.starts_with(folder.string()) && program.find(name) != std::string::npos) return true;
  }
  return false;
}

// Of a search that would take minutes, by whichever signal its process is ended. Ctrl-C interrupts its whole group.
TEST_F(ComponentCheckTest, NothingOfASearchIsLeftWhenItsProcessIsEnded) {
  for (const int signal : {SIGTERM, SIGKILL, SIGINT}) {
    const test::TemporaryFolder folder;
    const pid_t process = fork();
    if (process == 0) {
      setpgid(0, 0);
      (void)std::signal(SIGINT, SIG_DFL);
      setenv("TMPDIR", folder.path().c_str(), 1);
      (void)RunSpin("active [4] proctype p() { int a, b; do :: a++ :: b++ od }", {.options = {"-m1000000"}});
      _exit(0);
    }
    while (!HasProcess(folder.path(), "/pan")) std::this_thread::yield();
    kill(signal == SIGINT ? -process : process, signal);
    waitpid(process, nullptr, 0);
    while (HasProcess(folder.path(), "")) std::this_thread::yield();
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

TEST_F(ComponentCheckTest, SaysWhatItCouldNotLookAt) {
  const auto wrong = RunSpin("this is no model", {});
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().message, HasSubstr("is not checked, for the model checker says: "));
  const auto deep = RunSpin("active proctype p() { byte a, b; do :: a++ :: b++ od }", {.options = {"-m10"}});
  ASSERT_FALSE(deep);
  EXPECT_THAT(deep.error().message, HasSubstr("is not decided"));
}

}  // namespace
}  // namespace runnel
