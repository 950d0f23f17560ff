#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "tests/plugins/genom_execution/sketch.h"

namespace runnel::genom_execution {
namespace {

using namespace std::chrono_literals;

TEST(Exclusion, IsFirstComeFirstServed) {
  constexpr std::array<CodelTable, 3> kCodels{
      {{"a", nullptr, false, false}, {"b", nullptr, false, false}, {"c", nullptr, false, false}}};
  constexpr std::array<Conflict, 2> kConflicts{{{0, 1}, {1, 2}}};
  const ComponentTable component{.name = "x", .codels = kCodels, .conflicts = kConflicts};
  const ConflictMatrix conflicts(component);
  EXPECT_TRUE(conflicts.Conflict(1, 0) && conflicts.Conflict(2, 1));
  EXPECT_FALSE(conflicts.Conflict(0, 2));
  Exclusion exclusion(conflicts, 3, false);
  exclusion.Want(0, 0);
  EXPECT_TRUE(exclusion.May(0));
  exclusion.Want(1, 1);
  EXPECT_FALSE(exclusion.May(1)) << "a runs";
  exclusion.Want(2, 2);
  EXPECT_FALSE(exclusion.May(2)) << "b was there first";
  exclusion.Leave(0);
  EXPECT_TRUE(exclusion.May(1));
  EXPECT_FALSE(exclusion.May(2));
  exclusion.Leave(1);
  EXPECT_TRUE(exclusion.May(2));
  exclusion.Leave(2);
}

// Three tasks with threads of their own, and codels that conflict in pairs.
TEST(Exclusion, KeepsConflictingCodelsApartAndLetsEachRunAtLast) {
  Sketch sketch;
  struct Counter {
    std::atomic<int> inside{0};
    std::atomic<int> runs{0};
    std::atomic<bool> was_shared{false};
  } data;
  for (const char* name : {"one", "two", "three"}) {
    sketch.AddTask({.name = name, .states = {{"start", std::string("c_") + name, {"start"}}}});
    for (const char* other : {"one", "two", "three"}) {
      if (std::string(other) != name) sketch.Exclude(std::string("c_") + name, std::string("c_") + other);
    }
  }
  sketch.MakeAsync("c_one");  // whose names are not noted in the trace
  sketch.MakeAsync("c_two");
  sketch.MakeAsync("c_three");
  std::array<std::atomic<int>, 3> runs{};
  int at = 0;
  for (const char* name : {"c_one", "c_two", "c_three"}) {
    sketch.Do(name,
              [&data, &count = runs.at(static_cast<std::size_t>(at++)), event = sketch.Of("start")](const Invocation&) {
                if (data.inside.fetch_add(1) != 0) data.was_shared = true;
                std::this_thread::yield();
                data.inside.fetch_sub(1);
                count.fetch_add(1);
                return event;
              });
  }
  Engine& engine = sketch.Start({.patience = Duration::max()});
  std::atomic<bool> is_over{false};
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < 3; ++i) {
    threads.emplace_back([&, i] {
      while (!is_over) {
        (void)engine.RunTask(i, Time());
        if (runs[0] > 50 && runs[1] > 50 && runs[2] > 50) is_over = true;
      }
    });
  }
  threads.clear();
  EXPECT_FALSE(data.was_shared);
}

// Codels that take long are with another thread; their task waits for them, other tasks do not.
TEST(Exclusion, OfAsynchronousCodelsHoldsUpOnlyTheirTask) {
  Sketch sketch;
  sketch.AddTask({.name = "link", .states = {{"start", "dial", {"ether"}}}});
  sketch.AddTask({.name = "drive", .period = 10ms, .states = {{"start", "step", {"pause::start"}}}});
  sketch.AddService({"send", ServiceKind::kActivity, "link", {{"start", "write", {"ether"}}}});
  sketch.AddService({"quick", ServiceKind::kActivity, "link", {{"start", "q", {"ether"}}}});
  sketch.MakeAsync("write");
  sketch.Do("write", [&](const Invocation&) { return sketch.Of("ether"); });
  static AsyncWork* given = nullptr;
  given = nullptr;
  sketch.Start({.is_single_threaded = true, .run_async = [](void*, std::size_t place, AsyncWork& work) {
                  EXPECT_EQ(place, 1u);
                  given = &work;
                }});
  sketch.RunAt(0ms);
  EXPECT_EQ(sketch.Trace(), "dial step");
  Request& send = sketch.Send("send");
  Request& quick = sketch.Send("quick");
  sketch.RunAt(10ms);
  ASSERT_NE(given, nullptr);
  EXPECT_EQ(send.state(), Request::State::kAccepted);
  EXPECT_EQ(sketch.Trace(), "step");
  std::jthread(&AsyncWork::Run, given).join();
  sketch.RunAt(15ms);
  EXPECT_EQ(sketch.Trace(), "q");
  EXPECT_TRUE(send.state() == Request::State::kDone && send.outcome().is_success());
  EXPECT_EQ(quick.state(), Request::State::kDone);
}

// What may not run yet is tried again, and nothing else of its task meanwhile.
TEST(Exclusion, WithoutWaitingComesAgain) {
  Sketch sketch;
  sketch.AddTask({.name = "link", .states = {{"start", "poll", {"ether"}}}});
  sketch.AddTask({.name = "drive", .states = {{"start", "step", {"ether"}}, {"stop", "quiet", {"ether"}}}});
  sketch.AddService({"send", ServiceKind::kActivity, "link", {{"start", "write", {"ether"}}}});
  sketch.MakeAsync("write");
  sketch.Exclude("write", "quiet");
  sketch.Do("write", [&](const Invocation&) { return sketch.Of("ether"); });
  static AsyncWork* given = nullptr;
  Engine& engine = sketch.Start(
      {.is_single_threaded = true, .run_async = [](void*, std::size_t, AsyncWork& work) { given = &work; }});
  sketch.RunAt(0ms);
  (void)sketch.Send("send");
  sketch.RunAt(1ms);
  (void)sketch.Trace();
  engine.Stop();
  sketch.RunAt(2ms);
  EXPECT_FALSE(engine.is_ended());
  given->Run();
  sketch.RunAt(3ms);
  EXPECT_TRUE(engine.is_ended());
  EXPECT_EQ(sketch.Trace(), "quiet");
}

// Threads that must not sleep for long come again, and lose no place in the order.
TEST(Exclusion, SleepsNoLongerThanItsPatience) {
  Sketch sketch;
  sketch.AddTask({.name = "one", .states = {{"start", "a", {"ether"}}}});
  sketch.AddTask({.name = "two", .states = {{"start", "idle", {"go"}}, {"go", "b", {"ether"}}}});
  sketch.Exclude("a", "b");
  Engine& engine = sketch.Start({.patience = 1ms});
  EXPECT_EQ(engine.RunTask(0, Time()), Pass::kIdle);
  EXPECT_EQ(engine.RunTask(1, Time()), Pass::kAgain);
  Exclusion& exclusion = engine.exclusion();
  exclusion.Want(1, 0);
  EXPECT_EQ(engine.RunTask(1, Time()), Pass::kWaiting);
  exclusion.Leave(1);
  EXPECT_EQ(engine.RunTask(1, Time()), Pass::kIdle);
}

TEST(Exclusion, DoesNotSleepForAsynchronousCodels) {
  Sketch sketch;
  sketch.AddTask({.name = "one", .states = {{"start", "dial", {"ether"}}}});
  sketch.AddTask({.name = "two", .states = {{"start", "b", {"ether"}}}});
  sketch.AddService({"send", ServiceKind::kActivity, "one", {{"start", "write", {"ether"}}}});
  sketch.MakeAsync("write");
  sketch.Exclude("write", "b");
  Engine& engine = sketch.Start({.patience = Duration::max(), .run_async = [](void*, std::size_t, AsyncWork&) {}});
  EXPECT_EQ(engine.RunTask(0, Time()), Pass::kIdle);
  engine.exclusion().Want(1, 2);  // as if it was with another thread: "write" comes behind the codels of tasks
  EXPECT_EQ(engine.RunTask(1, Time()), Pass::kWaiting);
  engine.exclusion().Leave(1);
  EXPECT_EQ(engine.RunTask(1, Time()), Pass::kIdle);
}

}  // namespace
}  // namespace runnel::genom_execution
