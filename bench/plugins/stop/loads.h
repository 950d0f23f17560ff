#pragma once

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "bench/plugins/stop/robot.h"

namespace runnel::bench {

/// What goes on while STOP is pressed. Each of the threads begins it, and calls what that has returned again and again.
struct Load {
  using Step = std::function<void()>;

  std::string name;
  std::function<Step(Robot& robot, TaskGroup& tasks)> begin = {};
  int threads = 1;
  bool fills_page = false;  ///< a page in a browser, too, has another connection that is saturated
  Driver driver = Driver::kPlanner;
};

[[nodiscard]] std::vector<Load> Loads();

/// A load, for as long as this lives.
class Burden {
 public:
  Burden(const Load& load, Robot& robot);
  ~Burden();
  Burden(const Burden&) = delete;
  Burden& operator=(const Burden&) = delete;

 private:
  std::vector<std::thread> threads_;
};

}  // namespace runnel::bench
