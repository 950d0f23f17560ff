#include "core/base/erase_where.h"

#include <deque>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>

namespace runnel {
namespace {

using testing::ElementsAre;

template <typename Sequence>
Sequence Numbers() {
  Sequence all;
  for (int i = 0; i < 6; ++i) all.push_back(std::make_unique<int>(i));
  return all;
}

std::vector<int> Left(const auto& all) {
  std::vector<int> left;
  for (const auto& each : all) left.push_back(each == nullptr ? -1 : *each);
  return left;
}

TEST(EraseWhere, ErasesThoseThatAreMeantInTheirOrder) {
  auto all = Numbers<std::vector<std::unique_ptr<int>>>();
  EraseWhere(all, [](const auto& each) { return *each % 2 == 0; });
  EXPECT_THAT(Left(all), ElementsAre(1, 3, 5));
  EraseWhere(all, [](const auto&) { return true; });
  EXPECT_TRUE(all.empty());
  EraseWhere(all, [](const auto&) { return true; });
}

TEST(EraseWhere, LeavesNoneEmptyWhereTheConditionThrows) {
  auto all = Numbers<std::deque<std::unique_ptr<int>>>();
  const auto throws_at_4 = [](const auto& each) {
    if (*each == 4) throw std::runtime_error("is not known");
    return *each == 0 || *each == 2;
  };
  EXPECT_THROW(EraseWhere(all, throws_at_4), std::runtime_error);
  EXPECT_THAT(Left(all), ElementsAre(1, 3, 4, 5));
}

}  // namespace
}  // namespace runnel
