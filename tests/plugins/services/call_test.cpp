// Calls that are answered: one way, by a callback, by a future, waited for.

#include <thread>

#include "core/base/check.h"
#include "core/port/cycle.h"
#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

TEST_F(ServiceTest, ACallbackComesInTheCallersCycle) {
  EXPECT_EQ(asker().Ask(21), CallStatus::kPending);
  EXPECT_THAT(asker().told, IsEmpty()) << "nobody has run yet";
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("42")) << "the server runs first, along the connection";
  EXPECT_EQ(server().served, 1);
}

TEST_F(ServiceTest, CallsOfACycleAreAnsweredInTheNext) {
  asker().action = [](Asker& asker) {
    if (asker.told.empty()) asker.Ask(1);
  };
  Steps(1);
  EXPECT_THAT(asker().told, IsEmpty());
  asker().action = [](Asker&) {};
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("2"));
}

TEST_F(ServiceTest, AnswersComeInTheOrderOfCalls) {
  for (const int value : {1, -1, 2, 3}) asker().Ask(value);
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("2", "failed: is negative", "4", "6"));
}

TEST_F(ServiceTest, OneWayIsServedAndItsPlaceUsedAgain) {
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 4; ++i) ASSERT_EQ(asker().twice.Send(i), CallStatus::kPending);
    Steps(1);
  }
  EXPECT_EQ(server().served, 40);
  EXPECT_EQ(server().twice.state().answered, 40u);
}

TEST_F(ServiceTest, AFutureIsDoneWhenTheServerHasRun) {
  auto future = asker().repeat.Begin("ab", 3);
  EXPECT_FALSE(future.is_done());
  Steps(1);
  ASSERT_TRUE(future.is_done());
  EXPECT_EQ(*future.outcome(), "ababab");
}

TEST_F(ServiceTest, NoArgumentsAndNoReply) {
  server().served = 3;
  auto future = asker().reset.Begin();
  Steps(1);
  EXPECT_TRUE(future.outcome());
  EXPECT_EQ(server().served, 0);
}

TEST_F(ServiceTest, WaitingInACycleIsRefused) {
  auto future = asker().twice.Begin(1);
  const OwnCycle cycle(runtime.clock().Now());
  EXPECT_THROW(future.Wait(), ProgrammingError);
}

TEST_F(ServiceTest, ManyAskOneServer) {
  Must({CreateModule{"/app/other", "test/asker"}, ConnectPorts{"/app/server/twice", "/app/other/twice"}});
  asker().Ask(1);
  At<Asker>("/app/other").Ask(2);
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("2"));
  EXPECT_THAT(At<Asker>("/app/other").told, ElementsAre("4"));
}

TEST_F(ServiceTest, AClientAsksOneServer) {
  Must({CreateModule{"/app/second", "test/server"}});
  EXPECT_THAT(Refusal({ConnectPorts{"/app/second/twice", "/app/asker/twice"}}), HasSubstr("a client asks one service"));
}

TEST_F(ServiceTest, AWrongPairIsToldWithItsTypes) {
  Must({DisconnectPorts{"/app/server/twice", "/app/asker/twice"}});
  EXPECT_THAT(Refusal({ConnectPorts{"/app/server/repeat", "/app/asker/twice"}}),
              testing::AllOf(HasSubstr("service string(string, int"), HasSubstr("service int")));
}

TEST_F(ServiceTest, ThroughTheInterfacePortOfAGroup) {
  Must({CreateGroup{"/app/group"}, CreateModule{"/app/group/asker", "test/asker"},
        CreatePort{"/app/group/twice", Port::Direction::kInput, server().twice.port().type().name()},
        ConnectPorts{"/app/server/twice", "/app/group/twice"},
        ConnectPorts{"/app/group/twice", "/app/group/asker/twice"}});
  At<Asker>("/app/group/asker").Ask(5);
  Steps(1);
  EXPECT_THAT(At<Asker>("/app/group/asker").told, ElementsAre("10"));
}

TEST_F(ServiceTest, AServiceThatComesLaterIsConnectedThen) {
  Must({DisconnectPorts{"/app/server/twice", "/app/asker/twice"},
        ConnectPorts{"/app/later/twice", "/app/asker/twice", {.when_present = true}}});
  EXPECT_EQ(asker().Ask(1), CallStatus::kNotConnected);
  Must({CreateModule{"/app/later", "test/triple_server"}});
  EXPECT_EQ(asker().Ask(1), CallStatus::kPending);
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre("3"));
  Must({DeleteElement{"/app/later"}});
  EXPECT_EQ(asker().Ask(1), CallStatus::kNotConnected);
}

TEST_F(ServiceTest, WhatComesOfCallsIsPublished) {
  using Record = CallRecord<int(int)>;
  const auto& type = TypeOf<Record>();
  EXPECT_TRUE(type.is_transparent());
  auto& records = At<Output<Record>>("/app/server/output/twice_calls");
  Input<Record> input(At<Group>("/app"), "records");
  ASSERT_TRUE(Port::Connect(records, input, {.queue = 10}));
  asker().Ask(4);
  asker().Ask(-4);
  Steps(1);
  std::vector<std::string> seen;
  input.Drain([&](const auto& record) { seen.push_back(TextOf(*record)); });
  EXPECT_THAT(seen, ElementsAre("{number: 1, status: answered, begun: 0s, asked_to_end: 0s, arguments: {argument1: 4}, "
                                "reply: 8, error: \"\"}",
                                HasSubstr("status: failed, begun: 0s, asked_to_end: 0s, arguments: {argument1: -4}")));
}

}  // namespace
}  // namespace runnel::test
