// What `runnel run` says of a crash is tried in tests/integration.

#include "plugins/crash_report/crash_report.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace runnel {
namespace {

std::string Read(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A process that makes files for everybody crashes, and tells of it in this file.
void CrashWith(const std::filesystem::path& file) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer reports crashes itself";
#endif
  GTEST_FLAG_SET(death_test_style, "fast");
  [[maybe_unused]] const auto crash = [&] {
    umask(0);
    const CrashReport report({.file = file});
    raise(SIGSEGV);
  };
  EXPECT_EXIT(crash(), testing::KilledBySignal(SIGSEGV), "crash: no module");
}

// Its name can be guessed, and the folder may be one in which others make links to what is this user's.
TEST(CrashReportDeathTest, FollowsNoLinkThatStandsWhereItsFileGoes) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "dear") << "not to be lost";
  std::filesystem::create_symlink(folder / "dear", folder / "crash.txt");
  std::filesystem::create_symlink(folder / "nothing", folder / "other.txt");
  CrashWith(folder / "crash.txt");
  CrashWith(folder / "other.txt");
  EXPECT_EQ(Read(folder / "dear"), "not to be lost");
  EXPECT_FALSE(std::filesystem::exists(folder / "nothing"));
}

TEST(CrashReportDeathTest, ItsFileIsForNobodyElse) {
  const test::TemporaryFolder folder;
  CrashWith(folder / "crash.txt");
  if (testing::Test::IsSkipped()) return;
  EXPECT_THAT(Read(folder / "crash.txt"), testing::HasSubstr("SIGSEGV"));
  EXPECT_EQ(std::filesystem::status(folder / "crash.txt").permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

// As where what is written for the report finds the heap broken.
TEST(CrashReportDeathTest, TheProcessEndsWhenItsHandlerCrashesToo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  [[maybe_unused]] const auto crash = [] {
    alarm(20);
    const pthread_t crashed = pthread_self();
    const CrashReport report({.rescue =
                                  [crashed](const Crash&) {
                                    pthread_kill(crashed, SIGABRT);
                                    std::this_thread::sleep_for(std::chrono::hours(1));
                                  },
                              .patience = std::chrono::hours(1)});
    raise(SIGSEGV);
  };
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer reports crashes itself";
#else
  EXPECT_EXIT(crash(), testing::KilledBySignal(SIGABRT), "");
#endif
}

}  // namespace
}  // namespace runnel
