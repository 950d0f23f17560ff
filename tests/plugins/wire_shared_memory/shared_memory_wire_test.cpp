#include "plugins/wire_shared_memory/shared_memory_wire.h"

#include <atomic>
#include <fstream>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/plugins/wire_shared_memory/nobody.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

constexpr std::size_t kLarge = 1'000'000;

// What has come to a reader.
struct Come {
  std::mutex mutex;
  std::vector<std::pair<std::size_t, int>> values;  // how many octets, the last of them
  std::vector<std::string> flaws;
  bool is_shared = false;  // the last
  std::function<void()> meanwhile;
  std::vector<WireSample> kept;  // as many as `keeps`, with what holds them
  std::size_t keeps = 0;

  OnSample Taker() {
    return [this](const WireSample& sample) {
      const std::lock_guard lock(mutex);
      is_shared = sample.holder != nullptr;
      if (meanwhile) meanwhile();
      if (is_shared && kept.size() < keeps) kept.push_back(sample);
      if (!sample.flaw.empty()) return flaws.emplace_back(sample.flaw), void();
      values.emplace_back(sample.octets.size(), std::to_integer<int>(sample.octets.back()));
    };
  }
  std::size_t count() {
    const std::lock_guard lock(mutex);
    return values.size();
  }
};

std::shared_ptr<Octets> Large(int last, std::size_t size = kLarge) {
  auto octets = std::make_shared<Octets>(size);
  octets->at(1) = std::byte{1};
  octets->back() = std::byte(last);
  return octets;
}

class SharedMemoryWireTest : public testing::Test {
 protected:
  std::unique_ptr<WireParticipant> Join(WireEngine& engine) {
    auto joined = engine.Join({}, nobody_);
    EXPECT_TRUE(joined);
    return std::move(*joined);
  }
  static WireEndpointOptions Topic(const WireQos& qos = {}) {
    return {.topic = "rt/image", .type = "Image", .qos = qos};
  }
  // Of a writer that has found `readers`.
  std::unique_ptr<WireWriter> Write(WireParticipant& by, std::size_t readers, const WireQos& qos = {}) {
    auto made = by.MakeWriter(Topic(qos), [this](std::size_t count) { matched_ = count; });
    EXPECT_TRUE(made);
    WaitUntil("all have found one another", [&] { return matched_ == readers; });
    WaitUntilQuiet(*fake_);
    return std::move(*made);
  }

  Nobody nobody_;
  std::atomic<std::size_t> matched_{0};
  const std::shared_ptr<WireEngine> fake_ = MakeFakeWire();
  const std::shared_ptr<WireEngine> engine_ = MakeSharedMemoryWire(fake_);
  const std::unique_ptr<WireParticipant> a_ = Join(*engine_);
  const std::unique_ptr<WireParticipant> b_ = Join(*engine_);
};

TEST_F(SharedMemoryWireTest, LargeValuesLieInSharedMemory) {
  Come come;
  const auto reader = b_->MakeReader(Topic(), come.Taker(), {});
  const auto writer = Write(*a_, 1);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(writer->Write(Large(i), 1));
    WaitUntilQuiet(*fake_);
  }
  ASSERT_EQ(come.count(), 20u);
  EXPECT_TRUE(come.is_shared);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(come.values[static_cast<std::size_t>(i)], std::pair(kLarge, i));
}

TEST_F(SharedMemoryWireTest, SmallAndLatchedValuesAndEachOfManyGoAsTheyDo) {
  Come come;
  const auto reader = b_->MakeReader(Topic(), come.Taker(), {});
  {
    const auto writer = Write(*a_, 1);
    ASSERT_TRUE(writer->Write(Large(1, 1000), 1));
    WaitUntilQuiet(*fake_);
    EXPECT_FALSE(come.is_shared);
  }
  for (const WireQos& qos : {WireQos{.is_latched = true}, WireQos{.depth = 128}}) {
    const auto writer = Write(*a_, 1, qos);
    ASSERT_TRUE(writer->Write(Large(2), 1));
    WaitUntilQuiet(*fake_);
    EXPECT_FALSE(come.is_shared);
    EXPECT_EQ(come.values.back(), std::pair(kLarge, 2));
  }
}

