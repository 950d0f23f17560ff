#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "core/module/module.h"
#include "core/module/run_monitor.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/types/surroundings.h"
#include "plugins/parameters/parameter.h"
#include "plugins/services/client.h"
#include "plugins/services/service.h"

namespace runnel::test {

/// Hands on what a planner needs, and fails after a while.
class FaultyRelay final : public Module {
 public:
  using Module::Module;

  Input<Surroundings> in{this, "in", {.required = true}};
  Output<Surroundings> out{this, "out"};
  Parameter<std::uint32_t> good_cycles{this, "good_cycles", {.default_value = 100}};

 private:
  void Update() override {
    if (++cycles_ > good_cycles.Get()) throw std::runtime_error("the relay is worn out");
    if (const auto view = in.Read(); view.is_new()) out.Publish(*view);
  }

  std::uint32_t cycles_ = 0;
};

/// Counts, a value a cycle.
class Counter final : public Module {
 public:
  using Module::Module;

  Output<double> count{this, "count"};
  StaticParameter<double> first{this, "first", {.default_value = 0}};

 private:
  void Update() override { count.Publish(first.Get() + cycles_++); }

  double cycles_ = 0;
};

/// Says what it reads first, and what it reads after a jump.
class Listener final : public Module {
 public:
  using Module::Module;

  Input<double> in{this, "in"};

 private:
  void Update() override {
    const auto value = in.Read();
    if (!value) return;
    if (!has_read_ || *value > last_ + 500) log().Info("reads {}", *value);
    has_read_ = true;
    last_ = *value;
  }

  bool has_read_ = false;
  double last_ = 0;
};

/// Does nothing, and fails after a while: by throwing, by never coming back, by a crash, or by what no cycle should do.
class FaultyWorker final : public Module {
 public:
  using Module::Module;

  Parameter<std::uint32_t> good_cycles{this, "good_cycles", {.default_value = 1'000'000}};
  StaticParameter<bool> hangs{this, "hangs", {.default_value = false}};
  StaticParameter<bool> allocates{this, "allocates", {.default_value = false}};
  StaticParameter<std::string> crashes{this, "crashes", {.default_value = ""}};

 private:
  [[gnu::noinline]] int Overflow(int depth) {
    if (depth < 0) return 0;
    volatile char kept[10'000];
    kept[0] = static_cast<char>(depth);
    return Overflow(depth + 1) + kept[0];
  }
  [[gnu::noinline]] void Crash() {
    const std::string way = crashes.Get();
    if (way == "segmentation") *static_cast<volatile int*>(nowhere_) = 1;
    if (way == "abort") std::abort();
    if (way == "overflow") cycles_ += static_cast<std::uint32_t>(Overflow(0));
    if (way == "illegal") __builtin_trap();
  }

  void Update() override {
    if (cycles_ > good_cycles.Get()) Crash();
    if (allocates.Get()) kept_ = std::make_unique<std::string>(1000, 'x');
    while (hangs.Get()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (++cycles_ > good_cycles.Get() && crashes.Get().empty()) {
      throw std::runtime_error("the worker is worn out");
    }
    if (cycles_ == good_cycles.Get()) log().Warn("{} cycles are enough", cycles_);
  }

  std::unique_ptr<std::string> kept_;
  void* volatile nowhere_ = nullptr;
  std::uint32_t cycles_ = 0;
};

inline void WaitForFile(const std::string& file) {
  while (!file.empty() && !std::filesystem::exists(file)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Is made only when there is the file that its parameter names; until then there is another one, FILE.begun.
class SlowToMake final : public Module {
 public:
  using Module::Module;

  StaticParameter<std::string> made_after{this, "made_after", {.default_value = ""}};

 private:
  Result<void> Construct() override {
    std::ofstream(made_after.Get() + ".begun") << "\n";
    WaitForFile(made_after.Get());
    return {};
  }
  void Update() override {}
};

/// Goes only when there is the file that its parameter names.
class SlowToGo final : public Module {
 public:
  using Module::Module;
  ~SlowToGo() override { WaitForFile(gone_after.Get()); }

  StaticParameter<std::string> gone_after{this, "gone_after", {.default_value = ""}};

 private:
  void Update() override {}
};

/// Has a call that does not come to its end, and makes it when it is connected with itself.
class DeafWorker final : public Module {
 public:
  using Module::Module;

  Service<int(int)> work{this, "work", &DeafWorker::Work};
  Client<int(int)> ask{this, "ask"};

 private:
  Result<int> Work(Activity&, int) {
    log().Info("{}", "works for ever");
    for (;;) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  void Update() override {
    if (std::exchange(has_asked_, true)) return;
    ask.Send(1);
  }

  bool has_asked_ = false;
};

/// A motor, which moves by what it reads, and says when it begins to and when it stands.
class Motor final : public Module {
 public:
  using Module::Module;

  Input<double> speed{this, "speed", {.drives = true, .command = DrivingKind::kVelocity, .safe_value = AnyValue(0.0)}};

 private:
  void Update() override {
    const bool moves = speed.Get() != 0;
    if (moves != moves_) log().Warn("{}", moves ? "moves" : "stands");
    moves_ = moves;
  }

  bool moves_ = false;
};

/// Judges a run, and throws in the function that the parameter names; finishes only when there is a file.
class FaultyMonitor final : public Module {
 public:
  explicit FaultyMonitor(const Placement& placement) : Module(placement) {
    Annotate<RunMonitor>(std::make_unique<Monitor>(*this));
  }

  StaticParameter<std::string> throws_in{this, "throws_in", {.default_value = ""}};
  StaticParameter<std::string> finishes_after{this, "finishes_after", {.default_value = ""}};

 private:
  void ThrowIn(const std::string& function) const {
    if (throws_in.Get() == function) throw std::runtime_error("thrown in " + function);
  }
  void Update() override { ThrowIn("update"); }

  class Monitor final : public RunMonitor {
   public:
    explicit Monitor(const FaultyMonitor& module) : module_(module) {}
    std::string Progress() const override {
      module_.ThrowIn("progress");
      return "going well";
    }
    std::optional<RunOutcome> Outcome() const override {
      module_.ThrowIn("outcome");
      return {};
    }
    Result<std::string> Finish() override {
      module_.ThrowIn("finish");
      WaitForFile(module_.finishes_after.Get());
      if (module_.throws_in.Get() == "nothing") return Error{.message = "cannot be finished"};
      return std::string("finished");
    }

   private:
    const FaultyMonitor& module_;
  };
};

}  // namespace runnel::test
