// What lies in memory that two applications share, and is not copied by who reads it.

#include <algorithm>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "plugins/wire_shared_memory/shared_memory_wire.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

class LargeValuesTest : public testing::Test {
 protected:
  static constexpr std::size_t kCount = 8000;  // 64 kB

  LargeValuesTest() {
    writing_.Offer({.patterns = {"module/*"}});
    reading_.Take({.topic = "/a/module/row"}, reading_.module.wanted);
    other_.Take({.topic = "/a/module/row"}, other_.module.wanted);
    for (Member* each : {&writing_, &reading_, &other_}) each->Begin();
    WaitUntil("it is read", [&] { return IsConnected(writing_.module.row); });
    // As soon as both are known to be there, and to share the memory.
    WaitUntil("values come without a copy", [&] {
      Publish(0);
      return IsShared(reading_) && IsShared(other_);
    });
  }
  void Publish(double number) {
    auto loan = writing_.module.row.Loan();
    loan->values.assign(kCount, number);
    writing_.module.row.Publish(std::move(loan));
  }
  static bool IsShared(Member& member) {
    const auto read = member.module.wanted.Read();
    return read.has_value() && read->values.is_reference();
  }
  static void WaitForNumber(Member& member, double number) {
    WaitUntil("it has come", [&] {
      const auto read = member.module.wanted.Read();
      return read.has_value() && read->values[0] == number;
    });
  }
  static bool IsAll(const Row& row, double number) {
    return row.values.size() == kCount && std::ranges::all_of(row.values, [&](double each) { return each == number; });
  }

  const std::shared_ptr<WireEngine> engine_ = MakeSharedMemoryWire(MakeFakeWire());
  Member writing_{*engine_, "a"};
  Member reading_{*engine_, "b"};
  Member other_{*engine_, "c"};
};

TEST_F(LargeValuesTest, ALeaseKeepsTheValueAsItIsAndOthersGoOn) {
  Publish(7);
  WaitForNumber(reading_, 7);
  const auto lease = reading_.module.wanted.Read();
  ASSERT_TRUE(lease->values.is_reference());
  for (int i = 1000; i < 2000; ++i) {
    Publish(i);
    if (i % 20 == 0) WaitForNumber(other_, i);
  }
  WaitForNumber(other_, 1999);
  WaitForNumber(reading_, 1999);
  EXPECT_TRUE(IsShared(other_));
  EXPECT_TRUE(IsShared(reading_));
  EXPECT_TRUE(IsAll(*lease, 7));
}

TEST_F(LargeValuesTest, ACopyOfTheValueKeepsItToo) {
  Publish(7);
  WaitForNumber(reading_, 7);
  const Row copy = *reading_.module.wanted.Read();
  EXPECT_TRUE(copy.values.is_reference());
  Row changed = copy;
  changed.values[0] = 8;
  for (int i = 1000; i < 1100; ++i) {
    Publish(i);
    WaitForNumber(reading_, i);
  }
  EXPECT_TRUE(IsAll(copy, 7));
  EXPECT_FALSE(changed.values.is_reference());
  EXPECT_EQ(changed.values[1], 7);
}

TEST_F(LargeValuesTest, WhoHoldsManyHasTheOthersCopied) {
  using Held = decltype(reading_.module.wanted.Read());
  std::vector<Held> leases;
  for (int i = 1; i <= 40; ++i) {
    Publish(i);
    WaitForNumber(reading_, i);
    leases.push_back(reading_.module.wanted.Read());
  }
  EXPECT_FALSE(leases.back()->values.is_reference()) << "so many may be held";
  EXPECT_TRUE(IsShared(other_));
  for (int i = 1; i <= 40; ++i) EXPECT_TRUE(IsAll(*leases[static_cast<std::size_t>(i - 1)], i));
}

TEST_F(LargeValuesTest, ALeaseOutlivesTheNetworksOfBothEnds) {
  Publish(7);
  WaitForNumber(reading_, 7);
  const auto lease = reading_.module.wanted.Read();
  writing_.End();
  reading_.End();
  EXPECT_TRUE(IsAll(*lease, 7));
}

}  // namespace
}  // namespace runnel::test
