#pragma once

#include <atomic>

#include <gmock/gmock.h>

#include "plugins/scheduling/scheduler.h"
#include "tests/plugins/scheduling/test_modules.h"
#include "tests/support/wait_until.h"

namespace runnel {

using test::WaitUntil;

/// Runs the threads as long as it lives: shorter than what the modules refer to.
class Running {
 public:
  explicit Running(Scheduler& scheduler) : scheduler_(scheduler) { MustSucceed(scheduler.Start()); }
  ~Running() { scheduler_.Stop(); }

 private:
  Scheduler& scheduler_;
};

class RealThreads : public ::testing::Test {
 protected:
  void Ready() { MustSucceed(runtime.MakeReady(runtime.root())); }
  Doing& MakeCounter(const std::string& name, std::atomic<int>& count) {
    auto& module = runtime.Create<Doing>(runtime.root(), name);
    module.action = [&count](Doing&) { ++count; };
    return module;
  }

  Runtime runtime;
  Scheduler scheduler{runtime};
};

}  // namespace runnel
