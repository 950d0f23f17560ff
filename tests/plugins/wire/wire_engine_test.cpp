// What each engine behind the seam does, the fake of the tests as well as those that go over a network.

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "plugins/wire/octet_pool.h"
#include "plugins/wire_shared_memory/shared_memory_wire.h"
#include "tests/plugins/wire/wire_ends.h"
#include "tests/support/fake_wire.h"
#include "tests/support/own_network.h"
#include "tests/support/wait_until.h"
#ifdef RUNNEL_HAS_CYCLONE
#include "plugins/wire_cyclone/cyclone_wire.h"
#endif
#ifdef RUNNEL_HAS_FAST
#include "plugins/wire_fast/fast_wire.h"
#endif

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using MakeEngine = std::shared_ptr<WireEngine> (*)();

class WireEngineTest : public testing::TestWithParam<MakeEngine> {
 protected:
  std::unique_ptr<WireParticipant> Join(Members& members, const std::string& name = "") {
    auto joined = engine_->Join({.domain = domain_, .name = name, .user_data = "of=" + name + ";"}, members);
    if (!joined) ADD_FAILURE() << joined.error().ToString();
    return std::move(*joined);
  }
  static WireEndpointOptions Topic(const WireQos& qos = {}, const std::string& type = "numbers::Four") {
    return {.topic = "rt/four", .type = type, .qos = qos, .user_data = "hash=1;"};
  }

  const unsigned domain_ = OwnDomain();  // before the engine's threads
  const std::shared_ptr<WireEngine> engine_ = GetParam()();
  Members here_;
  Members there_;
  const std::unique_ptr<WireParticipant> a_ = Join(here_, "a");
  const std::unique_ptr<WireParticipant> b_ = Join(there_, "b");
};

TEST_P(WireEngineTest, AValueArrivesWithItsTimeAndWriterOnceBothHaveMatched) {
  Arrived arrived;
  Arrived written;
  const auto reader = b_->MakeReader(Topic(), arrived.Taker(), arrived.Counter());
  const auto writer = a_->MakeWriter(Topic(), written.Counter());
  ASSERT_TRUE(reader && writer);
  written.WaitFor([](const Arrived& all) { return all.matched == 1; });
  arrived.WaitFor([](const Arrived& all) { return all.matched == 1; });
  ASSERT_TRUE((*writer)->Write(Four(7), 1'700'000'000'123'456'000));
  arrived.WaitFor([](const Arrived& all) { return !all.values.empty(); });
  EXPECT_THAT(arrived.values, ElementsAre(7));
  // The wire counts in 2^-32 s.
  EXPECT_NEAR(static_cast<double>(arrived.times[0] - 1'700'000'000'123'456'000), 0, 1.0);
  const auto known = there_.endpoints();
  EXPECT_TRUE(std::ranges::any_of(known, [&](const WireEndpoint& each) {
    return each.id == (*writer)->id() && each.handle == arrived.writers[0];
  }));
}

// There is no memory for a moment: that is lost, and the next value comes.
TEST_P(WireEngineTest, WhoThrowsWhenCalledBackEndsNothing) {
  const auto throws = [](std::size_t) { throw std::bad_alloc(); };
  std::atomic<int> come{0};
  const auto take = [&](const WireSample&) {
    if (++come == 1) throw std::bad_alloc();
  };
  const auto reader = b_->MakeReader(Topic(), take, throws);
  const auto writer = a_->MakeWriter(Topic(), throws);
  ASSERT_TRUE(reader && writer);
  WaitUntil("another one has come", [&] {
    EXPECT_TRUE((*writer)->Write(Four(1), 1));
    return come >= 2;
  });
}

/// Throws each time it is told of an endpoint of somebody else.
struct Forgetful final : WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint& endpoint) override {
    if (!endpoint.is_own && ++told > 0) throw std::bad_alloc();
  }
  void OnEndpointGone(const WireId&) override {}
  void OnMissed() noexcept override { ++missed; }
  std::atomic<int> told{0}, missed{0};
};

