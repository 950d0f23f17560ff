#include "core/base/shared_vector.h"

#include <cstdint>
#include <numeric>
#include <span>

#include <gtest/gtest.h>

#include "plugins/testing/guards.h"

namespace runnel::test {
namespace {

using Numbers = SharedVector<int>;

// Three numbers of somebody else's.
struct Others {
  std::shared_ptr<std::vector<int>> memory = std::make_shared<std::vector<int>>(std::vector<int>{1, 2, 3});
  Numbers list;
  Others() { list.ReferTo(memory->data(), memory->size(), memory); }
};

TEST(SharedVector, IsUsedAsAVector) {
  Numbers list = {1, 2, 3};
  list.push_back(4);
  list[0] = 7;
  list.resize(6);
  list.back() = 9;
  EXPECT_EQ(list, (std::vector<int>{7, 2, 3, 4, 0, 9}));
  list.erase(list.begin() + 1, list.begin() + 3);
  list.insert(list.begin(), 5);
  list.insert(list.end(), {8, 8});
  EXPECT_EQ(list, (Numbers{5, 7, 4, 0, 9, 8, 8}));
  EXPECT_EQ(std::accumulate(list.begin(), list.end(), 0), 41);
  EXPECT_EQ(list.at(1), 7);
  EXPECT_THROW((void)list.at(7), std::out_of_range);
  const std::vector<int> copied = list;
  EXPECT_EQ(list, copied);
  EXPECT_NE(list, (std::vector<int>{5}));
  list.assign(2, 6);
  EXPECT_EQ(list, (Numbers{6, 6}));
  list = std::vector<int>{1};
  list.emplace_back(2);
  list.pop_back();
  EXPECT_EQ(list, (Numbers{1}));
  EXPECT_EQ(*list.rbegin(), 1);
  list = {};
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(Numbers(3), (Numbers{0, 0, 0}));
}

TEST(SharedVector, LooksAtMemoryOfOthersWithoutACopy) {
  const Others others;
  EXPECT_TRUE(others.list.is_reference());
  EXPECT_EQ(others.list.data(), others.memory->data());
  const Numbers copy = others.list;
  EXPECT_EQ(copy.data(), others.memory->data());
  EXPECT_EQ(others.memory.use_count(), 3);
  EXPECT_EQ(copy, (Numbers{1, 2, 3}));
  const std::span<const int> seen = copy;
  EXPECT_EQ(seen.data(), others.memory->data());
}

TEST(SharedVector, LetsTheHolderGoWithTheLastOneThatRefers) {
  Others others;
  {
    Numbers copy = others.list;
    Numbers moved = std::move(copy);
    EXPECT_TRUE(copy.empty());
    EXPECT_FALSE(copy.is_reference());
    others.list = {};
    EXPECT_EQ(others.memory.use_count(), 2);
    moved.swap(others.list);
    EXPECT_TRUE(moved.empty());
    EXPECT_EQ(others.list, (Numbers{1, 2, 3}));
  }
  others.list.clear();
  EXPECT_EQ(others.memory.use_count(), 1);
}

TEST(SharedVector, WhatCouldChangeItMakesItOwn) {
  const auto becomes = [](std::vector<int> expected, auto&& change) {
    Others others;
    const Numbers same = others.list;
    change(others.list);
    EXPECT_FALSE(others.list.is_reference());
    EXPECT_EQ(others.list, expected);
    EXPECT_EQ(same, (Numbers{1, 2, 3})) << "another's";
    EXPECT_EQ(*others.memory, (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(others.memory.use_count(), 2);
  };
  becomes({1, 5, 3}, [](Numbers& list) { list[1] = 5; });
  becomes({1, 2, 5}, [](Numbers& list) { list.back() = 5; });
  becomes({2, 3, 4}, [](Numbers& list) {
    for (int& each : list) ++each;
  });
  becomes({1, 2, 3}, [](Numbers& list) { list.resize(3); });
  becomes({1, 2}, [](Numbers& list) { list.resize(2); });
  becomes({1, 2, 3, 9}, [](Numbers& list) { list.resize(4, 9); });
  becomes({1, 2, 3, 4}, [](Numbers& list) { list.push_back(4); });
  becomes({0, 1, 2, 3}, [](Numbers& list) { list.insert(list.cbegin(), 0); });
  becomes({1, 3}, [](Numbers& list) { list.erase(list.cbegin() + 1); });
  becomes({3, 2}, [](Numbers& list) { list.assign(list.crbegin(), list.crend() - 1); });
  becomes({}, [](Numbers& list) { list.clear(); });
  becomes({4}, [](Numbers& list) { list = Numbers{4}; });
}

TEST(SharedVector, UsesItsMemoryAgain) {
  Numbers list(1000);
  const Numbers from(900, 1);
  const AllocationGuard guard;
  list.resize(10);
  list.resize(1000);
  list.assign(1000, 3);
  list = from;
  list.clear();
  for (int i = 0; i < 1000; ++i) list.push_back(i);
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace runnel::test
