// How long it takes until readers of a driving port find its safe value, whatever else goes on: from a request for STOP,
// and from the end of a dead-man's deadline. Prints two tables, in milliseconds; each row has as many tries as are
// asked for (bench_stop TRIES, 1000 by default).

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/own_cycle.h"
#include "plugins/command_service/command_service.h"
#include "plugins/structure/structure_editor.h"

namespace runnel {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

class Base final : public Module {
 public:
  using Module::Module;
  Input<double> speed{this, "speed", {.unit = "m/s", .drives = true}};

 private:
  void Update() override {}
};

class Planner final : public Module {
 public:
  using Module::Module;
  Output<double> speed{this, "speed", {.unit = "m/s"}};

 private:
  void Update() override {}
};

/// Takes its time to be made.
class Slow final : public Module {
 public:
  explicit Slow(const Placement& placement) : Module(placement) { std::this_thread::sleep_for(5s); }

 private:
  void Update() override {}
};

[[noreturn]] void Fail(const std::string& why) {
  std::fprintf(stderr, "bench_stop: %s\n", why.c_str());
  std::exit(1);
}

template <typename T>
void Register(ModuleRegistry& modules, const std::string& name) {
  const auto make = [](const Placement& placement) {
    return std::unique_ptr<FrameworkElement>(std::make_unique<T>(placement));
  };
  if (!modules.Add({name, "", "bench", make})) Fail("cannot register " + name);
}

/// An application with a robot that is driven, and the service that clients use.
struct Robot {
  Robot() {
    Register<Base>(modules, "bench/base");
    Register<Slow>(modules, "bench/slow");
    base = &runtime.Create<Base>(runtime.root(), "base");
    planner = &runtime.Create<Planner>(runtime.root(), "planner");
    if (!Port::Connect(planner->speed, base->speed)) Fail("cannot connect");
    if (!runtime.MakeReady(runtime.root())) Fail("cannot begin");
  }