TEST_P(WireEngineTest, WhoThrowsWhenToldOfAnEndpointEndsNothing) {
  Forgetful forgetful;
  const auto c = engine_->Join({.domain = domain_, .name = "c"}, forgetful);
  ASSERT_TRUE(c);
  Arrived arrived;
  const auto reader = (*c)->MakeReader(Topic(), arrived.Taker(), {});
  const auto writer = a_->MakeWriter(Topic(), {});
  ASSERT_TRUE(reader && writer);
  WaitUntil("a value has come", [&] {
    EXPECT_TRUE((*writer)->Write(Four(1), 1));
    const std::lock_guard lock(arrived.mutex);
    return !arrived.values.empty();
  });
  EXPECT_GT(forgetful.told, 0);
  WaitUntil("it is told that it has missed something", [&] { return forgetful.missed > 0; });
}

TEST_P(WireEngineTest, EachIsToldWhoIsThereAndWhoHasGone) {
  Arrived nothing;
  auto writer = a_->MakeWriter(Topic({.is_reliable = false, .depth = 5}), {});
  ASSERT_TRUE(writer);
  const auto find = [&]() -> std::optional<WireEndpoint> {
    for (const WireEndpoint& each : there_.endpoints()) {
      if (each.id == (*writer)->id()) return each;
    }
    return {};
  };
  WaitUntil("the writer is known", [&] { return find().has_value(); });
  const WireEndpoint seen = *find();
  EXPECT_TRUE(seen.is_writer);
  EXPECT_FALSE(seen.is_own);
  EXPECT_EQ(seen.participant, a_->id());
  EXPECT_EQ(seen.options.topic, "rt/four");
  EXPECT_EQ(seen.options.type, "numbers::Four");
  EXPECT_EQ(seen.options.user_data, "hash=1;");
  EXPECT_FALSE(seen.options.qos.is_reliable);
  WaitUntil("the member is known", [&] {
    return std::ranges::any_of(there_.members(), [&](const WireMember& each) {
      return each.id == a_->id() && each.name == "a" && each.user_data == "of=a;";
    });
  });
  const WireId id = (*writer)->id();
  *writer = nullptr;
  WaitUntil("the writer has gone", [&] {
    return std::ranges::none_of(there_.endpoints(), [&](const WireEndpoint& each) { return each.id == id; });
  });
}

TEST_P(WireEngineTest, WhoComesLateGetsWhatIsLatched) {
  const WireQos latched{.is_latched = true};
  const auto writer = a_->MakeWriter(Topic(latched), {});
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*writer)->Write(Four(1), 1));
  ASSERT_TRUE((*writer)->Write(Four(2), 2));
  Arrived arrived;
  const auto reader = b_->MakeReader(Topic(latched), arrived.Taker(), {});
  arrived.WaitFor([](const Arrived& all) { return !all.values.empty(); });
  EXPECT_THAT(arrived.values, ElementsAre(2));
}

TEST_P(WireEngineTest, AWriterTellsWhichReadersAreMatched) {
  const auto writer = a_->MakeWriter(Topic(), {});
  auto reader = b_->MakeReader(Topic(), [](const WireSample&) {}, {});
  const auto other = b_->MakeReader({.topic = "rt/other", .type = "numbers::Four"}, [](const WireSample&) {}, {});
  ASSERT_TRUE(writer && reader && other);
  const auto handle_of = [&](const WireId& id) {
    std::uint64_t handle = 0;
    WaitUntil("it is known", [&] {
      for (const WireEndpoint& each : here_.endpoints()) handle = each.id == id ? each.handle : handle;
      return handle != 0;
    });
    return handle;
  };
  const std::uint64_t matched = handle_of((*reader)->id());
  WaitUntil("it is matched", [&] { return (*writer)->HasReader(matched); });
  EXPECT_FALSE((*writer)->HasReader(handle_of((*other)->id())));
  reader->reset();
  WaitUntil("it has gone", [&] { return !(*writer)->HasReader(matched); });
}

