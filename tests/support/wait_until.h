#pragma once

#include <chrono>
#include <source_location>
#include <string>
#include <string_view>
#include <thread>

#include <gtest/gtest.h>

namespace runnel::test {

/// How long a test waits for what other threads or processes do. No test says how long something
/// takes: whoever waits so long waits for something that does not come.
inline constexpr std::chrono::seconds kLongestWait{30};

/// WaitUntil(), with `pause` between two looks.
template <typename Condition, typename Pause>
void WaitWithPauses(std::string_view what, Condition& condition, std::chrono::milliseconds limit,
                    const Pause& pause, std::source_location from) {
  const auto latest = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= latest) {
      const std::string text =
          "waited " + std::to_string(limit.count()) + " ms in vain until " + std::string(what);
      const auto line = static_cast<int>(from.line());
      ADD_FAILURE_AT(from.file_name(), line) << text;
      throw ::testing::AssertionException(::testing::TestPartResult(
          ::testing::TestPartResult::kFatalFailure, from.file_name(), line, text.c_str()));
    }
    pause();
  }
}

/// Waits until `condition()`. If that does not come true within `limit`, the test fails at the
/// calling line with `what`, which says in words what was waited for, and ends there; in a thread of
/// the test's own the program ends, with the same text.
template <typename Condition>
void WaitUntil(std::string_view what, Condition&& condition,
               std::chrono::milliseconds limit = kLongestWait,
               std::source_location from = std::source_location::current()) {
  const auto sleep = [] { std::this_thread::sleep_for(std::chrono::microseconds(100)); };
  WaitWithPauses(what, condition, limit, sleep, from);
}

/// The same without sleeping, for threads whose turns are to be many and close.
template <typename Condition>
void YieldUntil(std::string_view what, Condition&& condition,
                std::chrono::milliseconds limit = kLongestWait,
                std::source_location from = std::source_location::current()) {
  WaitWithPauses(
      what, condition, limit, [] { std::this_thread::yield(); }, from);
}

}  // namespace runnel::test
