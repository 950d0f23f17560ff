#include "core/module/group.h"

#include "core/port/proxy_port.h"
#include "tests/core/module/module_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;

// A group with one port in and one port out, and a module inside.
class GroupTest : public testing::Test {
 protected:
  GroupTest() {
    for (const auto& connected : {Port::Connect(source.doubled, in), Port::Connect(in, inner->value),
                                  Port::Connect(inner->doubled, out), Port::Connect(out, sink.value)}) {
      EXPECT_TRUE(connected);
    }
  }

  Runtime runtime;
  Doubler& source = runtime.Create<Doubler>(runtime.root(), "source");
  Group& group = runtime.Create<Group>(runtime.root(), "group");
  ProxyPort& in = runtime.Create<ProxyPort>(group, "in", Port::Direction::kInput, TypeOf<double>());
  ProxyPort& out = runtime.Create<ProxyPort>(group, "out", Port::Direction::kOutput, TypeOf<double>());
  Doubler* inner = &runtime.Create<Doubler>(group, "inner");
  Doubler& sink = runtime.Create<Doubler>(runtime.root(), "sink");
};

TEST_F(GroupTest, DataFlowsThroughItsInterface) {
  EXPECT_EQ(group.kind(), ElementKind::kGroup);
  EXPECT_EQ(inner->path(), "/group/inner");
  source.doubled.Publish(1.0);
  RunOnce(*inner);
  RunOnce(sink);
  double last = 0;
  sink.doubled.VisitLatest([&](const void* value, Time) { last = *static_cast<const double*>(value); });
  EXPECT_EQ(last, 4.0);
}

TEST_F(GroupTest, ExecutorsSeeTheEndsOfTheFlowNotTheInterface) {
  EXPECT_THAT(inner->value.Sources(), ElementsAre(&source.doubled));
  EXPECT_THAT(inner->doubled.Sinks(), ElementsAre(&sink.value));
}

TEST_F(GroupTest, WhatIsInsideCanBeExchangedWithoutTheOutsideKnowing) {
  ASSERT_TRUE(runtime.Delete(*inner));
  EXPECT_EQ(source.doubled.outgoing().size(), 1u);
  auto& other = runtime.Create<Doubler>(group, "inner");
  ASSERT_TRUE(Port::Connect(in, other.value));
  ASSERT_TRUE(Port::Connect(other.doubled, out));
  source.doubled.Publish(2.0);
  RunOnce(other);
  RunOnce(sink);
  EXPECT_EQ(sink.doubled.publications(), 1u);
}

TEST_F(GroupTest, GoesWithAllThatIsInside) {
  ASSERT_TRUE(runtime.Delete(group));
  EXPECT_TRUE(source.doubled.outgoing().empty());
  EXPECT_TRUE(sink.value.incoming().empty());
  source.doubled.Publish(1.0);
}

TEST_F(GroupTest, HasNoTasksOfItsOwn) { EXPECT_TRUE(TasksOf(group).empty()); }

}  // namespace
}  // namespace runnel::test
