// Values are published on by another output than the first.

#include <optional>

#include "core/port/probe_port.h"
#include "tests/core/port/forwarding_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

// However a type travels, what is forwarded has its own number and time of publication.
template <typename T>
class ForwardingEachTypeTest : public PortTest {};
using ForwardedTypes = testing::Types<int, Stubborn, Scan, Image, Frame>;
TYPED_TEST_SUITE(ForwardingEachTypeTest, ForwardedTypes);

TYPED_TEST(ForwardingEachTypeTest, PublicationDataAreThoseOfEachPublication) {
  auto& origin = this->template MakeSender<TypeParam>("origin");
  auto& next = this->template MakeSender<TypeParam>("next");
  auto& near = this->template MakeReceiver<TypeParam>("near");
  auto& far = this->template MakeReceiver<TypeParam>("far");
  this->Connect(origin.out, near.in, {.queue = 4});
  this->Connect(next.out, far.in, {.queue = 4});
  this->clock.Set(Time(5s));
  for (int i = 1; i <= 3; ++i) origin.out.Publish(TypeParam{}, Time(i * 1s));
  this->clock.Set(Time(7s));
  EXPECT_EQ(next.out.Forward(near.in.Read()), PublishStatus::kPublished);
  const auto expect = [](const Lease<TypeParam>& lease, Time publication_time, std::uint64_t sequence) {
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease.timestamp(), Time(3s));
    EXPECT_EQ(lease.publication_time(), publication_time);
    EXPECT_EQ(lease.sequence(), sequence);
  };
  expect(far.in.Read(), Time(7s), 1);
  expect(far.in.Take(), Time(7s), 1);
  expect(near.in.Read(), Time(5s), 3);
  EXPECT_TRUE(near.in.Take());
  EXPECT_TRUE(near.in.Take());
  const Lease<TypeParam> queued = near.in.Take();
  expect(queued, Time(5s), 3);
  EXPECT_EQ(next.out.Forward(queued), PublishStatus::kPublished);
  expect(far.in.Take(), Time(7s), 2);
  expect(queued, Time(5s), 3);
}

TYPED_TEST(ForwardingEachTypeTest, AnEmptyLeaseIsAnError) {
  auto& next = this->template MakeSender<TypeParam>();
  EXPECT_THROW((void)next.out.Forward({}), ProgrammingError);
  EXPECT_EQ(next.out.publications(), 0u);
}

TEST_F(ForwardingTest, AChainAndItsQueuesHaveTheVeryObject) {
  const Link a = MakeLink("a");
  const Link b = MakeLink("b");
  const Link c = MakeLink("c");
  auto& queued = MakeReceiver<Scan>("queued");
  ProbePort probe(runtime.root(), "probe", TypeOf<Scan>());
  Connect(c.sender.out, queued.in, {.queue = 2});
  Connect(c.sender.out, probe);
  const Scan* const written = Publish(a.sender.out, 1);
  b.sender.out.Forward(a.receiver.in.Read());
  c.sender.out.Forward(b.receiver.in.Read());
  EXPECT_EQ(&*b.receiver.in.Read(), written);
  EXPECT_EQ(&*c.receiver.in.Read(), written);
  EXPECT_EQ(&*queued.in.Take(), written);
  const auto is_it = [&](const void* value, Time) { EXPECT_EQ(value, written); };
  EXPECT_TRUE(probe.Take(is_it));
  EXPECT_TRUE(c.sender.out.VisitLatest(is_it));
}

TEST_F(ForwardingTest, AValueMayBeForwardedBySeveralAndTwiceByOneAndByItsOrigin) {
  const Link a = MakeLink("a", {.pool = {.buffers = 4, .may_grow = false}});
  const Link b = MakeLink("b");
  const Link c = MakeLink("c");
  const Scan* const written = Publish(a.sender.out, 1);
  const auto lease = a.receiver.in.Read();
  for (const Link* link : {&b, &c, &b, &a}) {
    EXPECT_EQ(link->sender.out.Forward(lease), PublishStatus::kPublished);
  }
  for (const Link* link : {&a, &b, &c}) EXPECT_EQ(&*link->receiver.in.Read(), written);
  EXPECT_EQ(a.receiver.in.Read().sequence(), 2u);
  EXPECT_EQ(b.receiver.in.Read().sequence(), 2u);
}

