// What `runnel run` says of a crash is tried in tests/integration.

#include "plugins/crash_report/crash_report.h"

#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

namespace runnel {
namespace {

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
