#include "plugins/command_service/command_worker.h"

#include <new>
#include <semaphore>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/element/framework_element.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using Task = std::shared_ptr<WorkerTask>;

TEST(CommandWorker, DoesOneThingAfterTheOther) {
  CommandWorker worker;
  std::counting_semaphore<> done(0);
  std::vector<int> order;
  TaskGroup tasks(worker, [&] { done.release(); });
  std::vector<Task> all;
  for (int i = 0; i < 100; ++i) all.push_back(tasks.Post([&order, i] { order.push_back(i); }));
  for (int i = 0; i < 100; ++i) done.acquire();
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(all[static_cast<std::size_t>(i)]->is_done());
    EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
  }
}

TEST(CommandWorker, NeverDoesThingsOfTwoClientsAtOnce) {
  CommandWorker worker;
  std::atomic<int> at_once{0};
  std::atomic<bool> has_met{false};
  const auto work = [&] {
    if (at_once.fetch_add(1) > 0) has_met = true;
    std::this_thread::yield();
    at_once.fetch_sub(1);
  };
  const auto client = [&] {
    std::counting_semaphore<> done(0);
    TaskGroup tasks(worker);
    for (int i = 0; i < 100; ++i) tasks.Post(work, [&] { done.release(); });
    for (int i = 0; i < 100; ++i) done.acquire();
  };
  std::thread other(client);
  client();
  other.join();
  EXPECT_FALSE(has_met);
}

TEST(CommandWorker, LeavesOutWhatHasBeenCancelledBeforeItBegan) {
  CommandWorker worker;
  std::binary_semaphore may_go(0);
  std::counting_semaphore<> done(0);
  bool has_run = false;
  TaskGroup tasks(worker, [&] { done.release(); });
  tasks.Post([&] { may_go.acquire(); });
  const Task cancelled = tasks.Post([&] { has_run = true; });
  cancelled->Cancel();
  may_go.release();
  done.acquire();
  done.acquire();
  EXPECT_TRUE(cancelled->is_done());
  EXPECT_FALSE(has_run);
}

TEST(CommandWorker, TakesATaskOfSeveralStepsInTurnWithOthers) {
  CommandWorker worker;
  std::counting_semaphore<> done(0);
  std::string order;
  TaskGroup tasks(worker, [&] { done.release(); });
  tasks.Post([&] {
    tasks.PostSteps([&, step = 0]() mutable -> std::optional<Duration> {
      order += "s";
      if (++step == 3) return {};
      return Duration(0);
    });
    tasks.Post([&] { order += "a"; });
  });
  for (int i = 0; i < 3; ++i) done.acquire();
  EXPECT_EQ(order, "sass");
}

TEST(CommandWorker, EndsATaskByWhateverItThrowsAndGoesOn) {
  CommandWorker worker;
  std::counting_semaphore<> done(0);
  TaskGroup tasks(worker, [&] { done.release(); });
  const auto failure_of = [&](std::function<void()> work) {
    const Task task = tasks.Post(std::move(work));
    done.acquire();
    EXPECT_TRUE(task->failure()) << "nothing was told of it";
    return task->failure().value_or(Error{});
  };
  EXPECT_EQ(failure_of([] { throw 1; }).message, "exception of type int");
  EXPECT_EQ(failure_of([] { throw std::bad_alloc(); }).message, "std::bad_alloc");
  EXPECT_EQ(failure_of([] { throw std::runtime_error("is worn out"); }).message, "is worn out");
  EXPECT_EQ(failure_of([] { throw ElementError({.message = "no", .path = "/a"}); }).path, "/a");
  EXPECT_FALSE(tasks.Post([] {})->failure());
}

TEST(CommandWorker, LosesNothingByAClientThatThrowsWhenItIsTold) {
  CommandWorker worker;
  std::binary_semaphore done(0);
  TaskGroup tasks(worker);
  tasks.Post([] {}, [] { throw 1; });
  tasks.Post([] {}, [&] { done.release(); });
  done.acquire();
}

TEST(CommandWorker, WaitsForTheStepOfAGroupThatEnds) {
  CommandWorker worker;
  std::binary_semaphore has_begun(0);
  std::binary_semaphore may_go(0);
  std::atomic<bool> is_over{false};
  std::thread releaser;
  {
    TaskGroup tasks(worker);
    tasks.PostSteps([&]() -> std::optional<Duration> {
      EXPECT_TRUE(CommandWorker::IsThisThread());
      has_begun.release();
      may_go.acquire();
      is_over = true;
      return std::chrono::hours(1);  // but there is no further one
    });
    has_begun.acquire();
    releaser = std::thread([&] { may_go.release(); });
  }
  EXPECT_TRUE(is_over);
  EXPECT_FALSE(CommandWorker::IsThisThread());
  releaser.join();
}

TEST(CommandWorker, DropsWhatAGroupThatEndsHasNotBegun) {
  CommandWorker worker;
  std::binary_semaphore has_begun(0);
  std::binary_semaphore may_go(0);
  std::binary_semaphore done(0);
  bool has_run = false;
  TaskGroup others(worker);
  others.Post([&] {
    has_begun.release();
    may_go.acquire();
  });
  has_begun.acquire();
  {
    TaskGroup tasks(worker);
    tasks.Post([&] { has_run = true; });
  }
  may_go.release();
  others.Post([] {}, [&] { done.release(); });
  done.acquire();
  EXPECT_FALSE(has_run);
}

TEST(CommandWorker, DoesNotWaitForTheStepThatEndsItsOwnGroup) {
  CommandWorker worker;
  std::binary_semaphore done(0);
  auto tasks = std::make_unique<TaskGroup>(worker);
  tasks->Post([&] {
    tasks = nullptr;
    done.release();
  });
  done.acquire();
}

}  // namespace
}  // namespace runnel::test
