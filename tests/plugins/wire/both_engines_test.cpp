// Cyclone DDS and Fast DDS, each as the other's foreign end.

#include <algorithm>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>

#include <gmock/gmock.h>

#include "plugins/wire_cyclone/cyclone_wire.h"
#include "plugins/wire_fast/fast_wire.h"
#include "tests/plugins/wire/wire_ends.h"
#include "tests/support/own_network.h"

namespace runnel::test {
namespace {

using MakeEngine = std::shared_ptr<WireEngine> (*)();

/// The engine of who writes, that of who reads, and how far they reach.
class BothEnginesTest : public testing::TestWithParam<std::tuple<MakeEngine, MakeEngine, WireReach>> {
 protected:
  std::unique_ptr<WireParticipant> Join(WireEngine& engine, Members& members, const std::string& name) {
    auto joined = engine.Join(
        {.domain = domain_, .reach = std::get<2>(GetParam()), .name = name, .user_data = "of=" + name + ";"}, members);
    if (!joined) ADD_FAILURE() << joined.error().ToString();
    return std::move(*joined);
  }

  const unsigned domain_ = OwnDomain();
  const std::shared_ptr<WireEngine> first_ = std::get<0>(GetParam())();
  const std::shared_ptr<WireEngine> second_ = std::get<1>(GetParam())();
  Members here_;
  Members there_;
  const std::unique_ptr<WireParticipant> writing_ = Join(*first_, here_, "writing");
  const std::unique_ptr<WireParticipant> reading_ = Join(*second_, there_, "reading");
};

TEST_P(BothEnginesTest, ValuesOfEachSizeArriveWithTheirTimeAndWriterAndTheLatchedOnesLate) {
  const WireEndpointOptions topic{
      .topic = "rt/octets", .type = "bench::Octets", .qos = {.is_latched = true, .depth = 4}, .user_data = "hash=2;"};
  constexpr std::size_t kSizes[] = {8, 129, 70'000, 6'220'804};
  const auto make = [](std::size_t size) {
    auto octets = std::make_shared<Octets>(size);
    for (std::size_t i = 4; i < size; ++i) (*octets)[i] = std::byte(i * 31 + i / 256);
    (*octets)[1] = std::byte{1};
    return octets;
  };
  std::mutex mutex;
  std::vector<Octets> come;
  std::vector<std::int64_t> times;
  std::vector<std::uint64_t> writers;
  auto writer = writing_->MakeWriter(topic, {});
  ASSERT_TRUE(writer) << writer.error().ToString();
  ASSERT_TRUE((*writer)->Write(make(kSizes[0]), 1'700'000'000'000'000'000));
  const auto reader = reading_->MakeReader(topic,
                                           [&](const WireSample& sample) {
                                             const std::lock_guard lock(mutex);
                                             come.emplace_back(sample.octets.begin(), sample.octets.end());
                                             times.push_back(sample.source_time);
                                             writers.push_back(sample.writer);
                                           },
                                           {});
  ASSERT_TRUE(reader) << reader.error().ToString();
  for (std::size_t i = 0; i < std::size(kSizes); ++i) {
    if (i > 0) {
      ASSERT_TRUE((*writer)->Write(make(kSizes[i]), 1'700'000'000'000'000'000));
    }
    WaitUntil("the value is there", [&] {
      const std::lock_guard lock(mutex);
      return come.size() > i;
    });
    const std::lock_guard lock(mutex);
    const auto sent = make(kSizes[i]);
    ASSERT_GE(come[i].size(), sent->size());  // up to three octets follow
    ASSERT_LT(come[i].size(), sent->size() + 4);
    EXPECT_TRUE(std::equal(sent->begin() + 4, sent->end(), come[i].begin() + 4)) << sent->size();
    EXPECT_NEAR(static_cast<double>(times[i] - 1'700'000'000'000'000'000), 0, 1.0);
  }
  // The writer is known by name, policies and user data, and goes.
  const WireId id = (*writer)->id();
  const auto is_writer = [&](const WireEndpoint& each) {
    return each.id == id && each.handle == writers[0] && each.options.topic == topic.topic &&
           each.options.type == topic.type && each.options.user_data == topic.user_data &&
           each.options.qos.is_latched && each.options.qos.is_reliable && each.participant == writing_->id();
  };
  WaitUntil("the writer is known", [&] { return std::ranges::any_of(there_.endpoints(), is_writer); });
  WaitUntil("the member is known", [&] {
    return std::ranges::any_of(there_.members(), [&](const WireMember& each) {
      return each.id == writing_->id() && each.user_data == "of=writing;";
    });
  });
  writer->reset();
  WaitUntil("the writer has gone", [&] {
    return std::ranges::none_of(there_.endpoints(), [&](const WireEndpoint& each) { return each.id == id; });
  });
}

TEST_P(BothEnginesTest, OfExclusiveWritersTheStrongestCounts) {
  const WireEndpointOptions topic{.topic = "rt/command", .type = "numbers::Four", .qos = {.is_exclusive = true}};
  const auto with_strength = [&](std::int32_t strength) {
    WireEndpointOptions options = topic;
    options.qos.strength = strength;
    return options;
  };
  Arrived arrived;
  Arrived weak_matches;
  Arrived strong_matches;
  const auto reader = reading_->MakeReader(topic, arrived.Taker(), {});
  const auto weak = std::move(*writing_->MakeWriter(with_strength(1), weak_matches.Counter()));
  auto strong = std::move(*writing_->MakeWriter(with_strength(5), strong_matches.Counter()));
  const auto is_matched = [](const Arrived& all) { return all.matched == 1; };
  weak_matches.WaitFor(is_matched);
  strong_matches.WaitFor(is_matched);
  WaitUntil("the strong one counts", [&] {
    EXPECT_TRUE(strong->Write(Four(5), 1));
    const std::lock_guard lock(arrived.mutex);
    return !arrived.values.empty() && arrived.values.back() == 5;
  });
  EXPECT_TRUE(weak->Write(Four(1), 2));
  EXPECT_TRUE(strong->Write(Four(6), 3));
  arrived.WaitFor([](const Arrived& all) { return all.values.back() == 6; });
  EXPECT_THAT(arrived.values, testing::Not(testing::Contains(1)));
  strong.reset();
  WaitUntil("the weak one has its turn", [&] {
    EXPECT_TRUE(weak->Write(Four(2), 4));
    const std::lock_guard lock(arrived.mutex);
    return arrived.values.back() == 2;
  });
}

// Whoever comes late gets what is new, and not what is too old.
TEST_P(BothEnginesTest, WhatIsOlderThanItsLifespanIsNotDelivered) {
  constexpr auto kLifespan = std::chrono::milliseconds(500);
  const auto now = [] { return std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count(); };
  WireEndpointOptions topic{.topic = "rt/lasting", .type = "numbers::Four", .qos = {.is_latched = true, .depth = 8}};
  topic.qos.lifespan = kLifespan;
  const auto writer = std::move(*writing_->MakeWriter(topic, {}));
  ASSERT_TRUE(writer->Write(Four(1), now()));
  std::this_thread::sleep_for(2 * kLifespan);
  Arrived arrived;
  topic.qos.lifespan = {};
  const auto reader = reading_->MakeReader(topic, arrived.Taker(), {});
  WaitUntil("one has come", [&] {
    EXPECT_TRUE(writer->Write(Four(2), now()));
    const std::lock_guard lock(arrived.mutex);
    return !arrived.values.empty();
  });
  const std::lock_guard lock(arrived.mutex);
  EXPECT_THAT(arrived.values, testing::Each(2));
}

INSTANTIATE_TEST_SUITE_P(CycloneToFast, BothEnginesTest,
                         testing::Combine(testing::Values(&MakeCycloneWire), testing::Values(&MakeFastWire),
                                          testing::Values(WireReach::kLoopback, WireReach::kMachine)));
INSTANTIATE_TEST_SUITE_P(FastToCyclone, BothEnginesTest,
                         testing::Combine(testing::Values(&MakeFastWire), testing::Values(&MakeCycloneWire),
                                          testing::Values(WireReach::kLoopback, WireReach::kMachine)));

}  // namespace
}  // namespace runnel::test
