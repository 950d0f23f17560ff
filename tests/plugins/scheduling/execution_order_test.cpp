#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/proxy_port.h"
#include "tests/plugins/scheduling/order_tasks.h"
#include "tests/plugins/scheduling/test_modules.h"

namespace runnel {
namespace {

using ::testing::AllOf;
using testing::Base;
using testing::ExecutionOrder;
using testing::OrderTasks;

class OrderOfTasks : public ::testing::Test {
 protected:
  Relay& MakeRelay(const std::string& name) { return Own(runtime.Create<Relay>(parent(), name)); }
  Base& MakeBase(const std::string& name) { return Own(runtime.Create<Base>(parent(), name)); }
  FrameworkElement& parent() { return runtime.root(); }

  template <typename T>
  T& Own(T& element) {
    elements.push_back(&element);
    return element;
  }
  static void Connect(Port& from, Port& to) { MustSucceed(Port::Connect(from, to)); }

  std::vector<Task> Tasks() {
    std::vector<Task> tasks;
    for (FrameworkElement* element : elements) {
      for (Task& task : element->FindAnnotation<Executable>()->tasks()) tasks.push_back(task);
    }
    return tasks;
  }
  static std::vector<std::string> Names(const ExecutionOrder& order) {
    std::vector<std::string> names;
    for (const Task& task : order.tasks) {
      const char* const phase = task.phase == Phase::kSense     ? " sense"
                                : task.phase == Phase::kControl ? " control"
                                                                : "";
      names.push_back(task.element->name() + phase);
    }
    return names;
  }

