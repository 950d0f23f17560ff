#include "core/base/lookout.h"

#include <atomic>
#include <new>

#include <gtest/gtest.h>

#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

TEST(LookoutTest, LooksAgainSoonWhereALookHadNoMemory) {
  std::atomic<int> looks{0};
  Lookout lookout([&]() -> std::optional<Time> {
    if (++looks < 3) throw std::bad_alloc();
    return {};
  });
  lookout.Ask();
  WaitUntil("it has come to an end", [&] { return looks == 3; });
}

}  // namespace
}  // namespace runnel::test
