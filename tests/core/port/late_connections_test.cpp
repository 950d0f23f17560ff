#include "core/paths/late_connections.h"

#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class LateConnectionsTest : public PortTest {
 protected:
  template <typename T>
  Sender<T>& Plug(const std::string& name) {
    auto& sender = MakeSender<T>(name);
    EXPECT_TRUE(runtime.MakeReady(sender));
    return sender;
  }
  [[nodiscard]] const LateConnection& Only() {
    EXPECT_EQ(late().all().size(), 1u);
    return late().all().front();
  }
  [[nodiscard]] LateConnections& late() { return LateConnections::Of(runtime); }
};

TEST_F(LateConnectionsTest, ItIsMadeWhenTheSecondEndAppearsAndAgainAfterOneWent) {
  auto& receiver = MakeReceiver<double>();
  ASSERT_TRUE(late().Add("/driver/out", "/receiver/in", {.queue = 4}));
  EXPECT_THAT(Only().waits_for.value_or(""), HasSubstr("there is no 'driver'"));
  auto& driver = Plug<double>("driver");
  EXPECT_FALSE(Only().waits_for);
  driver.out.Publish(1.0);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(1.0));
  ASSERT_TRUE(runtime.Delete(driver));
  EXPECT_TRUE(Only().waits_for);
  EXPECT_FALSE(receiver.in.Read());
  Plug<double>("driver").out.Publish(2.0);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(2.0));
}

TEST_F(LateConnectionsTest, OneThatSomebodyDisconnectsIsNotMadeAgain) {
  auto& sender = Plug<double>("driver");
  auto& receiver = MakeReceiver<double>();
  EXPECT_THAT(late().all(), IsEmpty());
  Connect(sender.out, receiver.in, {.when_present = true});
  EXPECT_FALSE(Only().waits_for);
  ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
  EXPECT_THAT(late().all(), IsEmpty());
  Plug<double>("another");
  EXPECT_THAT(receiver.in.incoming(), IsEmpty());
}

TEST_F(LateConnectionsTest, OneOfAPortOfAnotherApplicationGoesWithItsInput) {
  auto& receiver = MakeReceiver<double>();
  ASSERT_TRUE(late().Add("//robot/pose", "/receiver/in", {.part = "x"}));
  EXPECT_EQ(Only().SourceText(), "//robot/pose.x");
  EXPECT_THAT(Only().waits_for.value_or(""), HasSubstr("there is no network"));
  EXPECT_FALSE(late().Add("//robot/pose", "/receiver/in", {}));
  ASSERT_TRUE(runtime.Delete(receiver));
  MakeReceiver<double>("another");
  EXPECT_THAT(late().all(), IsEmpty());
}

TEST_F(LateConnectionsTest, ChangesThatBelongTogetherAreLookedAtTogether) {
  auto& receiver = MakeReceiver<double>();
  EXPECT_THAT(late().all(), IsEmpty());
  {
    auto& sender = Plug<double>("driver");
    Connect(sender.out, receiver.in, {.when_present = true});
    const ChangeScope all_at_once(runtime);
    // As a plan removes a module: its connections first.
    ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
    auto taken = runtime.Unlist(sender);
    ASSERT_TRUE(taken);
    EXPECT_EQ(late().all().size(), 1u);
    ASSERT_TRUE(runtime.List(std::move(*taken)));
    Connect(sender.out, receiver.in, {.when_present = true});
  }
  EXPECT_FALSE(Only().waits_for);
}

TEST_F(LateConnectionsTest, TheyGoWithTheirApplication) {
  auto& application = runtime.Create<Box>(runtime.root(), "application");
  ASSERT_TRUE(late().Add("/application/a/out", "/application/b/in", {}));
  ASSERT_TRUE(late().Add("/application/a/out", "/other/b/in", {}));
  ASSERT_TRUE(runtime.Delete(application));
  EXPECT_EQ(Only().to, "/other/b/in");
}

TEST_F(LateConnectionsTest, WhatStandsAgainstItIsTold) {
  MakeReceiver<std::string>();
  ASSERT_TRUE(late().Add("/driver/out", "/receiver/in", {.convert = "parse"}));
  Plug<double>("driver");
  EXPECT_THAT(Only().waits_for.value_or(""), HasSubstr("carries double"));
  EXPECT_FALSE(late().Add("/driver/out", "/receiver/in", {.convert = "parse"}));
  EXPECT_TRUE(late().Remove("/driver/out", "/receiver/in"));
  EXPECT_FALSE(late().Remove("/driver/out", "/receiver/in"));
}

TEST_F(LateConnectionsTest, RemovingDisconnects) {
  auto& sender = Plug<double>("driver");
  auto& receiver = MakeReceiver<double>();
  ASSERT_TRUE(late().Add("/driver/out", "/receiver/in", {}));
  sender.out.Publish(1.0);
  EXPECT_EQ(receiver.in.Get(), 1.0);
  EXPECT_TRUE(late().Remove("/driver/out", "/receiver/in"));
  EXPECT_THAT(sender.out.outgoing(), IsEmpty());
}

}  // namespace
}  // namespace runnel::test