TEST_F(SharedMemoryWireTest, WhereOneReaderKnowsNothingOfItAllGetOctets) {
  Come come;
  Come foreign;
  const auto reader = b_->MakeReader(Topic(), come.Taker(), {});
  const auto stranger = Join(*fake_);  // without shared memory: a node of ROS 2, another machine
  auto other = stranger->MakeReader(Topic(), foreign.Taker(), {});
  const auto writer = Write(*a_, 2);
  ASSERT_TRUE(writer->Write(Large(1), 1));
  WaitUntilQuiet(*fake_);
  EXPECT_FALSE(come.is_shared);
  EXPECT_EQ(come.values.back(), std::pair(kLarge, 1));
  EXPECT_EQ(foreign.values.back(), std::pair(kLarge, 1));
  *other = nullptr;
  WaitUntilQuiet(*fake_);
  ASSERT_TRUE(writer->Write(Large(2), 1));
  WaitUntilQuiet(*fake_);
  EXPECT_TRUE(come.is_shared);
  EXPECT_EQ(come.values.back(), std::pair(kLarge, 2));
}

TEST_F(SharedMemoryWireTest, AValueThatIsLargerThanAllBeforeHasRoom) {
  Come come;
  const auto reader = b_->MakeReader(Topic(), come.Taker(), {});
  const auto writer = Write(*a_, 1);
  for (const std::size_t size : {kLarge, 10 * kLarge, kLarge}) {
    ASSERT_TRUE(writer->Write(Large(1, size), 1));
    WaitUntilQuiet(*fake_);
    EXPECT_TRUE(come.is_shared);
    EXPECT_EQ(come.values.back().first, size);
  }
}

TEST_F(SharedMemoryWireTest, WhoReadsSlowlyIsToldThatNewerValuesHaveTakenThePlace) {
  Come come;
  const auto reader = b_->MakeReader(Topic(), come.Taker(), {});
  const auto writer = Write(*a_, 1);
  bool is_first = true;
  come.meanwhile = [&] {
    if (!std::exchange(is_first, false)) return;
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(writer->Write(Large(i), 1));  // one more than there are slots
  };
  ASSERT_TRUE(writer->Write(Large(77), 1));
  WaitUntil("the last has come", [&] {
    const std::lock_guard lock(come.mutex);
    return !come.values.empty() && come.values.back().second == 4;
  });
  WaitUntilQuiet(*fake_);
  EXPECT_EQ(come.flaws.size(), 1u);           // of those five, the first has gone when it is looked for
  EXPECT_EQ(come.values.front().second, 77);  // held meanwhile
}

