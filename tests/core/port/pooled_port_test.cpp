#include <atomic>

#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using PooledPortTest = PortTest;

TEST_F(PooledPortTest, ReaderLooksAtTheVeryObjectThatTheWriterFilled) {
  auto& sender = MakeSender<Scan>();
  auto& first = MakeReceiver<Scan>("first");
  auto& second = MakeReceiver<Scan>("second");
  Connect(sender.out, first.in);
  Connect(sender.out, second.in, {.queue = 2});
  auto loan = sender.out.Loan();
  const Scan* const written = &*loan;
  loan->ranges = {1, 2, 3};
  ASSERT_EQ(sender.out.Publish(std::move(loan)), PublishStatus::kPublished);
  EXPECT_EQ(&*first.in.Read(), written);
  EXPECT_EQ(&*second.in.Read(), written);
  EXPECT_EQ(&*second.in.Take(), written);
}

TEST_F(PooledPortTest, SizeAndCopyingDecideHowATypeTravels) {
  EXPECT_TRUE(kIsInlined<double>);
  EXPECT_TRUE((kIsInlined<std::array<char, 32>>));
  EXPECT_FALSE((kIsInlined<std::array<char, 33>>));
  EXPECT_FALSE(kIsInlined<Scan>);
  EXPECT_FALSE(kIsInlined<Token>);
  EXPECT_FALSE(kIsInlined<Sealed>);
  EXPECT_FALSE(kIsInlined<Stubborn>);
}

TEST_F(PooledPortTest, GetCopiesTheNewestValueAndMarksNothingAsRead) {
  auto& sender = MakeSender<Image>();
  auto& receiver = MakeReceiver<Image>();
  Image otherwise;
  otherwise.pixels.fill('o');
  EXPECT_EQ(receiver.in.Get(otherwise).pixels[999], 'o');
  Connect(sender.out, receiver.in);
  EXPECT_EQ(receiver.in.Get(otherwise).pixels[0], 'o');
  EXPECT_EQ(receiver.in.Get().pixels[0], '\0');
  Image image;
  image.pixels.fill('i');
  sender.out.Publish(image);
  EXPECT_EQ(receiver.in.Get(otherwise).pixels, image.pixels);
  EXPECT_EQ(receiver.in.Get().pixels, image.pixels);
  EXPECT_TRUE(receiver.in.Read().is_new());
}

TEST_F(PooledPortTest, LargePlainTypesAndThoseThatAskForItTravelInBuffersToo) {
  auto& images = MakeSender<Image>("images");
  auto& image_reader = MakeReceiver<Image>("image_reader");
  Connect(images.out, image_reader.in);
  auto image = images.out.Loan();
  const Image* const written = &*image;
  images.out.Publish(std::move(image));
  EXPECT_EQ(&*image_reader.in.Read(), written);
  auto& small = MakeSender<Stubborn>("small");
  auto& small_reader = MakeReceiver<Stubborn>("small_reader");
  Connect(small.out, small_reader.in);
  small.out.Publish({5});
  EXPECT_EQ(small_reader.in.Read()->number, 5);
  EXPECT_EQ(&*small_reader.in.Read(), &*small_reader.in.Peek());
}

TEST_F(PooledPortTest, PublishingAValueCopiesOrMovesItIntoABuffer) {
  auto& sender = MakeSender<Scan>();
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in);
  const Scan scan{{1, 2}, 7};
  sender.out.Publish(scan);
  EXPECT_EQ(receiver.in.Read()->ranges, scan.ranges);
  Scan temporary{{3, 4}, 8};
  const float* const memory = temporary.ranges.data();
  sender.out.Publish(std::move(temporary));
  EXPECT_EQ(receiver.in.Read()->ranges.data(), memory);
}

TEST_F(PooledPortTest, TypesThatCannotBeCopiedAreMoved) {
  auto& sender = MakeSender<Token>();
  auto& receiver = MakeReceiver<Token>();
  Connect(sender.out, receiver.in, {.queue = 2});
  sender.out.Publish(Token{std::make_unique<int>(7)});
  EXPECT_EQ(*receiver.in.Read()->content, 7);
  EXPECT_EQ(*receiver.in.Take()->content, 7);
}