TEST_F(ForwardingTest, TheOriginsBufferIsHeldUntilTheForwarderPublishesAgain) {
  const Link a = MakeLink("a", kFixed);
  const Link b = MakeLink("b");
  Publish(a.sender.out, 1);
  b.sender.out.Forward(a.receiver.in.Read());
  ASSERT_TRUE(Publish(a.sender.out, 2));
  EXPECT_FALSE(a.sender.out.Loan()) << "the other buffer is forwarded";
  EXPECT_EQ(b.receiver.in.Read()->ranges[19], 1.0F);
  b.sender.out.Forward(a.receiver.in.Read());
  EXPECT_FALSE(a.sender.out.Loan()) << "nobody has looked yet";
  b.sender.out.ReleaseUnused();
  EXPECT_TRUE(Publish(a.sender.out, 3));
  EXPECT_EQ(b.receiver.in.Read()->number, 2);
}

TEST_F(ForwardingTest, TheOriginsBufferIsHeldAsLongAsAReaderOfTheForwarderHoldsIt) {
  const Link a = MakeLink("a", kFixed);
  const Link b = MakeLink("b");
  Publish(a.sender.out, 1);
  b.sender.out.Forward(a.receiver.in.Read());
  std::optional kept = b.receiver.in.Read();
  Publish(a.sender.out, 2);
  for (int i = 0; i < 20; ++i) b.sender.out.Publish(Scan{});
  b.sender.out.ReleaseUnused();
  EXPECT_FALSE(a.sender.out.Loan());
  EXPECT_EQ((*kept)->number, 1);
  kept.reset();
  b.sender.out.ReleaseUnused();
  EXPECT_TRUE(a.sender.out.Loan());
}

TEST_F(ForwardingTest, AForwarderThatPublishesItsOwnAgainUsesItsOwnBuffer) {
  const Link a = MakeLink("a");
  const Link b = MakeLink("b", {.pool = {.buffers = 2, .may_grow = false}});
  for (int i = 0; i < 10; ++i) {
    const Scan* const theirs = Publish(a.sender.out, i);
    b.sender.out.Forward(a.receiver.in.Read());
    EXPECT_EQ(&*b.receiver.in.Read(), theirs);
    const Scan* const own = Publish(b.sender.out, -i);
    ASSERT_NE(own, nullptr);
    EXPECT_EQ(&*b.receiver.in.Read(), own);
    EXPECT_EQ(a.receiver.in.Read()->number, i) << "is not written by the other";
  }
}

TEST_F(ForwardingTest, WhatIsForwardedOutlivesItsOrigin) {
  const Link b = MakeLink("b");
  Lease<Scan> from_closed;
  {
    const Link a = MakeLink("a");
    Publish(a.sender.out, 1);
    from_closed = a.receiver.in.Read();
    b.sender.out.Forward(from_closed);
    ASSERT_TRUE(runtime.Delete(a.sender));
    ASSERT_TRUE(runtime.Delete(a.receiver));
  }
  CollectRetired();
  EXPECT_EQ(b.receiver.in.Read()->ranges[19], 1.0F);
  const Link c = MakeLink("c");
  c.sender.out.Forward(from_closed);
  from_closed = {};
  CollectRetired();
  EXPECT_EQ(c.receiver.in.Read()->ranges[19], 1.0F);
}

TEST_F(ForwardingTest, WhatIsForwardedOutlivesItsForwarder) {
  const Link a = MakeLink("a", kFixed);
  const Link b = MakeLink("b");
  Publish(a.sender.out, 1);
  b.sender.out.Forward(a.receiver.in.Read());
  Lease<Scan> kept = b.receiver.in.Read();
  Publish(a.sender.out, 2);
  ASSERT_TRUE(runtime.Delete(b.sender));
  EXPECT_FALSE(a.sender.out.Loan());
  EXPECT_EQ(kept->ranges[19], 1.0F);
  kept = {};
  CollectRetired();
  EXPECT_TRUE(a.sender.out.Loan());
}

TEST_F(ForwardingTest, WithoutAFreeBufferOfItsOwnNothingIsForwarded) {
  const Link a = MakeLink("a");
  const Link b = MakeLink("b", {.pool = {.buffers = 1, .may_grow = false}});
  Publish(a.sender.out, 1);
  EXPECT_EQ(b.sender.out.Forward(a.receiver.in.Read()), PublishStatus::kPublished);
  Publish(a.sender.out, 2);
  EXPECT_EQ(b.sender.out.Forward(a.receiver.in.Read()), PublishStatus::kNoBuffer);
  EXPECT_EQ(b.receiver.in.Read()->number, 1);
}

}  // namespace
}  // namespace runnel::test
