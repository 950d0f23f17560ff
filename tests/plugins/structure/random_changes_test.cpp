#include "tests/plugins/structure/random_changes.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <gmock/gmock.h>

#include "plugins/structure/structure_editor.h"

namespace runnel::test {

namespace {

std::size_t SetsPerThread() {
  const char* const asked = std::getenv("RUNNEL_RANDOM_CHANGES");
  return asked != nullptr ? std::strtoul(asked, nullptr, 10) : 3'000;
}

}  // namespace

TEST(RandomChanges, LeaveTheStructureThatASimpleModelHas) {
  Runtime runtime;
  ModuleRegistry modules;
  RegisterRandomTypes(modules);
  Scheduler scheduler(runtime, {.default_thread = "one"});
  CreateThread(runtime, "one", {.activation = ThreadOptions::Activation::kFreeRunning});
  CreateThread(runtime, "two", {.period = std::chrono::microseconds(200)});
  auto& app = runtime.Create<Group>(runtime.root(), "app");
  constexpr std::uint32_t kThreads = 3;
  for (std::uint32_t i = 0; i < kThreads; ++i) {
    runtime.Create<Group>(app, "w" + std::to_string(i));
  }
  // Something that publishes all the time, whatever the others have.
  ASSERT_TRUE(modules.Create("random/source", app, "always"));
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  StructureEditor editor(runtime, modules, &scheduler);
  ASSERT_TRUE(scheduler.Start());

  std::atomic<std::size_t> accepted{0};
  std::atomic<std::size_t> refused{0};
  const auto change_at_random = [&](std::uint32_t number) {
    const std::string top = "/app/w" + std::to_string(number);
    StructureModel model(top);
    RandomChanges random(number, top);
    for (std::size_t i = 0; i < SetsPerThread(); ++i) {
      const ChangeSet changes = random.Next(model);
      const std::string before = model.Text();
      const bool expected = model.Apply(changes);
      const ChangeOutcome outcome = editor.Apply(changes);
      ASSERT_EQ(outcome.is_done, expected) << TextOf(changes) << outcome.diagnostics.ToString() << "with\n" << before;
      ASSERT_EQ(LiveText(runtime, top), model.Text()) << TextOf(changes) << "with\n" << before;
      ++(expected ? accepted : refused);
    }
  };
  std::vector<std::thread> threads;
  for (std::uint32_t i = 0; i < kThreads; ++i) threads.emplace_back(change_at_random, i);
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(accepted.load(), kThreads * SetsPerThread() / 10);
  EXPECT_GT(refused.load(), kThreads * SetsPerThread() / 10);
  EXPECT_THAT(scheduler.TakeFaults(), ::testing::IsEmpty());
  scheduler.Stop();
}

}  // namespace runnel::test