  Runtime runtime;
  std::vector<FrameworkElement*> elements;
};

TEST_F(OrderOfTasks, OfNothingIsEmpty) { EXPECT_THAT(OrderTasks({}).tasks, IsEmpty()); }

TEST_F(OrderOfTasks, IsThatOfCreationWhereNoDataFlow) {
  MakeRelay("b");
  MakeRelay("a");
  EXPECT_THAT(Names(OrderTasks(Tasks())), ElementsAre("b", "a"));
}

TEST_F(OrderOfTasks, FollowsAChainAgainstTheOrderOfCreation) {
  auto& c = MakeRelay("c");
  auto& b = MakeRelay("b");
  auto& a = MakeRelay("a");
  Connect(a.out, b.in);
  Connect(b.out, c.in);
  const ExecutionOrder order = OrderTasks(Tasks());
  EXPECT_THAT(Names(order), ElementsAre("a", "b", "c"));
  EXPECT_THAT(order.cuts, IsEmpty());
}

TEST_F(OrderOfTasks, FollowsDataThroughTheInterfacesOfGroups) {
  auto& sink = MakeRelay("sink");
  auto& group = runtime.Create<Group>(parent(), "group");
  auto& source = Own(runtime.Create<Relay>(group, "source"));
  auto& inner = runtime.Create<ProxyPort>(group, "inner", Port::Direction::kOutput, TypeOf<double>());
  auto& outer = runtime.Create<ProxyPort>(parent(), "outer", Port::Direction::kOutput, TypeOf<double>());
  Connect(outer, sink.in);
  Connect(inner, outer);
  Connect(source.out, inner);
  EXPECT_THAT(Names(OrderTasks(Tasks())), ElementsAre("source", "sink"));
}

TEST_F(OrderOfTasks, PutsSensingBeforeUpdatingBeforeControlling) {
  MakeBase("left");
  MakeRelay("brain");
  MakeBase("right");
  EXPECT_THAT(Names(OrderTasks(Tasks())),
              ElementsAre("left sense", "right sense", "brain", "left control", "right control"));
}

TEST_F(OrderOfTasks, LetsDataOverruleThePhases) {
  auto& base = MakeBase("base");
  auto& driver = MakeRelay("driver");
  Connect(driver.out, base.raw);
  EXPECT_THAT(Names(OrderTasks(Tasks())), ElementsAre("driver", "base sense", "base control"));
}

TEST_F(OrderOfTasks, TakesControlIntoSensingForFeedbackWithoutAWord) {
  auto& base = MakeBase("base");
  Connect(base.seen, base.wanted);
  Connect(base.command, base.raw);
  const ExecutionOrder order = OrderTasks(Tasks());
  EXPECT_THAT(Names(order), ElementsAre("base sense", "base control"));
  EXPECT_THAT(order.cuts, IsEmpty());
}

TEST_F(OrderOfTasks, CutsALoopThroughTheWorldInFrontOfSensing) {
  auto& world = MakeRelay("world");
  auto& base = MakeBase("base");
  auto& brain = MakeRelay("brain");
  Connect(world.out, base.raw);
  Connect(base.seen, brain.in);
  Connect(brain.out, base.wanted);
  Connect(base.command, world.in);
  const ExecutionOrder order = OrderTasks(Tasks());
  EXPECT_THAT(Names(order), ElementsAre("base sense", "brain", "base control", "world"));
  ASSERT_THAT(order.cuts, SizeIs(1));
  EXPECT_THAT(order.cuts[0].message, AllOf(HasSubstr("/world/output/out"), HasSubstr("/base/sensor_input/raw")));
}

TEST_F(OrderOfTasks, CutsALoopAtTheElementMadeFirst) {
  auto& a = MakeRelay("a");
  auto& b = MakeRelay("b");
  auto& c = MakeRelay("c");
  Connect(a.out, b.in);
  Connect(b.out, c.in);
  Connect(c.out, a.in);
  const ExecutionOrder order = OrderTasks(Tasks());
  EXPECT_THAT(Names(order), ElementsAre("a", "b", "c"));
  ASSERT_THAT(order.cuts, SizeIs(1));
  EXPECT_EQ(order.cuts[0].path, "/c/output/out");
  EXPECT_THAT(order.cuts[0].message, HasSubstr("/a/input/in"));
}

TEST_F(OrderOfTasks, DoesNotCutInFrontOfWhatALoopOnlyFeeds) {
  auto& fed = MakeRelay("fed");  // made first, but part of no loop
  auto& a = MakeRelay("a");
  auto& b = MakeRelay("b");
  Connect(a.out, b.in);
  Connect(b.out, a.in);
  Connect(b.out, fed.in);
  const ExecutionOrder order = OrderTasks(Tasks());
  EXPECT_THAT(Names(order), ElementsAre("a", "b", "fed"));
  EXPECT_THAT(order.cuts, SizeIs(1));
}

TEST_F(OrderOfTasks, ReportsAModuleThatFeedsItself) {
  auto& a = MakeRelay("a");
  Connect(a.out, a.in);
  const ExecutionOrder order = OrderTasks(Tasks());
  EXPECT_THAT(Names(order), ElementsAre("a"));
  EXPECT_THAT(order.cuts, SizeIs(1));
}

TEST_F(OrderOfTasks, DoesNotDependOnTheOrderOfTheQuestion) {
  std::vector<Relay*> relays;
  std::mt19937 random(7);  // a fixed seed: the same graph in every run
  for (int i = 0; i < 30; ++i) relays.push_back(&MakeRelay("relay" + std::to_string(i)));
  for (int i = 0; i < 60; ++i) {
    (void)Port::Connect(relays[random() % 30]->out, relays[random() % 30]->in);
  }
  const ExecutionOrder expected = OrderTasks(Tasks());
  ASSERT_THAT(expected.cuts, ::testing::Not(IsEmpty()));
  for (int round = 0; round < 20; ++round) {
    std::vector<Task> shuffled = Tasks();
    std::ranges::shuffle(shuffled, random);
    const ExecutionOrder order = OrderTasks(std::move(shuffled));
    EXPECT_EQ(Names(order), Names(expected));
    EXPECT_EQ(order.cuts, expected.cuts);
  }
}

TEST_F(OrderOfTasks, BreaksNoConnectionThatItDoesNotReport) {
  std::vector<Relay*> relays;
  std::mt19937 random(11);
  for (int i = 0; i < 30; ++i) relays.push_back(&MakeRelay("relay" + std::to_string(i)));
  std::vector<std::pair<Relay*, Relay*>> connections;
  for (int i = 0; i < 50; ++i) {
    auto* const from = relays[random() % 30];
    auto* const to = relays[random() % 30];
    if (Port::Connect(from->out, to->in)) connections.emplace_back(from, to);
  }
  const ExecutionOrder order = OrderTasks(Tasks());
  const auto place = [&](const Relay* relay) {
    return std::ranges::find(order.tasks, relay, &Task::element) - order.tasks.begin();
  };
  std::size_t late = 0;
  for (const auto& [from, to] : connections) {
    if (place(from) < place(to)) continue;
    ++late;
    const auto is_told = [&source = from->out, &target = to->in](const Error& cut) {
      return cut.path == source.path() && cut.message.find(target.path()) != std::string::npos;
    };
    EXPECT_TRUE(std::ranges::any_of(order.cuts, is_told));
  }
  EXPECT_EQ(order.cuts.size(), late);  // and nothing is reported that was not broken
}

}  // namespace
}  // namespace runnel
