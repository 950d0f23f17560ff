// How long a robot that is driven by hand goes on when nobody is heard of any more: from the last value that the
// service has received to the safe one that readers find, beside the deadline that was asked for; idle, and while
// changes of the structure, which take the same lock, are made one after the other. Prints one table.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/input.h"
#include "plugins/command_service/command_service.h"
#include "plugins/structure/structure_editor.h"

namespace runnel {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr Duration kDeadline = 250ms;  // the panel's
constexpr int kRounds = 40;

class Base final : public Module {
 public:
  using Module::Module;
  Input<double> speed{this, "speed"};

 private:
  void Update() override {}
};

[[noreturn]] void Fail(const std::string& why) {
  std::fprintf(stderr, "bench_driving: %s\n", why.c_str());
  std::exit(1);
}

// As a transport asks, and does not wait.
void Drive(CommandService& service, TaskGroup& tasks, const std::string& lease) {
  const auto pending = service.Begin(PublishRequest{"/base/input/speed", "0.4", {}, kDeadline, lease}, tasks);
  while (!pending->is_done()) std::this_thread::yield();
  if (const CommandAnswer answer = pending->Take(); !answer) Fail(answer.diagnostics.ToString());
}

void Measure(const std::string& name, CommandService& service, const Base& base) {
  TaskGroup tasks(service.worker());
  std::vector<double> late;
  for (int round = 0; round < kRounds; ++round) {
    const auto last_heard = Clock::now();
    Drive(service, tasks, name + std::to_string(round));
    while (base.speed.Get() != 0) std::this_thread::sleep_for(100us);
    late.push_back(Milliseconds(Clock::now() - last_heard).count());
    if (!service.Begin(ReleaseRequest{"/base/input/speed"}, tasks)) Fail("cannot release");
  }
  std::ranges::sort(late);
  std::printf("%-24s %8.1f %8.1f %8.1f\n", name.c_str(), late.front(), late[late.size() / 2], late.back());
}

int Main() {
  Runtime runtime;
  ModuleRegistry modules;
  if (!modules.Add({"bench/base", "", "bench", [](const Placement& placement) {
                      return std::unique_ptr<FrameworkElement>(std::make_unique<Base>(placement));
                    }})) {
    Fail("cannot register");
  }
  auto& base = runtime.Create<Base>(runtime.root(), "base");
  if (!runtime.MakeReady(runtime.root())) Fail("cannot begin");
  StructureEditor editor(runtime, modules, nullptr);
  ApplicationLog log(runtime.clock());
  CommandService service({runtime, modules, editor, log});
  std::printf("deadline %.0f ms, %d rounds    least   median     most (ms)\n", Milliseconds(kDeadline).count(),
              kRounds);
  Measure("idle", service, base);
  std::atomic<bool> ends{false};
  std::thread changing([&] {
    for (int i = 0; !ends; ++i) {
      ChangeSet changes;
      for (int each = 0; each < 100; ++each) {
        const std::string path = "/m" + std::to_string(each);
        if (i % 2 == 0) {
          changes.push_back(CreateModule{path, "bench/base"});
        } else {
          changes.push_back(DeleteElement{path});
        }
      }
      if (!editor.Apply(changes)) Fail("cannot change");
    }
  });
  Measure("while 100 modules change", service, base);
  ends = true;
  changing.join();
  return 0;
}

}  // namespace
}  // namespace runnel

int main() { return runnel::Main(); }