TEST_P(WireEngineTest, OthersOfAnotherTypeOrQosDoNotMatch) {
  Arrived other_type;
  Arrived asks_for_more;
  Arrived fits;
  Members others;
  const auto c = Join(others, "c");  // one member may be bound to have one type of a topic
  const auto first = c->MakeReader(Topic({}, "numbers::Five"), other_type.Taker(), other_type.Counter());
  const auto second = b_->MakeReader(Topic(), asks_for_more.Taker(), asks_for_more.Counter());
  const auto third = b_->MakeReader(Topic({.is_reliable = false}), fits.Taker(), fits.Counter());
  const auto writer = a_->MakeWriter(Topic({.is_reliable = false}), {});
  fits.WaitFor([](const Arrived& all) { return all.matched == 1; });
  EXPECT_EQ(other_type.matched, 0u);
  EXPECT_EQ(asks_for_more.matched, 0u);
  EXPECT_THAT(QosMisfit({.is_reliable = false}, {}), HasSubstr("best effort"));
}

TEST_P(WireEngineTest, ALargeValueArrivesWhole) {
  std::mutex mutex;
  Octets large;
  Arrived written;
  const auto reader = b_->MakeReader(Topic(),
                                     [&](const WireSample& sample) {
                                       const std::lock_guard lock(mutex);
                                       large.assign(sample.octets.begin(), sample.octets.end());
                                     },
                                     {});
  const auto writer = a_->MakeWriter(Topic(), written.Counter());
  written.WaitFor([](const Arrived& all) { return all.matched == 1; });
  auto octets = std::make_shared<Octets>(1'000'004);
  for (std::size_t i = 0; i < octets->size(); ++i) (*octets)[i] = std::byte(i * 7 + i / 256);
  ASSERT_TRUE((*writer)->Write(octets, 1));
  WaitUntil("the value is there", [&] {
    const std::lock_guard lock(mutex);
    return !large.empty();
  });
  EXPECT_TRUE(large == *octets);
}

TEST_P(WireEngineTest, AParticipantDoesNotHearItself) {
  Arrived own;
  Arrived others;
  Arrived written;
  const auto mine = a_->MakeReader(Topic(), own.Taker(), {});
  const auto its = b_->MakeReader(Topic(), others.Taker(), {});
  const auto writer = a_->MakeWriter(Topic(), written.Counter());
  written.WaitFor([](const Arrived& all) { return all.matched >= 1; });
  ASSERT_TRUE((*writer)->Write(Four(3), 1));
  others.WaitFor([](const Arrived& all) { return !all.values.empty(); });
  const std::lock_guard lock(own.mutex);
  EXPECT_TRUE(own.values.empty());
}

// As a service's client and server of ROS 2's default middleware do.
TEST_P(WireEngineTest, AReplySaysToWhichRequestItBelongs) {
  const WireEndpointOptions requests{.topic = "rq/addRequest", .type = "numbers::Add_Request_"};
  const WireEndpointOptions replies{.topic = "rr/addReply", .type = "numbers::Add_Response_"};
  std::mutex mutex;
  std::vector<WireSample> asked;
  std::vector<WireSample> answered;
  const auto to = [&](std::vector<WireSample>& all) {
    return [&](const WireSample& sample) {
      const std::lock_guard lock(mutex);
      all.push_back(sample);
      all.back().octets = {};
    };
  };
  Arrived matches[4];
  const auto request_writer = std::move(*a_->MakeWriter(requests, matches[0].Counter()));
  const auto reply_reader = std::move(*a_->MakeReader(replies, to(answered), matches[1].Counter()));
  const auto request_reader = std::move(*b_->MakeReader(requests, to(asked), matches[2].Counter()));
  const auto reply_writer = std::move(*b_->MakeWriter(replies, matches[3].Counter()));
  for (Arrived& each : matches) each.WaitFor([](const Arrived& all) { return all.matched == 1; });
  const auto asking = request_writer->WriteRelated(Four(1), 1, {reply_reader->id(), 0});
  ASSERT_EQ(asking.has_value(), engine_->has_identities());
  if (!asking) return;
  WaitUntil("the request is there", [&] {
    const std::lock_guard lock(mutex);
    return !asked.empty();
  });
  EXPECT_EQ(asked[0].identity, *asking);
  EXPECT_EQ(asking->writer, request_writer->id());
  EXPECT_EQ(asked[0].related, (WireIdentity{reply_reader->id(), 0}));
  ASSERT_TRUE(reply_writer->WriteRelated(Four(2), 2, {asked[0].related.writer, asked[0].identity.number}));
  WaitUntil("the reply is there", [&] {
    const std::lock_guard lock(mutex);
    return !answered.empty();
  });
  EXPECT_EQ(answered[0].related, (WireIdentity{reply_reader->id(), asking->number}));
}