TEST_F(SharedMemoryWireTest, WhatIsHeldStaysAsItIsWhateverIsWritten) {
  Come keeping;
  keeping.keeps = 3;
  Come other;
  const auto one = b_->MakeReader(Topic(), keeping.Taker(), {});
  const auto two = b_->MakeReader(Topic(), other.Taker(), {});
  const auto writer = Write(*a_, 2);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(writer->Write(Large(i % 200, 40'000), 1));
    WaitUntilQuiet(*fake_);
    ASSERT_EQ(other.values.back().second, i % 200);
    ASSERT_TRUE(other.is_shared);
  }
  EXPECT_EQ(keeping.count(), 1000u);
  EXPECT_EQ(other.count(), 1000u);
  ASSERT_EQ(keeping.kept.size(), 3u);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(std::to_integer<int>(keeping.kept[static_cast<std::size_t>(i)].octets.back()), i);
}

TEST_F(SharedMemoryWireTest, WhoHoldsManyIsGivenOctetsToCopyAndOthersGoOn) {
  Come keeping;
  keeping.keeps = 100;
  Come other;
  const auto one = b_->MakeReader(Topic(), keeping.Taker(), {});
  const auto two = b_->MakeReader(Topic(), other.Taker(), {});
  const auto writer = Write(*a_, 2);
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(writer->Write(Large(i), 1));
    WaitUntilQuiet(*fake_);
    EXPECT_TRUE(other.is_shared);
    EXPECT_EQ(keeping.values.back(), std::pair(kLarge, i));
  }
  EXPECT_EQ(keeping.kept.size(), 16u);
  EXPECT_FALSE(keeping.is_shared);
  keeping.kept.clear();
  ASSERT_TRUE(writer->Write(Large(1), 1));
  WaitUntilQuiet(*fake_);
  EXPECT_TRUE(keeping.is_shared);
}

TEST_F(SharedMemoryWireTest, WhereAllMemoryIsHeldValuesComeAsOctets) {
  std::vector<std::unique_ptr<Come>> all;
  std::vector<std::unique_ptr<WireReader>> readers;
  for (int i = 0; i < 5; ++i) {
    all.push_back(std::make_unique<Come>());
    readers.push_back(std::move(*b_->MakeReader(Topic(), all.back()->Taker(), {})));
  }
  const auto writer = Write(*a_, 5);
  // Each holds sixteen of its own.
  for (int i = 0; i < 80; ++i) {
    for (auto& each : all) each->keeps = each->kept.size();
    Come& next = *all[static_cast<std::size_t>(i / 16)];
    next.keeps = 16;
    ASSERT_TRUE(writer->Write(Large(i, 40'000), 1));
    WaitUntilQuiet(*fake_);
    for (const auto& each : all) ASSERT_EQ(each->values.back().second, i);
  }
  EXPECT_FALSE(all.back()->is_shared);
  EXPECT_TRUE(all.back()->kept.empty());
  all.front()->kept.clear();
  ASSERT_TRUE(writer->Write(Large(7), 1));
  WaitUntilQuiet(*fake_);
  EXPECT_TRUE(all.back()->is_shared);
}

TEST_F(SharedMemoryWireTest, WhatIsHeldOutlivesWriterReaderAndMember) {
  Come come;
  come.keeps = 1;
  {
    const auto other = Join(*engine_);
    const auto reader = other->MakeReader(Topic(), come.Taker(), {});
    const auto writer = Write(*a_, 1);
    ASSERT_TRUE(writer->Write(Large(7), 1));
    WaitUntilQuiet(*fake_);
  }
  ASSERT_EQ(come.kept.size(), 1u);
  EXPECT_EQ(come.kept[0].octets.size(), kLarge);
  EXPECT_EQ(std::to_integer<int>(come.kept[0].octets.back()), 7);
}

TEST_F(SharedMemoryWireTest, NumbersAreAlignedInMemoryAsInTheMessage) {
  Come come;
  come.keeps = 3;
  const auto reader = b_->MakeReader(Topic(), come.Taker(), {});
  const auto writer = Write(*a_, 1);
  for (const std::size_t size : {kLarge, kLarge + 1, kLarge + 3}) {
    ASSERT_TRUE(writer->Write(Large(1, size), 1));
    WaitUntilQuiet(*fake_);
  }
  ASSERT_EQ(come.kept.size(), 3u);
  for (const WireSample& each : come.kept) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(each.octets.data() + 4) % 64, 0u);
  }
}

TEST_F(SharedMemoryWireTest, NothingIsLeftWhenAllHaveGone) {
  const auto maps = [] {
    std::ifstream file("/proc/self/maps");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    return text.find("memfd:runnel values") != std::string::npos;
  };
  {
    Come come;
    const auto reader = b_->MakeReader(Topic(), come.Taker(), {});
    const auto writer = Write(*a_, 1);
    ASSERT_TRUE(writer->Write(Large(1), 1));
    WaitUntilQuiet(*fake_);
    EXPECT_TRUE(come.is_shared);
    EXPECT_TRUE(maps());
  }
  EXPECT_FALSE(maps());
}

}  // namespace
}  // namespace runnel::test
