#pragma once

#include <cstddef>
#include <filesystem>
#include <iterator>

#include "tests/support/wait_until.h"

namespace runnel::test {

/// How many files and threads of this process there are.
struct HeldResources {
  static std::size_t CountOf(const char* folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
  }
  /// The system lists a thread a moment longer than it is waited for.
  void AwaitAgain() const {
    WaitUntil("files and threads are as many as before", [this] { return HeldResources() == *this; });
  }
  std::size_t files = CountOf("/proc/self/fd");
  std::size_t threads = CountOf("/proc/self/task");
  bool operator==(const HeldResources&) const = default;
};

}  // namespace runnel::test
