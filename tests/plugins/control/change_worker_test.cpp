#include "plugins/control/change_worker.h"

#include <semaphore>
#include <vector>

#include <gtest/gtest.h>

namespace runnel::test {

TEST(ChangeWorker, DoesOneThingAfterTheOther) {
  std::counting_semaphore<> done(0);
  std::vector<int> order;
  ChangeWorker worker([&] { done.release(); });
  std::vector<std::shared_ptr<ChangeWorker::Job>> jobs;
  for (int i = 0; i < 100; ++i) jobs.push_back(worker.Post([&order, i] { order.push_back(i); }));
  for (int i = 0; i < 100; ++i) done.acquire();
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(jobs[static_cast<std::size_t>(i)]->is_done());
    EXPECT_EQ(order[static_cast<std::size_t>(i)], i);
  }
}

TEST(ChangeWorker, LeavesOutWhatHasBeenCancelledBeforeItBegan) {
  std::binary_semaphore may_go(0);
  std::counting_semaphore<> done(0);
  bool has_run = false;
  ChangeWorker worker([&] { done.release(); });
  worker.Post([&] { may_go.acquire(); });
  const auto cancelled = worker.Post([&] { has_run = true; });
  cancelled->Cancel();
  may_go.release();
  done.acquire();
  done.acquire();
  EXPECT_TRUE(cancelled->is_done());
  EXPECT_FALSE(has_run);
}

TEST(ChangeWorker, EndsWithoutWhatHasNotBegun) {
  std::binary_semaphore has_begun(0);
  std::binary_semaphore may_go(0);
  bool has_run = false;
  std::thread releaser;
  {
    ChangeWorker worker([] {});
    worker.Post([&] {
      EXPECT_TRUE(ChangeWorker::IsThisThread());
      has_begun.release();
      may_go.acquire();
    });
    has_begun.acquire();
    // Its destruction is asked for, as the first job still runs; then the second would be next.
    releaser = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      may_go.release();
    });
    worker.Post([&] { has_run = true; });
  }
  releaser.join();
  EXPECT_FALSE(has_run);
  EXPECT_FALSE(ChangeWorker::IsThisThread());
}

}  // namespace runnel::test
