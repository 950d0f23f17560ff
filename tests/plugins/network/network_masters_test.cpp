// Several that write one topic: who is heard, and that it is told.

#include <gmock/gmock.h>

#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

OfferOptions Drive(std::optional<std::int32_t> strength = {}) {
  return {.port = "/application/module/place", .topic = "/drive", .strength = strength};
}

class NetworkMastersTest : public testing::Test {
 protected:
  void Begin(bool is_exclusive) {
    robot_.Take({.topic = "/drive", .is_exclusive = is_exclusive}, robot_.module.goal);
    robot_.Begin();
  }
  void WaitUntilHeard(Member& who, double x) {
    WaitUntil("it is heard", [&] {
      who.module.place.Publish({x, 0});
      return robot_.module.goal.Get().x == x;
    });
  }
  static void Offer(Member& who, std::optional<std::int32_t> strength = {}) {
    who.Offer(Drive(strength));
    who.Begin();
  }

  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  Member robot_{*engine_, "robot"};
};

TEST_F(NetworkMastersTest, ThatTwoAreHeardIsTold) {
  Begin(false);
  Member one(*engine_, "one");
  Offer(one);
  WaitUntilHeard(one, 1);
  EXPECT_THAT(robot_.Text(), Not(HasSubstr("TWO MASTERS")));
  {
    Member other(*engine_, "other");
    Offer(other);
    robot_.WaitFor("write it, and all of them are heard; say <take … exclusive=\"true\"/>");
    EXPECT_THAT(robot_.said(), AnyOf(HasSubstr("one and other write it"), HasSubstr("other and one write it")));
    EXPECT_THAT(robot_.Text(), HasSubstr("TWO MASTERS"));
  }
  WaitUntil("there is one", [&] { return robot_.Text().find("TWO MASTERS") == std::string::npos; });
}

TEST_F(NetworkMastersTest, OfOneNameTheyAreTwoWhenValuesOfBothCome) {
  Begin(false);
  Member one(*engine_, "planner");
  Member other(*engine_, "planner");
  Offer(one);
  Offer(other);
  for (int i = 0; i < 2; ++i) {
    WaitUntilHeard(one, 10 + i);
    WaitUntilHeard(other, 20 + i);
  }
  robot_.WaitFor("planner and planner write it, and all of them are heard");
}

TEST_F(NetworkMastersTest, OfThoseWithoutAStrengthTheFirstIsHeardThenTheNext) {
  Begin(true);
  auto first = std::make_unique<Member>(*engine_, "first");
  Offer(*first);
  WaitUntilHeard(*first, 1);
  Member next(*engine_, "next");
  Offer(next);
  WaitUntil("it is read", [&] { return IsConnected(next.module.place); });
  next.module.place.Publish({2, 0});
  WaitUntil("it is sent", [&] { return next.Text().find(", 0 sent") == std::string::npos; });
  WaitUntilQuiet(*engine_);
  EXPECT_EQ(robot_.module.goal.Get().x, 1);
  EXPECT_THAT(robot_.Text(), HasSubstr("first has it"));
  EXPECT_THAT(robot_.Text(), HasSubstr("written by next (reliable, newest 1): NOT HEARD"));
  robot_.WaitFor("first has it now");
  first.reset();
  WaitUntilHeard(next, 3);
  robot_.WaitFor("next has it now");
  EXPECT_THAT(robot_.said(), Not(HasSubstr("all of them are heard")));
}

TEST_F(NetworkMastersTest, WhoIsStartedAgainUnderItsNameHasItSoonerThanTheLeaseOfBeforeIsOver) {
  Begin(true);
  Member killed(*engine_, "planner");  // there still, as its lease is not over
  Offer(killed);
  WaitUntilHeard(killed, 1);
  robot_.WaitFor("planner has it now");
  Member again(*engine_, "planner");
  Offer(again);
  WaitUntilHeard(again, 2);
  robot_.WaitFor("planner has it now instead of planner");
}

// Those of ROS 2 are all called "/", or have no name.
class ForeignMastersTest : public NetworkMastersTest, public testing::WithParamInterface<std::string> {};

