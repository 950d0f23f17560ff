#include "tests/support/wait_until.h"

#include <gtest/gtest-spi.h>

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

TEST(WaitUntil, EndsWhenTheConditionIsTrue) {
  int asked = 0;
  WaitUntil("it has been asked three times", [&] { return ++asked == 3; });
  EXPECT_EQ(asked, 3);
}

TEST(WaitUntil, FailsTheTestWithWhatItWaitedForAndEndsIt) {
  bool goes_on = false;
  const auto wait = [&] {
    try {
      WaitUntil(
          "pigs fly", [] { return false; }, 1ms);
      goes_on = true;
    } catch (const ::testing::AssertionException&) {  // by which a test ends
    }
  };
  EXPECT_NONFATAL_FAILURE(wait(), "waited 1 ms in vain until pigs fly");
  EXPECT_FALSE(goes_on);
}

}  // namespace
}  // namespace runnel::test
