// How calls end that are not answered, and what survives: time-outs, full queues, swaps, faults, deletion.

#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

TEST_F(ServiceTest, WithoutAServerNothingIsCalled) {
  Must({DisconnectPorts{"/app/server/twice", "/app/asker/twice"}});
  EXPECT_EQ(asker().Ask(1), CallStatus::kNotConnected);
  EXPECT_FALSE(asker().twice.is_connected());
  EXPECT_EQ(asker().twice.Begin(1).outcome().status(), CallStatus::kNotConnected);
}

TEST_F(ServiceTest, AFullQueueSaysSo) {
  for (int i = 0; i < 4; ++i) ASSERT_EQ(asker().Ask(i), CallStatus::kPending);
  EXPECT_EQ(asker().Ask(5), CallStatus::kBusy);
  Steps(1);
  EXPECT_THAT(asker().told, SizeIs(4));
  EXPECT_EQ(asker().Ask(5), CallStatus::kPending);
}

TEST_F(ServiceTest, AsManyCallsAsTheClientHasPlacesFor) {
  std::vector<CallFuture<int(int)>> kept;
  for (int i = 0; i < 8; ++i) {
    kept.push_back(asker().twice.Begin(i));
    Steps(1);
  }
  EXPECT_EQ(asker().Ask(1), CallStatus::kBusy) << "eight answers are held";
  kept.pop_back();
  EXPECT_EQ(asker().Ask(1), CallStatus::kPending);
}

TEST_F(ServiceTest, TimesOutOnTheApplicationsClock) {
  ASSERT_TRUE(scheduler.SetPaused("/app/server", true));
  asker().Ask(1);
  Steps(10);
  EXPECT_THAT(asker().told, IsEmpty());
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("timed_out: timed_out"));
  ASSERT_TRUE(scheduler.SetPaused("/app/server", false));
  Steps(2);
  EXPECT_EQ(server().served, 0) << "nobody wants it any more";
  EXPECT_EQ(server().twice.state().failed, 1u);
}

TEST_F(ServiceTest, CallsThatWaitSurviveASwapOfTheServer) {
  asker().Ask(5);
  Must({ReplaceModule{"/app/server", "test/triple_server"}});
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("15"));
  asker().Ask(6);
  Must({ReplaceModule{"/app/server", "test/server"}});
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("15", "12"));
}

TEST_F(ServiceTest, CallsSurviveASwapOfTheServerTwiceInARow) {
  asker().Ask(5);
  for (int i = 0; i < 3; ++i) Must({ReplaceModule{"/app/server", "test/triple_server"}});
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("15"));
}

TEST_F(ServiceTest, RenamingTheServerKeepsItsCalls) {
  asker().Ask(5);
  Must({RenameElement{"/app/server", "other"}});
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("10"));
}

TEST_F(ServiceTest, ADeletedServerEndsItsCalls) {
  asker().Ask(5);
  auto future = asker().repeat.Begin("x", 1);
  Must({DeleteElement{"/app/server"}});
  EXPECT_EQ(future.outcome().status(), CallStatus::kDisconnected);
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre(HasSubstr("disconnected")));
  EXPECT_EQ(asker().Ask(5), CallStatus::kNotConnected);
}

TEST_F(ServiceTest, DisconnectingEndsWhatHasNotBegun) {
  ASSERT_TRUE(scheduler.SetPaused("/app/server", true));
  asker().Ask(5);
  Must({DisconnectPorts{"/app/server/twice", "/app/asker/twice"}});
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre(HasSubstr("disconnected")));
}

TEST_F(ServiceTest, ConnectedToAnotherServerTheCallsToTheFirstEnd) {
  ASSERT_TRUE(scheduler.SetPaused("/app/server", true));
  asker().Ask(5);
  Must({CreateModule{"/app/second", "test/triple_server"}, DisconnectPorts{"/app/server/twice", "/app/asker/twice"}});
  Must({ConnectPorts{"/app/second/twice", "/app/asker/twice"}});
  asker().Ask(6);
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre(HasSubstr("disconnected"), "18"));
}

TEST_F(ServiceTest, AHandlerThatThrowsIsTheModulesFaultAndEndsAllItsCalls) {
  asker().Ask(5000);
  asker().Ask(1);
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("faulted: is too much", "faulted: is too much"));
  EXPECT_EQ(asker().Ask(1), CallStatus::kFaulted) << "the module stands still";
}

TEST_F(ServiceTest, AServerThatThrowsInItsUpdateEndsItsCallsAndServesAgainWhenMadeAnew) {
  server().throws_in_update = true;
  Steps(1);
  EXPECT_EQ(asker().Ask(1), CallStatus::kFaulted);
  Must({ReplaceModule{"/app/server", "test/server"}});
  Steps(1);
  EXPECT_EQ(asker().Ask(1), CallStatus::kPending);
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("2"));
}

TEST_F(ServiceTest, ASwappedOrDeletedCallerLeavesNothingBehind) {
  asker().Ask(5);
  Must({ReplaceModule{"/app/asker", "test/asker"}});
  Steps(2);
  EXPECT_THAT(asker().told, IsEmpty()) << "who has asked is gone";
  asker().Ask(6);
  auto& left = server();
  Must({DeleteElement{"/app/asker"}});
  Steps(1);
  EXPECT_EQ(left.twice.state().waiting, 0u);
}

TEST_F(ServiceTest, AOneWayCallIsServedAfterItsCallerHasGone) {
  asker().twice.Send(1);
  Must({DeleteElement{"/app/asker"}});
  Steps(1);
  EXPECT_EQ(server().served, 1);
}

TEST_F(ServiceTest, ADroppedFutureIsGivenUp) {
  { auto future = asker().twice.Begin(1); }
  Steps(1);
  EXPECT_EQ(server().served, 0);
}

}  // namespace
}  // namespace runnel::test
