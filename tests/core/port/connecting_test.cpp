#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using ConnectingTest = PortTest;

// What a refusal says, and that it has changed nothing.
Error RefusalOf(Port& from, Port& to) {
  const auto outgoing = from.outgoing().size();
  const auto incoming = to.incoming().size();
  const auto result = Port::Connect(from, to);
  EXPECT_FALSE(result);
  EXPECT_EQ(from.outgoing().size(), outgoing);
  EXPECT_EQ(to.incoming().size(), incoming);
  return result ? Error{} : result.error();
}

TEST_F(ConnectingTest, WrongTypeIsRefusedWithBothTypesAndPaths) {
  auto& sender = MakeSender<double>();
  auto& receiver = MakeReceiver<Scan>();
  const Error error = RefusalOf(sender.out, receiver.in);
  EXPECT_EQ(error.path, "/sender/out");
  EXPECT_EQ(error.message, "carries double, but /receiver/in takes test::Scan");
}

TEST_F(ConnectingTest, WrongDirectionIsRefusedWithTheCure) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  const Error error = RefusalOf(receiver.in, sender.out);
  EXPECT_EQ(error.path, "/receiver/in");
  EXPECT_EQ(error.message, "is an input and cannot send");
  EXPECT_THAT(error.hint, HasSubstr("other way round"));
  auto& other = MakeSender<int>("other");
  EXPECT_EQ(RefusalOf(sender.out, other.out).path, "/other/out");
  auto& another = MakeReceiver<int>("another");
  EXPECT_EQ(RefusalOf(receiver.in, another.in).path, "/receiver/in");
}

TEST_F(ConnectingTest, SecondConnectionBetweenTheSameTwoIsRefused) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  EXPECT_EQ(RefusalOf(sender.out, receiver.in).message, "is connected to /receiver/in already");
}

TEST_F(ConnectingTest, PortOfAnotherRuntimeIsRefused) {
  Runtime other;
  auto& sender = MakeSender<int>();
  auto& receiver = other.Create<Receiver<int>>(other.root(), "receiver");
  EXPECT_THAT(RefusalOf(sender.out, receiver.in).message, HasSubstr("another runtime"));
}

TEST_F(ConnectingTest, PortThatIsBeingDeletedIsRefused) {
  class Connector final : public ElementListener {
   public:
    Port* from = nullptr;
    Port* to = nullptr;
    Error error;
    void OnDeleted(FrameworkElement&) override {
      const auto result = Port::Connect(*from, *to);
      if (!result) error = result.error();
    }
  } connector;
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  connector.from = &sender.out;
  connector.to = &receiver.in;
  runtime.AddListener(connector);
  ASSERT_TRUE(runtime.Delete(receiver));
  runtime.RemoveListener(connector);
  EXPECT_EQ(connector.error.path, "/receiver/in");
  EXPECT_THAT(connector.error.message, HasSubstr("being deleted"));
}

TEST_F(ConnectingTest, CircleOfInterfacePortsIsRefused) {
  const auto& type = TypeOf<int>();
  std::vector<ProxyPort*> ring;
  for (const char* name : {"a", "b", "c"}) {
    ring.push_back(&runtime.Create<ProxyPort>(runtime.root(), name, Port::Direction::kInput, type));
  }
  Connect(*ring[0], *ring[1]);
  Connect(*ring[1], *ring[2]);
  const Error error = RefusalOf(*ring[2], *ring[0]);
  EXPECT_EQ(error.path, "/c");
  EXPECT_THAT(error.message, HasSubstr("cycle"));
  EXPECT_FALSE(Port::Connect(*ring[0], *ring[0]));
}

TEST_F(ConnectingTest, QueueThatFitsNoMemoryIsAnErrorAndChangesNothing) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  const auto result = Port::Connect(sender.out, receiver.in, {.queue = SIZE_MAX / 2});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().path, "/sender/out");
  EXPECT_THAT(result.error().message, HasSubstr("/receiver/in"));
  EXPECT_THAT(sender.out.outgoing(), IsEmpty());
  EXPECT_THAT(receiver.in.incoming(), IsEmpty());
  sender.out.Publish(1);
  Connect(sender.out, receiver.in, {.queue = 2});
  EXPECT_EQ(*receiver.in.Take(), 1);
}

TEST_F(ConnectingTest, DisconnectingWhatIsNotConnectedIsAnError) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  const auto result = Port::Disconnect(sender.out, receiver.in);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "is not connected to /receiver/in");
}

TEST_F(ConnectingTest, DisconnectedInputReadsNothingAndMayBeConnectedAgain) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  sender.out.Publish(1);
  ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kNoData);
  Connect(sender.out, receiver.in);
  EXPECT_EQ(*receiver.in.Read(), 1);
  ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
  Connect(sender.out, receiver.in);
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kOld);
}