TEST_F(PooledPortTest, TypesThatCannotEvenBeMovedAreFilledInPlace) {
  auto& sender = runtime.Create<Sender<Sealed>>(runtime.root(), "sender", OutputOptions{.pool = {.buffers = 2}},
                                                [] { return Sealed(-1); });
  auto& receiver = MakeReceiver<Sealed>();
  Connect(sender.out, receiver.in);
  auto loan = sender.out.Loan();
  EXPECT_EQ(loan->number, -1);
  loan->number = 7;
  sender.out.Publish(std::move(loan));
  EXPECT_EQ(receiver.in.Read()->number, 7);
}

TEST_F(PooledPortTest, ValueOfALeaseStaysWhileNewerOnesCome) {
  auto& sender = MakeSender<Scan>();
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in);
  sender.out.Publish(Scan{{1, 2, 3}, 1});
  const auto lease = receiver.in.Read();
  for (int i = 2; i < 50; ++i) sender.out.Publish(Scan{{9}, i});
  EXPECT_EQ(lease->number, 1);
  EXPECT_EQ(lease->ranges, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(sender.out.growths(), 0u);  // the others went round in the rest of the pool
}

TEST_F(PooledPortTest, LeaseOutlivesModuleAndRuntime) {
  Lease<Scan> lease;
  Lease<Scan> copy;
  {
    Runtime other;
    auto& sender = other.Create<Sender<Scan>>(other.root(), "sender");
    auto& receiver = other.Create<Receiver<Scan>>(other.root(), "receiver");
    Connect(sender.out, receiver.in);
    sender.out.Publish(Scan{{1, 2, 3}, 7});
    lease = receiver.in.Read();
    ASSERT_TRUE(other.Delete(sender));
    EXPECT_FALSE(receiver.in.Read());
    copy = lease;
  }
  EXPECT_EQ(lease->number, 7);
  lease = {};
  EXPECT_EQ(copy->ranges.size(), 3u);
}

TEST_F(PooledPortTest, LoanOutlivesTheOutput) {
  auto& sender = MakeSender<Scan>();
  auto loan = sender.out.Loan();
  ASSERT_TRUE(runtime.Delete(sender));
  loan->number = 3;
  EXPECT_EQ(loan->number, 3);
}

// Its own output would give the buffer away again while the other's readers look at it.
TEST_F(PooledPortTest, LoanOfAnotherOutputIsAProgrammingErrorAndChangesNothing) {
  auto& a = MakeSender<Scan>("a");
  auto& b = MakeSender<Scan>("b");
  auto& receiver = MakeReceiver<Scan>();
  Connect(b.out, receiver.in);
  auto loan = a.out.Loan();
  EXPECT_THROW((void)b.out.Publish(std::move(loan)), ProgrammingError);
  EXPECT_FALSE(receiver.in.Read());
  EXPECT_EQ(a.out.Publish(std::move(loan)), PublishStatus::kPublished);
  EXPECT_EQ(a.out.publications(), 1u);
  EXPECT_EQ(b.out.publications(), 0u);
}

TEST_F(PooledPortTest, LoanThatIsDroppedGoesBackUnpublished) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 2, .may_grow = false}});
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(sender.out.Loan());
  EXPECT_EQ(sender.out.publications(), 0u);
}

TEST_F(PooledPortTest, FixedPoolThatIsExhaustedLendsNothingAndSaysSo) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 2, .may_grow = false}});
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in);
  sender.out.Publish(Scan{{}, 1});
  auto held = receiver.in.Read();  // the newest one and ours are the same buffer
  sender.out.Publish(Scan{{}, 2});
  auto nothing = sender.out.Loan();
  EXPECT_FALSE(nothing);
  EXPECT_THROW(nothing->number = 1, ProgrammingError);
  EXPECT_EQ(sender.out.Publish(std::move(nothing)), PublishStatus::kNoBuffer);
  EXPECT_EQ(sender.out.Publish(Scan{{}, 3}), PublishStatus::kNoBuffer);
  EXPECT_EQ(receiver.in.Read()->number, 2);
  held = {};
  EXPECT_EQ(sender.out.Publish(Scan{{}, 4}), PublishStatus::kPublished);
  EXPECT_EQ(sender.out.growths(), 0u);
}

TEST_F(PooledPortTest, GrowingPoolCountsWhenItHadToAllocate) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 2, .may_grow = true}});
  std::vector<Loan<Scan>> loans;
  for (int i = 0; i < 4; ++i) loans.push_back(sender.out.Loan());
  for (auto& each : loans) EXPECT_TRUE(each);
  EXPECT_EQ(sender.out.growths(), 1u);
}

}  // namespace
}  // namespace runnel::test