  Runtime runtime;
  ModuleRegistry modules;
  Base* base = nullptr;
  Planner* planner = nullptr;
  StructureEditor editor{runtime, modules, nullptr};
  ApplicationLog log{runtime.clock()};
  CommandService service{{runtime,
                          modules,
                          editor,
                          log,
                          {.load_plugin = [](const std::string&) -> Result<void> {
                             std::this_thread::sleep_for(5s);
                             return Error{.message = "there is no such plugin"};
                           },
                           .save = [](const std::string&) -> Result<std::string> {
                             std::this_thread::sleep_for(5s);
                             return std::string("saved");
                           }}}};
};

/// What goes on meanwhile: called again and again by threads of their own, until the row ends.
struct Load {
  std::string name;
  std::function<void(Robot& robot, TaskGroup& tasks)> act = {};
  int threads = 1;
};

void Carry(Robot& robot, TaskGroup& tasks, CommandRequest request) {
  const auto pending = robot.service.Begin(std::move(request), tasks);
  while (!pending->is_done()) std::this_thread::sleep_for(1ms);
}

ChangeRequest ChangesOf(ChangeSet changes) {
  ChangeRequest request;
  request.placed.positions.resize(changes.size());
  request.placed.changes = std::move(changes);
  return request;
}

std::vector<Load> Loads() {
  const int cores = static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
  return {
      {"nothing else"},
      {"a constructor of 5 s",
       [](Robot& robot, TaskGroup& tasks) {
         Carry(robot, tasks, ChangesOf({CreateModule{"/slow", "bench/slow"}}));
         Carry(robot, tasks, ChangesOf({DeleteElement{"/slow"}}));
       }},
      {"a library that loads 5 s",
       [](Robot& robot, TaskGroup& tasks) {
         Carry(robot, tasks, ChangesOf({CreateModule{"/other", "elsewhere/other"}}));
       }},
      {"sets of 1,000 changes",
       [](Robot& robot, TaskGroup& tasks) {
         ChangeSet create, remove;
         for (int i = 0; i < 1000; ++i) {
           create.push_back(CreateGroup{"/group" + std::to_string(i)});
           remove.push_back(DeleteElement{"/group" + std::to_string(i)});
         }
         Carry(robot, tasks, ChangesOf(create));
         Carry(robot, tasks, ChangesOf(remove));
       }},
      {"a save of 5 s", [](Robot& robot, TaskGroup& tasks) { Carry(robot, tasks, SaveRequest{}); }},
      {"the structure's lock held",
       [](Robot& robot, TaskGroup&) {
         const std::lock_guard lock(robot.runtime.structure_mutex());
         std::this_thread::sleep_for(2s);
       }},
      {"a cycle of 2 s in another thread",
       [](Robot& robot, TaskGroup&) {
         const OwnCycle cycle(robot.runtime.clock().Now());
         std::this_thread::sleep_for(2s);
       }},
      {"a client that floods",
       [](Robot& robot, TaskGroup& tasks) {
         std::vector<std::unique_ptr<PendingCommand>> all;
         for (int i = 0; i < 1000; ++i) all.push_back(robot.service.Begin(UndoRequest{}, tasks));
         while (!all.back()->is_done()) std::this_thread::sleep_for(1ms);
       }},
      {"50 viewers",
       [](Robot& robot, TaskGroup&) {
         robot.base->speed.VisitLatest([](const void*, ValueTimes) {});
         std::this_thread::sleep_for(1ms);
       },
       50},
      {"all cores busy",
       [](Robot&, TaskGroup&) {
         const auto until = Clock::now() + 10ms;
         while (Clock::now() < until) {
         }
       },
       2 * cores},
  };
}

/// The load, for as long as this lives.
class Burden {
 public:
  Burden(const Load& load, Robot& robot) {
    for (int i = 0; load.act && i < load.threads; ++i) {
      threads_.emplace_back([&] {
        TaskGroup tasks(robot.service.worker());
        while (!ends_) load.act(robot, tasks);
      });
    }
    std::this_thread::sleep_for(50ms);
  }
  ~Burden() {
    ends_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  std::atomic<bool> ends_{false};
  std::vector<std::thread> threads_;
};

void PrintRow(const Load& load, std::vector<double> times) {
  std::ranges::sort(times);
  const auto at = [&](double part) {
    const auto place = static_cast<std::size_t>(part * static_cast<double>(times.size()));
    return times[std::min(times.size() - 1, place)];
  };
  std::printf("%-40s %9.3f %9.3f %9.3f\n", load.name.c_str(), at(0.5), at(0.99), times.back());
  std::fflush(stdout);
}

double Since(Clock::time_point begin) { return Milliseconds(Clock::now() - begin).count(); }

void UntilRead(const Robot& robot, bool is_moving) {
  const auto limit = Clock::now() + 10s;
  while ((robot.base->speed.Get() != 0) != is_moving) {
    if (Clock::now() > limit) Fail(is_moving ? "the robot does not move" : "the robot moves on");
  }
}

void MeasureStop(const Load& load, int tries) {
  Robot robot;
  TaskGroup tasks(robot.service.worker());
  const Burden burden(load, robot);
  std::vector<double> times;
  for (int i = 0; i < tries; ++i) {
    robot.planner->speed.Publish(0.4);
    UntilRead(robot, true);
    const auto begin = Clock::now();
    (void)robot.service.Begin(RobotStopRequest{true, "bench"}, tasks);
    UntilRead(robot, false);
    times.push_back(Since(begin));
    (void)robot.service.Begin(RobotStopRequest{false, "bench"}, tasks);
  }
  PrintRow(load, std::move(times));
}

// Driven before the load begins, and not heard of again.
void MeasureDeadMan(const Load& load, int tries) {
  constexpr Duration kDeadline = 250ms;
  Robot robot;
  TaskGroup tasks(robot.service.worker());
  std::vector<double> times;
  for (int i = 0; i < tries; ++i) {
    const auto begin = Clock::now();
    const auto pending = robot.service.Begin(
        PublishRequest{"/base/input/speed", "0.4", {}, kDeadline, "try " + std::to_string(i)},
        tasks);
    while (!pending->is_done()) std::this_thread::yield();
    if (const CommandAnswer answer = pending->Take(); !answer) Fail(answer.diagnostics.ToString());
    UntilRead(robot, true);
    const Burden burden(load, robot);
    UntilRead(robot, false);
    times.push_back(Since(begin) - Milliseconds(kDeadline).count());
    (void)robot.base->speed.Release();
  }
  PrintRow(load, std::move(times));
}

int Main(int tries) {
  const char* const kHead = "%-40s %9s %9s %9s\n";
  std::printf(kHead, "STOP: from request to reader (ms)", "p50", "p99", "max");
  for (const Load& load : Loads()) MeasureStop(load, tries);
  std::printf(kHead, "dead-man: after its deadline (ms)", "p50", "p99", "max");
  for (const Load& load : Loads()) MeasureDeadMan(load, std::max(1, tries / 50));
  return 0;
}

}  // namespace
}  // namespace runnel

int main(int argc, char** argv) {
  return runnel::Main(argc > 1 ? std::max(1, std::atoi(argv[1])) : 1000);
}