TEST_F(ConnectingTest, DeletedElementIsDisconnectedFromAll) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  ASSERT_TRUE(runtime.Delete(receiver));
  EXPECT_THAT(sender.out.outgoing(), IsEmpty());
  sender.out.Publish(1);
}

TEST_F(ConnectingTest, ListenersAreToldOfEachConnectionAndItsEnd) {
  class Journal final : public ElementListener {
   public:
    std::vector<std::string> events;
    void OnConnected(FrameworkElement& from, FrameworkElement& to) override {
      events.push_back(from.path() + " > " + to.path());
    }
    void OnDisconnected(FrameworkElement& from, FrameworkElement& to) override {
      events.push_back(from.path() + " | " + to.path());
    }
  } journal;
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  runtime.AddListener(journal);
  Connect(sender.out, receiver.in);
  ASSERT_TRUE(runtime.Delete(sender));
  runtime.RemoveListener(journal);
  EXPECT_THAT(journal.events, ElementsAre("/sender/out > /receiver/in", "/sender/out | /receiver/in"));
}

TEST_F(ConnectingTest, OptionsOfAPortCanBeAskedFor) {
  auto& receiver = MakeReceiver<int>("receiver", {.description = "what comes", .required = true, .trigger = true});
  EXPECT_EQ(receiver.in.description(), "what comes");
  EXPECT_TRUE(receiver.in.is_required());
  EXPECT_TRUE(receiver.in.is_trigger());
  EXPECT_EQ(receiver.in.direction(), Port::Direction::kInput);
  EXPECT_EQ(receiver.in.kind(), ElementKind::kPort);
  EXPECT_EQ(&receiver.in.type(), &TypeOf<int>());
}

TEST_F(ConnectingTest, WakerIsToldOfEachPublicationUntilItIsTakenOff) {
  CountingWaker waker;
  auto& sender = MakeSender<int>();
  auto& scans = MakeSender<Scan>("scans");
  auto& receiver = MakeReceiver<int>();
  auto& scan_receiver = MakeReceiver<Scan>("scan_receiver");
  receiver.in.SetWaker(&waker);  // before connecting
  Connect(sender.out, receiver.in);
  sender.out.Publish(1);
  EXPECT_EQ(waker.wakes, 1);
  Connect(scans.out, scan_receiver.in);
  scan_receiver.in.SetWaker(&waker);  // after connecting
  scans.out.Publish(Scan{});
  EXPECT_EQ(waker.wakes, 2);
  receiver.in.SetWaker(nullptr);
  sender.out.Publish(2);
  EXPECT_EQ(waker.wakes, 2);
  ASSERT_TRUE(runtime.Delete(scan_receiver));
  scans.out.Publish(Scan{});
  EXPECT_EQ(waker.wakes, 2);
}

TEST_F(ConnectingTest, WakerIsToldOfAValueThatIsThere) {
  CountingWaker waker;
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  sender.out.Publish(1);
  receiver.in.SetWaker(&waker);
  EXPECT_EQ(waker.wakes, 1);
  receiver.in.SetWaker(&waker);
  EXPECT_EQ(waker.wakes, 1);
  receiver.in.SetWaker(nullptr);
}

TEST_F(ConnectingTest, WakerIsToldOfAValueThatANewConnectionBrings) {
  CountingWaker waker;
  auto& silent = MakeSender<int>("silent");
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  receiver.in.SetWaker(&waker);
  sender.out.Publish(1);
  Connect(silent.out, receiver.in);
  EXPECT_EQ(waker.wakes, 0);
  Connect(sender.out, receiver.in);
  EXPECT_EQ(waker.wakes, 1);
  ASSERT_TRUE(Port::Disconnect(silent.out, receiver.in));
  EXPECT_EQ(waker.wakes, 1);
  receiver.in.SetWaker(nullptr);
}

TEST_F(ConnectingTest, WakerIsToldOfAValueThatComesWithTheConnectionsOfAnother) {
  CountingWaker waker;
  auto& sender = MakeSender<int>();
  auto& before = MakeReceiver<int>("before");
  auto& receiver = MakeReceiver<int>();
  receiver.in.SetWaker(&waker);
  Connect(sender.out, before.in);
  sender.out.Publish(1);
  receiver.in.TakeOver(before.in);
  EXPECT_EQ(waker.wakes, 1);
  receiver.in.SetWaker(nullptr);
}

TEST_F(ConnectingTest, WakerFindsTheValueInPlace) {
  struct Looker final : Waker {
    Input<int>* input = nullptr;
    int latest = 0;
    int taken = 0;
    void Wake() noexcept override {
      latest = *input->Read();
      taken = *input->Take();
    }
  } looker;
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  looker.input = &receiver.in;
  Connect(sender.out, receiver.in, {.queue = 2});
  receiver.in.SetWaker(&looker);
  sender.out.Publish(7);
  EXPECT_EQ(looker.latest, 7);
  EXPECT_EQ(looker.taken, 7);
  receiver.in.SetWaker(nullptr);
}

}  // namespace
}  // namespace runnel::test