TEST_P(ForeignMastersTest, AHandThatRestsKeepsWhatItHas) {
  Begin(true);
  DiscoveryTable table{[] {}};
  const auto form = Must(ValueForm::Make(TypeOf<Place>(), "", ""));
  struct Node {
    std::unique_ptr<WireParticipant> participant;
    std::unique_ptr<WireWriter> writer;
  };
  const auto make = [&] {
    Node node{.participant = Must(engine_->Join({.name = GetParam(), .user_data = "enclave=/;"}, table)), .writer = {}};
    node.writer = Must(node.participant->MakeWriter(
        {.topic = "rt/drive", .type = form->codec->dds_type(), .user_data = form->user_data}, {}));
    return node;
  };
  const auto write = [&](Node& node, double x) {
    auto octets = std::make_shared<Octets>();
    form->codec->Encode(std::make_unique<Place>(Place{x, 0}).get(), Time(), *octets);
    ASSERT_TRUE(node.writer->Write(octets, 1));
    WaitUntilQuiet(*engine_);
  };
  Node joystick = make();
  WaitUntil("it is heard", [&] {
    write(joystick, 1);
    return robot_.module.goal.Get().x == 1;
  });
  Node navigator = make();
  // Longer than who has been started again waits.
  for (const Time begun = SteadyClock().Now(); SteadyClock().Now() - begun < std::chrono::milliseconds(1500);) {
    write(navigator, 2);
    ASSERT_EQ(robot_.module.goal.Get().x, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  joystick.writer.reset();
  WaitUntil("the other has it", [&] {
    write(navigator, 2);
    return robot_.module.goal.Get().x == 2;
  });
  const std::string name = GetParam().empty() ? "somebody" : GetParam();
  robot_.WaitFor(name + " has it now instead of " + name);
}

INSTANTIATE_TEST_SUITE_P(Names, ForeignMastersTest, testing::Values("", "/"));

// The reader is made anew as the writers that are there change, and an engine then delivers again what they keep.
TEST_F(NetworkMastersTest, WhatIsLatchedComesOnce) {
  Begin(false);
  std::optional<Member> planner(std::in_place, *engine_, "planner");
  planner->Offer({.port = "/application/module/place", .topic = "/drive", .quality = ValueQuality::kLatched});
  planner->Begin();
  planner->module.place.Publish({7, 0});
  WaitUntil("it is heard", [&] { return robot_.module.goal.Get().x == 7; });
  const auto wait_until_gone = [&](const std::string& name) {
    WaitUntil(name + " has gone", [&] { return robot_.Text().find("by " + name) == std::string::npos; });
    WaitUntilQuiet(*engine_);
  };
  {
    Member person(*engine_, "person");
    Offer(person);
    WaitUntilHeard(person, 8);
  }
  wait_until_gone("person");
  EXPECT_EQ(robot_.module.goal.Get().x, 8);
  planner->module.place.Publish({9, 0});  // once, so that none is on its way when the next one comes
  WaitUntil("it is heard", [&] { return robot_.module.goal.Get().x == 9; });
  planner.reset();
  wait_until_gone("planner");
  // Of who comes now, what it keeps is new.
  Member other(*engine_, "other");
  other.Offer({.port = "/application/module/place", .topic = "/drive", .quality = ValueQuality::kLatched});
  other.Begin();
  other.module.place.Publish({10, 0});
  WaitUntil("it is heard", [&] { return robot_.module.goal.Get().x == 10; });
}

// The engine delivers what its writer keeps again: that is a command of before the link was lost, whatever has been since.
TEST_F(NetworkMastersTest, WhatIsLatchedComesOnceThoughTheLinkToItsWriterIsLost) {
  Begin(false);
  Member planner(*engine_, "planner");
  planner.Offer({.port = "/application/module/place", .topic = "/drive", .quality = ValueQuality::kLatched});
  planner.Begin();
  planner.module.place.Publish({7, 0});
  WaitUntil("it is heard", [&] { return robot_.module.goal.Get().x == 7; });
  const auto is_known = [&] { return robot_.Text().find("by planner") != std::string::npos; };
  ProbePort all(robot_.runtime.root(), "all", TypeOf<Place>());
  ASSERT_TRUE(Port::Connect(*robot_.network->takes().front().output, all));
  while (all.Take([](const void*, ValueTimes) {})) {
  }
  for (const bool has_other_handle : {true, false}) {
    SetCutOff(*engine_, "planner", true);
    if (has_other_handle) WaitUntil("it has gone", [&] { return !is_known(); });
    SetCutOff(*engine_, "planner", false, has_other_handle);
    WaitUntil("it is there again", is_known);
    WaitUntilQuiet(*engine_);
    EXPECT_FALSE(all.Take([](const void*, ValueTimes) {}));
  }
  // What it says afterwards is new.
  SetCutOff(*engine_, "planner", true);
  planner.module.place.Publish({8, 0});
  WaitUntil("it is sent", [&] { return planner.Text().find("2 sent") != std::string::npos; });
  SetCutOff(*engine_, "planner", false);
  WaitUntil("it is heard", [&] { return robot_.module.goal.Get().x == 8; });
}

// By hand, released, or in simulated time that stands.
TEST_F(NetworkMastersTest, WhatIsLatchedAndOlderThanTheLastIsNewAllTheSameWhenALinkComesBack) {
  Begin(false);
  Member planner(*engine_, "planner");
  planner.Offer({.port = "/application/module/place", .topic = "/drive", .quality = ValueQuality::kLatched});
  planner.Begin();
  const auto is_heard = [&](double x) { WaitUntil("it is heard", [&] { return robot_.module.goal.Get().x == x; }); };
  planner.module.place.Publish({7, 0});
  is_heard(7);
  const auto set_by_hand = [&](double x) {
    return planner.module.place.PublishByHand([x](void* value) -> Result<void> {
      *static_cast<Place*>(value) = {x, 0};
      return {};
    });
  };
  ASSERT_TRUE(set_by_hand(9));
  is_heard(9);
  SetCutOff(*engine_, "planner", true);
  ASSERT_TRUE(planner.module.place.Release());
  WaitUntil("it is sent", [&] { return planner.Text().find("3 sent") != std::string::npos; });
  SetCutOff(*engine_, "planner", false);
  is_heard(7);
  // Without a loss it is not taken for what has been.
  ASSERT_TRUE(set_by_hand(11));
  is_heard(11);
  ASSERT_TRUE(planner.module.place.Release());
  is_heard(7);
}

TEST_F(NetworkMastersTest, WhoSaysAStrengthCountsMoreThanWhoSaysNone) {
  Begin(true);
  Member plain(*engine_, "plain");
  Offer(plain);
  WaitUntilHeard(plain, 1);
  {
    Member strong(*engine_, "strong");
    Offer(strong, 5);
    WaitUntilHeard(strong, 2);
    robot_.WaitFor("strong (strength 5) has it now");
    robot_.WaitFor(
        "/drive of plain does not fit: the reader takes the strongest only, and the writer says no strength");
  }
  WaitUntilHeard(plain, 3);
}

}  // namespace
}  // namespace runnel::test
