#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "plugins/wire_shared_memory/segment_server.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

const Octets kOctets(1000, std::byte{1});

TEST(SegmentServerTest, NamesThatNobodyHasAreAnErrorAndSoIsOtherMemory) {
  const auto server = SegmentServer::Start();
  ASSERT_TRUE(server);
  const auto segment = WrittenSegment::Make(1000);
  ASSERT_TRUE(segment);
  SegmentPlace place = *(*segment)->Put(kOctets);
  EXPECT_FALSE(FetchSegment(place));  // of a server that is nowhere
  place.server = (*server)->id();
  EXPECT_FALSE(FetchSegment(place));  // not offered
  (*server)->Offer(**segment);
  const auto fetched = FetchSegment(place);
  ASSERT_TRUE(fetched);
  EXPECT_TRUE((*fetched)->Hold(place));
  (*server)->Withdraw(**segment);
  EXPECT_FALSE(FetchSegment(place));
  const FileDescriptor file(memfd_create("other", MFD_CLOEXEC));
  EXPECT_EQ(ftruncate(file.number(), 100'000), 0);
  EXPECT_FALSE(ReadSegment::Map(file, nullptr, FileDescriptor()));
  EXPECT_FALSE(HoldTable::Map(FileDescriptor(dup(file.number()))));
}

TEST(SegmentTest, PlacesThatSomebodyHasMadeUpAreNowhere) {
  const auto segment = WrittenSegment::Make(1000);
  ASSERT_TRUE(segment);
  const SegmentPlace place = *(*segment)->Put(kOctets);
  auto table = HoldTable::Make();
  ASSERT_TRUE(table);
  const auto read = ReadSegment::Map(FileDescriptor(dup((*segment)->descriptor())),
                                     *HoldTable::Map(FileDescriptor(dup((*table)->descriptor()))), FileDescriptor());
  ASSERT_TRUE(read);
  const auto held = (*read)->Hold(place);
  EXPECT_TRUE(held);
  EXPECT_FALSE((*read)->Hold(place));
  const auto is_nowhere = [&](const auto& change) {
    SegmentPlace made_up = place;
    change(made_up);
    return (*read)->Hold(made_up) == nullptr;
  };
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.slot = kSlots; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.slot = ~0u; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.slot = 1; }));
  EXPECT_TRUE(is_nowhere([](SegmentPlace& at) { at.slot = 1, at.use = 0; }));
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
  EXPECT_FALSE(SegmentPlace::In(kOctets));
  EXPECT_FALSE(SegmentPlace::In({}));
  const auto cut = SegmentPlace::In(std::span(*octets).first(14));  // it is nowhere
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->size, 0u);
}

TEST(SegmentTest, SlotsComeIntoUseAsTheyAreHeld) {
  const auto server = std::move(*SegmentServer::Start());
  const auto segment = std::move(*WrittenSegment::Make(1000));
  server->Offer(*segment);
  std::shared_ptr<ReadSegment> read;
  std::vector<std::shared_ptr<const std::byte>> held;
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < kSlots; ++i) {
    auto place = segment->Put(kOctets);
    ASSERT_TRUE(place);
    EXPECT_TRUE(seen.insert(place->slot).second);
    place->server = server->id();
    if (read == nullptr) read = *FetchSegment(*place);
    held.push_back(read->Hold(*place));
    EXPECT_TRUE(held.back());
  }
  EXPECT_FALSE(segment->Put(kOctets)) << "all are held";
  held[7] = nullptr;
  EXPECT_EQ(segment->Put(kOctets)->slot, 7u);
  held.clear();
  for (std::uint32_t i = 0; i < 2 * kSlots; ++i) EXPECT_TRUE(segment->Put(kOctets));
}

TEST(SegmentTest, AsManyAsAreSpareTakeTurnsWhereNobodyHolds) {
  const auto segment = std::move(*WrittenSegment::Make(1000));
  for (std::uint32_t i = 0; i < 20; ++i) EXPECT_EQ(segment->Put(kOctets)->slot, i % WrittenSegment::kSpare);
}

TEST(SegmentTest, WhoseLinkIsClosedHoldsNothing) {
  const auto server = std::move(*SegmentServer::Start());
  const auto segment = std::move(*WrittenSegment::Make(1000));
  server->Offer(*segment);
  SegmentPlace place = *segment->Put(kOctets);
  place.server = server->id();
  auto held = (*FetchSegment(place))->Hold(place);  // the segment stays as long as that is held
  ASSERT_TRUE(held);
  EXPECT_TRUE(segment->holders()->Hold(place.slot));
  EXPECT_EQ(segment->holders()->count(), 1u);
  EXPECT_EQ(*held, std::byte{1});
  held = nullptr;
  EXPECT_FALSE(segment->holders()->Hold(place.slot));
  WaitUntil("the reader is forgotten", [&] { return segment->holders()->count() == 0; });
}

}  // namespace
}  // namespace runnel::test
