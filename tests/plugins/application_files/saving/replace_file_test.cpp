// The old file or the new one, whole, whatever happens.

#include <atomic>
#include <chrono>
#include <csignal>
#include <new>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/files.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"
#include "tests/support/wait_until.h"

namespace runnel::testing {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> Names(const TestFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

TEST(ReplaceFile, MakesANewFileOrReplacesTheOld) {
  const TestFolder folder;
  ASSERT_TRUE(ReplaceFile(folder / "a.xml", "one"));
  EXPECT_EQ(ReadAll(folder / "a.xml"), "one");
  ASSERT_TRUE(ReplaceFile(folder / "a.xml", "two"));
  EXPECT_EQ(ReadAll(folder / "a.xml"), "two");
  EXPECT_THAT(Names(folder), ::testing::ElementsAre("a.xml"));
}

TEST(ReplaceFile, KeepsThePermissionBits) {
  const TestFolder folder;
  WriteAll(folder / "a.xml", "one");
  ASSERT_EQ(chmod((folder / "a.xml").c_str(), 0640), 0);
  ASSERT_TRUE(ReplaceFile(folder / "a.xml", "two"));
  struct stat status {};
  ASSERT_EQ(stat((folder / "a.xml").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0640U);
}

TEST(ReplaceFile, ReplacesWhatALinkLeadsTo) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "real");
  WriteAll(folder / "real/a.xml", "one");
  std::filesystem::create_symlink("real/a.xml", folder / "link.xml");
  ASSERT_TRUE(ReplaceFile(folder / "link.xml", "two"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.xml"));
  EXPECT_EQ(ReadAll(folder / "real/a.xml"), "two");
}

TEST(ReplaceFile, SaysWhyItCannot) {
  const TestFolder folder;
  const auto nowhere = ReplaceFile(folder / "none/a.xml", "one");
  ASSERT_FALSE(nowhere);
  EXPECT_THAT(nowhere.error().message, HasSubstr("there is no folder"));
  const auto on_folder = ReplaceFile(folder.path(), "one");
  ASSERT_FALSE(on_folder);
  EXPECT_THAT(on_folder.error().message, HasSubstr("is not a file"));
}

// In a child, since the limit is for the whole process.
TEST(ReplaceFile, LeavesTheOldFileIfTheDiskIsFull) {
  const TestFolder folder;
  WriteAll(folder / "a.xml", "one");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const auto replaced = ReplaceFile(folder / "a.xml", std::string(5000, 'x'));
    _exit(!replaced && replaced.error().message.find("cannot be written") == 0 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(ReadAll(folder / "a.xml"), "one");
  EXPECT_THAT(Names(folder), ::testing::ElementsAre("a.xml"));
}

TEST(ReplaceFile, KilledAtAnyMomentLeavesOneFileWhole) {
  const TestFolder folder;
  const std::filesystem::path file = folder / "a.xml";
  const std::string one(200'000, '1');
  const std::string two(300'000, '2');
  WriteAll(file, one);
  std::mt19937 random(1);
  std::uniform_int_distribution<int> whole(1, 4);
  std::uniform_int_distribution<int> more(0, 2000);  // us
  // How often the child has replaced the file: it is killed a moment later, however slow the machine is.
  void* const shared =
      mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  std::atomic<int>& replaced = *new (shared) std::atomic<int>;
  int ones = 0;
  constexpr int kKills = 150;
  for (int i = 0; i < kKills; ++i) {
    replaced = 0;
    const pid_t child = fork();
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (;; ++replaced) {
        if (!ReplaceFile(file, replaced % 2 == 0 ? two : one)) _exit(1);
      }
    }
    const int wanted = whole(random);
    test::WaitUntil("the child has replaced the file", [&] { return replaced >= wanted; });
    std::this_thread::sleep_for(std::chrono::microseconds(more(random)));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child could not write";
    const std::string text = ReadAll(file);
    ASSERT_TRUE(text == one || text == two) << text.size() << " bytes after kill " << i;
    ones += text == one ? 1 : 0;
  }
  EXPECT_GT(ones, 0);
  EXPECT_LT(ones, kKills);
  // The next one takes away what those that were killed have left.
  ASSERT_TRUE(ReplaceFile(file, one));
  EXPECT_THAT(Names(folder), ::testing::ElementsAre("a.xml"));
}

}  // namespace
}  // namespace runnel::testing
