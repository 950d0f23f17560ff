#include "plugins/real_time_check/sanitizer.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {
namespace {

using RunningTest = RealEditorTest;

constexpr int kSwaps = RUNNEL_UNDER_SANITIZER ? 40 : 300;

bool Counts(const std::vector<int>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] != static_cast<int>(i) + 1) return false;
  }
  return true;
}

TEST_F(RunningTest, SwappingBothEndsUnderLoadNeitherLosesNorRepeatsAnything) {
  CreateThread(runtime, "busy", {.activation = ThreadOptions::Activation::kFreeRunning, .period = 1ms});
  class Eager final : public Module {
   public:
    explicit Eager(const Placement& placement) : Module(placement) { KeepState(count); }
    Output<int> out{this, "out"};
    Count count;

   private:
    void Update() override {
      if (!out.WouldRefuse()) out.Publish(++count.value);
    }
  };
  Register<Eager>("test/eager");
  Must({CreateModule{"/app/eager", "test/eager"}, CreateModule{"/app/sink", "test/sink"},
        ConnectPorts{"/app/eager/out", "/app/sink/in", {.queue = 64, .on_full = OnFull::kRefuse}},
        ConnectPorts{"/app/sink/sum", "/app/sink/side"}, AssignToThread{"/app/eager", "busy"},
        AssignToThread{"/app/sink", "fast"}});
  ASSERT_TRUE(scheduler.Start());
  std::thread other([&] {
    for (int i = 0; i < kSwaps; ++i) Must({ReplaceModule{"/app/sink", "test/sink", {}, 1}});
  });
  for (int i = 0; i < kSwaps; ++i) Must({ReplaceModule{"/app/eager", "test/eager", {}, 1}});
  other.join();
  WaitUntil("the sink has taken 300 values", [&] {
    const std::lock_guard lock(runtime.structure_mutex());
    auto& sink = dynamic_cast<Sink&>(**runtime.root().Find("/app/sink"));
    const std::lock_guard lock_of_list(Sink::mutex);
    return sink.taken.size() > 300;
  });
  scheduler.Stop();
  EXPECT_TRUE(Counts(At<Sink>("/app/sink").taken));
  EXPECT_THAT(scheduler.TakeFaults(), IsEmpty());
}

/// Publishes its number twice in each cycle.
class Twin final : public Module {
 public:
  using Module::Module;
  Output<int> left{this, "left"};
  Output<int> right{this, "right"};
  Parameter<int> number{this, "number", {.default_value = 1}};

 private:
  void Update() override {
    left.Publish(number.Get());
    right.Publish(number.Get());
  }
};

/// Throws if what it sees does not come from one source.
class Judge final : public Module {
 public:
  using Module::Module;
  Input<int> left{this, "left"};
  Input<int> right{this, "right"};

 private:
  void Update() override {
    const auto a = left.Read();
    const auto b = right.Read();
    if (a.has_value() != b.has_value()) throw std::runtime_error("saw half of a change");
    if (a.has_value() && *a != *b) throw std::runtime_error("saw a change in the midst of it");
  }
};

TEST_F(RunningTest, NoCycleSeesHalfOfAChangeSet) {
  Register<Twin>("test/twin");
  Register<Judge>("test/judge");
  CreateThread(runtime, "busy", {.activation = ThreadOptions::Activation::kFreeRunning, .period = 1ms});
  Must({CreateModule{"/app/a", "test/twin", {{"number", "1"}}}, CreateModule{"/app/b", "test/twin", {{"number", "2"}}},
        CreateModule{"/app/judge", "test/judge"}, AssignToThread{"/app/judge", "busy"}});
  ASSERT_TRUE(scheduler.Start());
  // A twin's first cycle in its own thread is no change: between its two values one is missing.
  WaitUntil("both twins have published",
            [&] { return At<Twin>("/app/a").right.publications() > 0 && At<Twin>("/app/b").right.publications() > 0; });
  Must({ConnectPorts{"/app/a/left", "/app/judge/left"}, ConnectPorts{"/app/a/right", "/app/judge/right"}});
  const char* from = "/app/a";
  const char* to = "/app/b";
  for (int i = 0; i < kSwaps; ++i) {
    const std::string old(from);
    const std::string next(to);
    Must({DisconnectPorts{old + "/left", "/app/judge/left"}, ConnectPorts{next + "/left", "/app/judge/left"},
          DisconnectPorts{old + "/right", "/app/judge/right"}, ConnectPorts{next + "/right", "/app/judge/right"}});
    std::swap(from, to);
  }
  for (int i = 0; i < kSwaps; ++i) {
    Must({DisconnectPorts{std::string(from) + "/left", "/app/judge/left"},
          DisconnectPorts{std::string(from) + "/right", "/app/judge/right"}});
    Must({ConnectPorts{std::string(from) + "/left", "/app/judge/left"},
          ConnectPorts{std::string(from) + "/right", "/app/judge/right"}});
  }
  scheduler.Stop();
  EXPECT_THAT(scheduler.TakeFaults(), IsEmpty());
}

