#include "core/base/result.h"

#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(ResultTest, HoldsAValueOrAnError) {
  const Result<int> value = 3;
  ASSERT_TRUE(value);
  EXPECT_EQ(*value, 3);
  const Result<int> error = Error{.message = "no"};
  ASSERT_FALSE(error);
  EXPECT_EQ(error.error().message, "no");
}

TEST(ResultTest, CarriesMoveOnlyValues) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(4);
  const std::unique_ptr<int> taken = *std::move(result);
  EXPECT_EQ(*taken, 4);
}

TEST(ResultTest, AskingForTheMissingHalfIsAProgrammingError) {
  const Result<int> error = Error{.message = "broken"};
  EXPECT_THROW((void)error.value(), ProgrammingError);
  const Result<void> success;
  EXPECT_THROW((void)success.error(), ProgrammingError);
}

}  // namespace
}  // namespace runnel
