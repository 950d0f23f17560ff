#include "core/port/proxy_port.h"

#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ProxyPortTest : public PortTest {
 protected:
  ProxyPort& MakeProxy(const std::string& name, Port::Direction direction = Port::Direction::kInput) {
    return runtime.Create<ProxyPort>(runtime.root(), name, direction, TypeOf<Scan>(), "passes on");
  }
};

TEST_F(ProxyPortTest, ReaderBehindTwoGroupsLooksAtTheWritersObject) {
  auto& sender = MakeSender<Scan>();
  auto& leaving = MakeProxy("leaving", Port::Direction::kOutput);
  auto& entering = MakeProxy("entering", Port::Direction::kInput);
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, leaving);
  Connect(leaving, entering);
  Connect(entering, receiver.in);
  auto loan = sender.out.Loan();
  const Scan* const written = &*loan;
  sender.out.Publish(std::move(loan));
  EXPECT_EQ(&*receiver.in.Read(), written);
  EXPECT_THAT(sender.out.Sinks(), ElementsAre(&receiver.in));
  EXPECT_THAT(receiver.in.Sources(), ElementsAre(&sender.out));
  EXPECT_THAT(entering.Sources(), ElementsAre(&sender.out));
  EXPECT_THAT(leaving.Sinks(), ElementsAre(&receiver.in));
}

TEST_F(ProxyPortTest, OrderOfConnectingDoesNotMatter) {
  auto& sender = MakeSender<Scan>();
  auto& first = MakeProxy("first");
  auto& second = MakeProxy("second");
  auto& receiver = MakeReceiver<Scan>();
  Connect(second, receiver.in, {.queue = 2});
  Connect(sender.out, first);
  sender.out.Publish(Scan{{}, 1});
  EXPECT_FALSE(receiver.in.Read());
  Connect(first, second);  // closes the way
  EXPECT_EQ(receiver.in.Read()->number, 1);
  EXPECT_EQ(receiver.in.Take()->number, 1);
}

TEST_F(ProxyPortTest, OpeningTheWayAnywhereEndsTheFlow) {
  auto& sender = MakeSender<Scan>();
  auto& first = MakeProxy("first");
  auto& second = MakeProxy("second");
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, first);
  Connect(first, second);
  Connect(second, receiver.in);
  ASSERT_TRUE(Port::Disconnect(first, second));
  sender.out.Publish(Scan{});
  EXPECT_FALSE(receiver.in.Read());
  EXPECT_THAT(receiver.in.Sources(), IsEmpty());
  Connect(first, second);
  EXPECT_TRUE(receiver.in.Read());
  ASSERT_TRUE(runtime.Delete(second));
  EXPECT_FALSE(receiver.in.Read());
}

TEST_F(ProxyPortTest, LongestQueueOnTheWayCounts) {
  auto& sender = MakeSender<Scan>();
  auto& proxy = MakeProxy("proxy");
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, proxy, {.queue = 3, .on_full = OnFull::kRefuse});
  Connect(proxy, receiver.in, {.queue = 1});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(sender.out.Publish(Scan{}), PublishStatus::kPublished);
  EXPECT_EQ(sender.out.Publish(Scan{}), PublishStatus::kRefused);
}

TEST_F(ProxyPortTest, OfTwoWaysFromOneSourceTheLongerQueueCountsAndEachValueComesOnce) {
  auto& sender = MakeSender<Scan>();
  auto& proxy = MakeProxy("proxy");
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in);
  Connect(sender.out, proxy);
  Connect(proxy, receiver.in, {.queue = 4});
  for (int i = 1; i <= 3; ++i) sender.out.Publish(Scan{{}, i});
  std::vector<int> numbers;
  receiver.in.Drain([&](const Lease<Scan>& scan) { numbers.push_back(scan->number); });
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3));
  ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
  sender.out.Publish(Scan{{}, 4});
  EXPECT_EQ(receiver.in.Take()->number, 4);
}

TEST_F(ProxyPortTest, GathersAndSpreadsWhatSeveralSend) {
  auto& a = MakeSender<Scan>("a");
  auto& b = MakeSender<Scan>("b");
  auto& proxy = MakeProxy("proxy");
  auto& first = MakeReceiver<Scan>("first");
  auto& second = MakeReceiver<Scan>("second");
  Connect(a.out, proxy);
  Connect(b.out, proxy);
  Connect(proxy, first.in);
  Connect(proxy, second.in);
  a.out.Publish(Scan{{}, 1});
  EXPECT_EQ(first.in.Read()->number, 1);
  b.out.Publish(Scan{{}, 2});
  EXPECT_EQ(first.in.Read()->number, 2);
  EXPECT_EQ(second.in.Read()->number, 2);
}

TEST_F(ProxyPortTest, ViewersSeeWhatPassesThrough) {
  auto& sender = MakeSender<Scan>();
  auto& proxy = MakeProxy("proxy");
  Connect(sender.out, proxy);
  int seen = 0;
  const auto look = [&](const void* value, Time) { seen = static_cast<const Scan*>(value)->number; };
  EXPECT_FALSE(proxy.VisitLatest(look));
  sender.out.Publish(Scan{{}, 3});
  EXPECT_TRUE(proxy.VisitLatest(look));
  EXPECT_EQ(seen, 3);
  EXPECT_EQ(proxy.description(), "passes on");
}

TEST_F(ProxyPortTest, TypesMustAgreeAtEachStretch) {
  auto& sender = MakeSender<int>();
  EXPECT_FALSE(Port::Connect(sender.out, MakeProxy("proxy")));
}

}  // namespace
}  // namespace runnel::test