TEST_F(RunningTest, AModuleThatDoesNotReturnIsNamedAndNothingChanges) {
  static std::atomic<bool> go_on{false};
  static std::atomic<bool> is_stuck{false};
  class Stuck final : public Module {
   public:
    using Module::Module;
    Output<int> out{this, "out"};

   private:
    void Update() override {
      is_stuck = true;
      WaitUntil("it may go on", [] { return go_on.load(); });
    }
  };
  Register<Stuck>("test/stuck");
  StructureEditor impatient(runtime, modules, &scheduler, {.timeout = 20ms});
  Must({CreateModule{"/app/stuck", "test/stuck"}, CreateModule{"/app/counter", "test/counter"},
        AssignToThread{"/app/stuck", "slow"}});
  ASSERT_TRUE(scheduler.Start());
  WaitUntil("the module is stuck", [] { return is_stuck.load(); });
  const auto outcome = impatient.Apply({ReplaceModule{"/app/stuck", "test/counter"}});
  EXPECT_FALSE(outcome);
  EXPECT_THAT(outcome.diagnostics.ToString(), HasSubstr("/threads/slow: has not come to the end"));
  EXPECT_TRUE(impatient.Apply({ReplaceModule{"/app/counter", "test/other_counter"}}))
      << "other threads are not concerned";
  go_on = true;
  Must({ReplaceModule{"/app/stuck", "test/counter"}});
  scheduler.Stop();
}

TEST_F(RunningTest, WhatThrowsIsPutBackWhileAllRuns) {
  Must({CreateModule{"/app/counter", "test/counter"}, CreateModule{"/app/sink", "test/sink"},
        ConnectPorts{"/app/counter/out", "/app/sink/in", {.queue = 1000, .on_full = OnFull::kRefuse}},
        ConnectPorts{"/app/sink/sum", "/app/sink/side"}, AssignToThread{"/app/sink", "slow"}});
  ASSERT_TRUE(scheduler.Start());
  for (int i = 0; i < 5; ++i) {
    Must({ReplaceModule{"/app/counter", "test/faulty"}});
    WaitUntil("the module before is back", [&] {
      const std::lock_guard lock(runtime.structure_mutex());
      return FindModuleType(**runtime.root().Find("/app/counter")) == "test/counter";
    });
  }
  const std::uint64_t before = At<Counter>("/app/counter").out.publications();
  WaitUntil("it publishes again", [&] { return At<Counter>("/app/counter").out.publications() > before; });
  scheduler.Stop();
  EXPECT_TRUE(Counts(At<Sink>("/app/sink").taken));
  EXPECT_THAT(scheduler.TakeFaults(), SizeIs(5));
}

// Swaps from several threads, while a third one creates, connects and deletes beside the editor.
TEST_F(RunningTest, EditorsAndOthersDoNotGetInEachOthersWay) {
  Must({CreateModule{"/app/a", "test/counter"}, CreateModule{"/app/b", "test/counter"},
        AssignToThread{"/app/b", "slow"}});
  ASSERT_TRUE(scheduler.Start());
  std::atomic<bool> done{false};
  std::thread meddler([&] {
    while (!done) {
      Sink* made = nullptr;
      {
        const std::lock_guard lock(runtime.structure_mutex());
        made = &runtime.Create<Sink>(runtime.root(), "made");
        ASSERT_TRUE(runtime.MakeReady(*made));
        auto& from = dynamic_cast<Port&>(**runtime.root().Find("/app/a/output/out"));
        ASSERT_TRUE(Port::Connect(from, made->in, {.queue = 10}));
      }
      ASSERT_TRUE(runtime.Delete(*made));
      std::this_thread::sleep_for(1ms);
    }
  });
  std::thread other([&] {
    for (int i = 0; i < kSwaps; ++i) Must({ReplaceModule{"/app/b", "test/counter", {}, 2}});
  });
  for (int i = 0; i < kSwaps; ++i) Must({ReplaceModule{"/app/a", "test/other_counter", {}, 2}});
  other.join();
  done = true;
  meddler.join();
  scheduler.Stop();
  EXPECT_THAT(scheduler.TakeFaults(), IsEmpty());
}

class SimulatedRunningTest : public EditorTest {};

TEST_F(SimulatedRunningTest, AnotherThreadMayChangeWhatASimulationRuns) {
  Must({CreateModule{"/app/counter", "test/counter"}, CreateModule{"/app/sink", "test/sink"},
        ConnectPorts{"/app/counter/out", "/app/sink/in", {.queue = 10, .on_full = OnFull::kRefuse}},
        ConnectPorts{"/app/sink/sum", "/app/sink/side"}});
  std::atomic<bool> done{false};
  std::thread changing([&] {
    for (int i = 0; i < kSwaps; ++i) {
      Must({ReplaceModule{"/app/counter", "test/other_counter", {}, 1}, CreateModule{"/app/more", "test/counter"}});
      Must({DeleteElement{"/app/more"}, ReplaceModule{"/app/sink", "test/sink", {}, 1}});
    }
    done = true;
  });
  while (!done) scheduler.Step();
  changing.join();
  EXPECT_TRUE(Counts(At<Sink>("/app/sink").taken));
  EXPECT_THAT(scheduler.TakeFaults(), IsEmpty());
}

}  // namespace
}  // namespace runnel::test
