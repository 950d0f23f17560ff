// Processes that hold values and are killed.

#include <atomic>
#include <memory>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "plugins/wire_cyclone/cyclone_wire.h"
#include "plugins/wire_shared_memory/segment_server.h"
#include "plugins/wire_shared_memory/shared_memory_wire.h"
#include "tests/plugins/wire_shared_memory/nobody.h"
#include "tests/support/child_process.h"
#include "tests/support/own_network.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

TEST(KilledReaderTest, WhatItHeldStaysAsItIsAndIsFreeWhenItHasEnded) {
  Child reader([](int from, int to) {
    SegmentPlace place;
    if (read(from, &place, sizeof place) != sizeof place) return;
    const auto fetched = FetchSegment(place);
    if (!fetched) return;
    const auto held = (*fetched)->Hold(place);
    if (held == nullptr || write(to, "h", 1) != 1) return;
    char octet = 0;
    if (read(from, &octet, 1) != 1) return;
    bool is_same = true;
    for (std::size_t i = 0; i < place.size; ++i) is_same = is_same && held.get()[i] == std::byte{7};
    if (is_same && write(to, "s", 1) != 1) return;
    pause();
  });
  const auto server = std::move(*SegmentServer::Start());
  const auto segment = std::move(*WrittenSegment::Make(100'000));
  server->Offer(*segment);
  SegmentPlace place = *segment->Put(Octets(100'000, std::byte{7}));
  place.server = server->id();
  ASSERT_EQ(write(reader.to(), &place, sizeof place), static_cast<ssize_t>(sizeof place));
  ASSERT_TRUE(reader.HasSaidSo());
  EXPECT_TRUE(segment->holders()->Hold(place.slot));
  const Octets others(100'000, std::byte{8});
  for (int i = 0; i < 1000; ++i) {
    const auto next = segment->Put(others);
    ASSERT_TRUE(next);
    ASSERT_NE(next->slot, place.slot);
    ASSERT_LE(next->slot, WrittenSegment::kSpare) << "more memory than is needed";
  }
  ASSERT_EQ(write(reader.to(), "?", 1), 1);
  EXPECT_TRUE(reader.HasSaidSo()) << "what was held has changed";
  reader.Kill();
  WaitUntil("it holds nothing any more", [&] { return !segment->holders()->Hold(place.slot); });
  std::set<std::uint32_t> used;
  for (int i = 0; i < 100; ++i) used.insert(segment->Put(others)->slot);
  EXPECT_TRUE(used.contains(place.slot));
  WaitUntil("it is forgotten", [&] { return segment->holders()->count() == 0; });
}

const WireEndpointOptions kHeldTopic = {.topic = "rt/held", .type = "Image"};

TEST(KilledReaderTest, PublishingGoesOnForOthers) {
  const unsigned domain = OwnDomain();
  Child killed([domain](int from, int to) {
    char octet = 0;
    if (read(from, &octet, 1) != 1) return;
    Nobody nobody;
    const auto engine = MakeSharedMemoryWire(MakeCycloneWire());
    const auto joined = engine->Join({.domain = domain}, nobody);
    if (!joined) return;
    std::vector<std::shared_ptr<const void>> kept;
    const auto reader = (*joined)->MakeReader(kHeldTopic,
                                              [&](const WireSample& sample) {
                                                if (sample.holder == nullptr || kept.size() == 10) return;
                                                kept.push_back(sample.holder);
                                                if (kept.size() == 10) (void)write(to, "h", 1);
                                              },
                                              {});
    pause();
  });
  Nobody nobody;
  const auto engine = MakeSharedMemoryWire(MakeCycloneWire());
  const auto writing = engine->Join({.domain = domain}, nobody);
  const auto reading = engine->Join({.domain = domain}, nobody);
  ASSERT_TRUE(writing && reading);
  std::atomic<int> shared{0};
  const auto reader =
      (*reading)->MakeReader(kHeldTopic, [&](const WireSample& each) { shared += each.holder != nullptr; }, {});
  const auto writer = (*writing)->MakeWriter(kHeldTopic, {});
  ASSERT_TRUE(reader && writer);
  std::atomic<bool> has_ended{false};
  std::thread publishing([&] {
    while (!has_ended) {
      (void)(*writer)->Write(std::make_shared<Octets>(100'000), 1);
      usleep(2000);
    }
  });
  EXPECT_EQ(write(killed.to(), "x", 1), 1);
  EXPECT_TRUE(killed.HasSaidSo());
  for (int i = 0; i < 2; ++i) {  // while it stands still, and when it has been killed
    const int before = shared;
    WaitUntil("values come", [&] { return shared > before + 100; });
    killed.Kill();
  }
  has_ended = true;
  publishing.join();
}

}  // namespace
}  // namespace runnel::test