/// Those that open sockets.
class SocketEngineTest : public testing::TestWithParam<MakeEngine> {};

// Two masters of one actuator.
TEST_P(SocketEngineTest, OfExclusiveWritersTheStrongestCountsAndThenTheOther) {
  Members members;
  const unsigned domain = OwnDomain();
  const auto engine = GetParam()();
  const auto join = [&] { return std::move(*engine->Join({.domain = domain}, members)); };
  const auto reading = join();
  const auto writing = join();
  const WireEndpointOptions topic{.topic = "rt/command", .type = "numbers::Four", .qos = {.is_exclusive = true}};
  const auto with_strength = [&](std::int32_t strength) {
    WireEndpointOptions options = topic;
    options.qos.strength = strength;
    return options;
  };
  Arrived arrived;
  Arrived weak_matches;
  Arrived strong_matches;
  const auto reader = reading->MakeReader(topic, arrived.Taker(), {});
  const auto weak = std::move(*writing->MakeWriter(with_strength(1), weak_matches.Counter()));
  auto strong = std::move(*writing->MakeWriter(with_strength(5), strong_matches.Counter()));
  const auto is_matched = [](const Arrived& all) { return all.matched == 1; };
  weak_matches.WaitFor(is_matched);
  strong_matches.WaitFor(is_matched);
  ASSERT_TRUE(strong->Write(Four(5), 1));
  arrived.WaitFor([](const Arrived& all) { return all.values == std::vector<int>{5}; });
  ASSERT_TRUE(weak->Write(Four(1), 2));
  ASSERT_TRUE(strong->Write(Four(6), 3));
  arrived.WaitFor([](const Arrived& all) { return all.values.back() == 6; });
  EXPECT_THAT(arrived.values, ElementsAre(5, 6));
  strong.reset();
  WaitUntil("the weak one has its turn", [&] {
    EXPECT_TRUE(weak->Write(Four(2), 4));
    const std::lock_guard lock(arrived.mutex);
    return arrived.values.back() == 2;
  });
  EXPECT_EQ(QosText(with_strength(5).qos), "reliable, exclusive by strength 5, newest 1");
}

INSTANTIATE_TEST_SUITE_P(Fake, WireEngineTest, testing::Values(&MakeFakeWire));
INSTANTIATE_TEST_SUITE_P(SharedMemory, WireEngineTest,
                         testing::Values([] { return MakeSharedMemoryWire(MakeFakeWire()); }));
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SocketEngineTest);
#ifdef RUNNEL_HAS_CYCLONE
INSTANTIATE_TEST_SUITE_P(Cyclone, WireEngineTest, testing::Values(&MakeCycloneWire));
INSTANTIATE_TEST_SUITE_P(Cyclone, SocketEngineTest, testing::Values(&MakeCycloneWire));
#endif
#ifdef RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, WireEngineTest, testing::Values(&MakeFastWire));
INSTANTIATE_TEST_SUITE_P(Fast, SocketEngineTest, testing::Values(&MakeFastWire));
#endif

TEST(OctetPoolTest, OctetsAreUsedAgainOnceNobodyHasThem) {
  OctetPool pool;
  const Octets* first = nullptr;
  {
    const auto octets = pool.Take();
    octets->resize(1000);
    first = octets.get();
    EXPECT_NE(pool.Take().get(), first);
  }
  std::vector<std::shared_ptr<Octets>> taken = {pool.Take(), pool.Take()};
  EXPECT_TRUE(std::ranges::any_of(taken, [&](const auto& each) { return each.get() == first; }));
}

}  // namespace
}  // namespace runnel::test
