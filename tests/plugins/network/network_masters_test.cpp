// Several that write one topic: who is heard, and that it is told.
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
    robot_.WaitFor("/drive of plain does not fit: the reader takes the strongest only, and the writer says no strength");
  }
  WaitUntilHeard(plain, 3);
}

}  // namespace
}  // namespace runnel::test
