#include "plugins/wire_shared_memory/shared_memory_wire.h"

#include <atomic>
#include <fstream>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "plugins/wire/fake_wire.h"
#include "plugins/wire_shared_memory/segment_server.h"
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
  bool is_whole = false;  // the last, after that

  OnSample Taker() {
    return [this](const WireSample& sample) {
      const std::lock_guard lock(mutex);
      is_shared = sample.hold != nullptr;
      if (meanwhile) meanwhile();
      is_whole = sample.IsWhole();
      if (!sample.flaw.empty()) return flaws.emplace_back(sample.flaw), void();
      values.emplace_back(sample.octets.size(), std::to_integer<int>(sample.octets.back()));
    };
  }
  std::size_t count() {
    const std::lock_guard lock(mutex);
    return values.size();
  }
};

class Nobody final : public WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}
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
  static WireEndpointOptions Topic(const WireQos& qos = {}) { return {.topic = "rt/image", .type = "Image", .qos = qos}; }
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
  EXPECT_TRUE(come.is_whole);
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
  EXPECT_EQ(come.flaws.size(), 1u);  // of those five, the first has gone when it is looked for
  EXPECT_TRUE(come.is_whole);
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

TEST(SegmentServerTest, NamesThatNobodyHasAreAnErrorAndSoIsOtherMemory) {
  const auto server = SegmentServer::Start();
  ASSERT_TRUE(server);
  const auto segment = WrittenSegment::Make(1000);
  ASSERT_TRUE(segment);
  SegmentPlace place = (*segment)->Put(*Large(1, 1000));
  EXPECT_FALSE(FetchSegment(place));  // of a server that is nowhere
  place.server = (*server)->id();
  EXPECT_FALSE(FetchSegment(place));  // not offered
  (*server)->Offer(**segment);
  const auto fetched = FetchSegment(place);
  ASSERT_TRUE(fetched);
  EXPECT_TRUE((*fetched)->Find(place));
  (*server)->Withdraw(**segment);
  EXPECT_FALSE(FetchSegment(place));
  const Descriptor file(memfd_create("other", MFD_CLOEXEC));
  EXPECT_EQ(ftruncate(file.number(), 100'000), 0);
  EXPECT_FALSE(ReadSegment::Map(file));
}

TEST(SegmentTest, PlacesThatSomebodyHasMadeUpAreNowhere) {
  const auto segment = WrittenSegment::Make(1000);
  ASSERT_TRUE(segment);
  const SegmentPlace place = (*segment)->Put(*Large(1, 1000));
  const auto read = ReadSegment::Map(Descriptor(dup((*segment)->descriptor())));
  ASSERT_TRUE(read);
  EXPECT_TRUE((*read)->Find(place));
  const auto is_nowhere = [&](const auto& change) {
    SegmentPlace made_up = place;
    change(made_up);
    return !(*read)->Find(made_up);
  };
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.slot = 4; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.slot = ~0u; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.slot = 1; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.use = 1; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.use = 4; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.size = 4097; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.size = ~std::uint64_t{0}; }));
  EXPECT_EQ(mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, (*segment)->descriptor(), 0), MAP_FAILED);
  EXPECT_NE(ftruncate((*segment)->descriptor(), 0), 0);
}

TEST(SegmentTest, WhatGoesOverTheWireComesBack) {
  const SegmentPlace place{.server = NewSegmentId(), .segment = NewSegmentId(), .use = 6, .size = 123, .slot = 3};
  const auto octets = place.ToOctets();
  EXPECT_EQ(octets->size() % 4, 0u);
  const auto back = SegmentPlace::In(*octets);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->server, place.server);
  EXPECT_EQ(back->segment, place.segment);
  EXPECT_EQ(back->use, place.use);
  EXPECT_EQ(back->size, place.size);
  EXPECT_EQ(back->slot, place.slot);
  EXPECT_FALSE(SegmentPlace::In(*Large(1)));
  EXPECT_FALSE(SegmentPlace::In({}));
  const auto cut = SegmentPlace::In(std::span(*octets).first(14));  // it is nowhere
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->size, 0u);
}

}  // namespace
}  // namespace runnel::test
