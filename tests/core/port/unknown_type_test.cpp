#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using UnknownTypeTest = PortTest;

Result<void> FillInt(void* value) {
  *static_cast<int*>(value) = 5;
  return {};
}

TEST_F(UnknownTypeTest, PublishesWhatHasBeenFilled) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  clock.Set(Time(Duration(40)));
  const auto published = static_cast<Port&>(sender.out).PublishFilled(FillInt);
  ASSERT_TRUE(published);
  EXPECT_EQ(*published, PublishStatus::kPublished);
  EXPECT_EQ(*receiver.in.Read(), 5);
  EXPECT_EQ(receiver.in.Read().timestamp(), Time(Duration(40)));
}

TEST_F(UnknownTypeTest, FillsTheVeryBufferThatReadersLease) {
  auto& sender = MakeSender<Scan>();
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in);
  void* filled = nullptr;
  ASSERT_TRUE(sender.out.PublishFilled([&](void* value) -> Result<void> {
    filled = value;
    static_cast<Scan*>(value)->number = 8;
    return {};
  }));
  const auto read = receiver.in.Read();
  EXPECT_EQ(&*read, filled);
  EXPECT_EQ(read->number, 8);
}

TEST_F(UnknownTypeTest, WhatCannotBeFilledIsNotPublished) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 1, .may_grow = false}});
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in);
  for (int i = 0; i < 3; ++i) {  // the loan goes back: else the second time would find no buffer
    const auto published = sender.out.PublishFilled([](void*) -> Result<void> { return Error{.message = "no"}; });
    ASSERT_FALSE(published);
    EXPECT_EQ(published.error().message, "no");
  }
  EXPECT_FALSE(receiver.in.Read());
  EXPECT_EQ(sender.out.publications(), 0u);
}

TEST_F(UnknownTypeTest, SaysWhyNothingCanBePublished) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 1, .may_grow = false}});
  auto& receiver = MakeReceiver<Scan>();
  const auto loan = sender.out.Loan();
  const auto no_buffer = sender.out.PublishFilled([](void*) -> Result<void> { return {}; });
  ASSERT_FALSE(no_buffer);
  EXPECT_EQ(no_buffer.error().message, "cannot publish: its pool has no free buffer");
  EXPECT_EQ(no_buffer.error().path, "/sender/out");
  const auto input = receiver.in.PublishFilled([](void*) -> Result<void> { return {}; });
  ASSERT_FALSE(input);
  EXPECT_EQ(input.error().message, "cannot publish: is an input");
}

TEST_F(UnknownTypeTest, InputsAndOutputsMakeAnotherOutputOfTheirType) {
  auto& sender = MakeSender<Token>();
  auto& receiver = MakeReceiver<int>();
  auto& box = runtime.Create<Box>(runtime.root(), "player");
  const Port& output = sender.out;
  const auto token = output.MakeOutput(box, "token", {});
  ASSERT_TRUE(token);
  EXPECT_EQ(&token->type(), &sender.out.type());
  EXPECT_EQ(token->path(), "/player/token");
  const auto number = static_cast<const Port&>(receiver.in).MakeOutput(box, "number", {});
  ASSERT_TRUE(number);
  Connect(*number, receiver.in);
  ASSERT_TRUE(number->PublishFilled(FillInt));
  EXPECT_EQ(*receiver.in.Read(), 5);
}

TEST_F(UnknownTypeTest, MakesNoOutputForATypeThatOnlyItsModuleCanMake) {
  auto& sender = runtime.Create<Sender<Sealed>>(runtime.root(), "sealed", OutputOptions{}, [] { return Sealed(7); });
  auto& box = runtime.Create<Box>(runtime.root(), "player");
  EXPECT_EQ(static_cast<const Port&>(sender.out).MakeOutput(box, "sealed", {}), nullptr);
}

}  // namespace
}  // namespace runnel::test
