#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <thread>

#include <gtest/gtest.h>

namespace runnel::test {

/// How long a test waits for what other threads or processes do. No test says how long something
/// takes: whoever waits so long waits for something that does not come.
inline constexpr std::chrono::seconds kLongestWait{60};

/// WaitUntil(), with `pause` between two looks.
template <typename Condition, typename Pause>
void WaitWithPauses(std::string_view what, Condition& condition, std::chrono::milliseconds limit, const Pause& pause,
                    const char* file, int line) {
  const auto latest = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= latest) {
      const std::string text = "waited " + std::to_string(limit.count()) + " ms in vain until " + std::string(what);
      ADD_FAILURE_AT(file, line) << text;
      throw ::testing::AssertionException(
          ::testing::TestPartResult(::testing::TestPartResult::kFatalFailure, file, line, text.c_str()));
    }
    pause();
  }
}

/// Waits until `condition()`. If that does not come true within `limit`, the test fails at the
/// calling line with `what`, which says in words what was waited for, and ends there; in a thread of
/// the test's own the program ends, with the same text. The caller's place is the builtins' that GCC and
/// clang share: clang 14 does not have std::source_location.
template <typename Condition>
void WaitUntil(std::string_view what, Condition&& condition, std::chrono::milliseconds limit = kLongestWait,
               const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  const auto sleep = [] { std::this_thread::sleep_for(std::chrono::microseconds(100)); };
  WaitWithPauses(what, condition, limit, sleep, file, line);
}

/// The same without sleeping, for threads whose turns are to be many and close.
template <typename Condition>
void YieldUntil(std::string_view what, Condition&& condition, std::chrono::milliseconds limit = kLongestWait,
                const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
  WaitWithPauses(
      what, condition, limit, [] { std::this_thread::yield(); }, file, line);
}

}  // namespace runnel::test
