// Faults are answered at once, whatever takes long elsewhere: modules that are destroyed, cycles that do not end.

#include <atomic>
#include <future>

#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {

namespace {

using namespace std::string_literals;

std::atomic<bool> may_go_on{false};
std::atomic<int> waiting{0};
std::atomic<bool> shall_throw{false};
std::atomic<bool> has_thrown{false};
std::atomic<bool> is_answered{false};

void WaitForTheTest() {
  ++waiting;
  may_go_on.wait(false);
  --waiting;
}

void LetGoOn() {
  may_go_on = true;
  may_go_on.notify_all();
}

/// Also of a test that fails.
struct LetGoOnAtTheEnd {
  ~LetGoOnAtTheEnd() { LetGoOn(); }
};

/// Its destructor waits until the test lets it go on.
class SlowToGo final : public Module {
 public:
  using Module::Module;
  ~SlowToGo() override { WaitForTheTest(); }

 private:
  void Update() override {}
};

class FaultyAndSlowToGo final : public Module {
 public:
  using Module::Module;
  ~FaultyAndSlowToGo() override { WaitForTheTest(); }
  Output<int> out{this, "out"};

 private:
  void Update() override { throw std::runtime_error("is faulty"); }
};

class FaultyBeforeLong final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};

 private:
  void Update() override {
    has_thrown = true;
    throw std::runtime_error("is faulty");
  }
};

/// Runs behind that one, in the same cycle, which does not end before the test lets it go on.
class Long final : public Module {
 public:
  using Module::Module;
  Input<int> in{this, "in"};

 private:
  void Update() override {
    if (has_thrown) WaitForTheTest();
  }
};

/// Throws when the test says so.
class Failing final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override {
    if (shall_throw) throw std::runtime_error("has failed");
  }
};

class FaultAnswers : public RealEditorTest {
 protected:
  FaultAnswers() {
    may_go_on = shall_throw = has_thrown = is_answered = false;
    Register<SlowToGo>("test/slow_to_go");
    Register<FaultyAndSlowToGo>("test/faulty_and_slow_to_go");
    Register<FaultyBeforeLong>("test/faulty_before_long");
    Register<Long>("test/long");
    Register<Failing>("test/failing");
    scheduler.AddFaultRule({.of = "/app/failing", .call = [](const Fault&) { is_answered = true; }});
    Must({CreateModule{"/app/failing", "test/failing"}, AssignToThread{"/app/failing", "slow"},
          CreateModule{"/app/old", "test/slow_to_go"}, CreateModule{"/app/counter", "test/counter"},
          CreateModule{"/app/long", "test/long"}, ConnectPorts{"/app/counter/out", "/app/long/in"}});
  }
  ~FaultAnswers() override {
    LetGoOn();
    scheduler.Stop();
  }
  // While somebody waits.
  void AnotherFaultIsAnswered() {
    WaitUntil("one waits", [] { return waiting == 1; });
    shall_throw = true;
    WaitUntil("the rule is applied", [] { return is_answered.load(); });
    EXPECT_EQ(waiting, 1) << "still";
  }
  std::string TypeOfCounter() {
    const std::lock_guard lock(runtime.structure_mutex());
    return FindModuleType(**runtime.root().Find("/app/counter"));
  }
  std::vector<std::string> Messages() {
    std::vector<std::string> messages;
    for (const Fault& each : scheduler.TakeFaults()) messages.push_back(each.message);
    return messages;
  }
};

const std::string kIsBack = "is faulty; the module before (test/counter) is back in its place"s;

}  // namespace

TEST_F(FaultAnswers, DoNotWaitForAModuleThatIsDeleted) {
  ASSERT_TRUE(scheduler.Start());
  auto deleted = std::async(std::launch::async, [&] { return editor.Apply({DeleteElement{"/app/old"}}).is_done; });
  const LetGoOnAtTheEnd at_the_end;
  AnotherFaultIsAnswered();
  LetGoOn();
  EXPECT_TRUE(deleted.get());
}

TEST_F(FaultAnswers, DoNotWaitForAModuleWhoseSuccessorHasProvedItself) {
  ASSERT_TRUE(scheduler.Start());
  auto tended = std::async(std::launch::async, [&] {
    const ChangeOutcome replaced = editor.Apply({ReplaceModule{"/app/old", "test/silent", {}, 1}});
    while (editor.on_probation() > 0) editor.Tend();
    return replaced.is_done;
  });
  const LetGoOnAtTheEnd at_the_end;
  AnotherFaultIsAnswered();
  LetGoOn();
  EXPECT_TRUE(tended.get());
}

TEST_F(FaultAnswers, DoNotWaitForASuccessorThatHasFailed) {
  ASSERT_TRUE(scheduler.Start());
  Must({ReplaceModule{"/app/counter", "test/faulty_and_slow_to_go"}});
  AnotherFaultIsAnswered();
  EXPECT_EQ(TypeOfCounter(), "test/counter");
  LetGoOn();
  scheduler.Stop();
  EXPECT_THAT(Messages(), ::testing::UnorderedElementsAre("has failed", kIsBack));
  EXPECT_EQ(editor.on_probation(), 0u);
}

TEST_F(FaultAnswers, DoNotWaitForTheCycleInWhichASuccessorHasFailed) {
  StructureEditor patient(runtime, modules, &scheduler, {.timeout = 10min});
  const LetGoOnAtTheEnd at_the_end;
  ASSERT_TRUE(scheduler.Start());
  ASSERT_TRUE(patient.Apply({ReplaceModule{"/app/counter", "test/faulty_before_long"}}));
  AnotherFaultIsAnswered();
  EXPECT_EQ(TypeOfCounter(), "test/faulty_before_long");
  LetGoOn();
  WaitUntil("the module before is back", [&] { return TypeOfCounter() == "test/counter"; });
  scheduler.Stop();
  EXPECT_THAT(Messages(), ::testing::UnorderedElementsAre("has failed", kIsBack));
}

}  // namespace runnel::test
