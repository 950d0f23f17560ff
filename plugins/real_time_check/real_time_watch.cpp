#include "plugins/real_time_check/real_time_watch.h"

#include <algorithm>
#include <array>

#include "core/element/framework_element.h"
#include "plugins/real_time_check/system_call_trap.h"

namespace runnel {

namespace {

constexpr std::size_t kMostPlaces = 8;  // of one task

// By RealTimeOffence.
constexpr std::array<const char*, 4> kVerbs{"allocates", "gives memory back", "locks", "calls the system"};

}  // namespace

// What one task has done. By the thread whose cycle has it.
class RealTimeWatch::Record {
 public:
  explicit Record(std::string path) : path_(std::move(path)) {}

  void Note(RealTimeOffence offence, const char* function, long call, const void* inner, const void* outer) noexcept {
    CallStack stack = CallStack::Take();
    stack.KeepBetween(inner, outer);
    const auto end = places_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto known = std::find_if(places_.begin(), end,
                                    [&](const Place& each) { return each.offence == offence && each.stack == stack; });
    if (known != end) {
      ++known->times;
    } else if (count_ < kMostPlaces) {
      places_[count_++] = {offence, function, call, 1, stack};
    } else {
      ++others_;
    }
  }

  [[nodiscard]] RealTimeBreaches Breaches() const {
    RealTimeBreaches breaches{.path = path_, .breaches = {}, .others = others_};
    for (std::size_t i = 0; i < count_; ++i) {
      const Place& each = places_[i];
      breaches.breaches.push_back(
          {each.offence, each.function != nullptr ? each.function : "system call " + std::to_string(each.call),
           each.times, each.stack});
    }
    return breaches;
  }

 private:
  struct Place {
    RealTimeOffence offence = RealTimeOffence::kAllocation;
    const char* function = nullptr;
    long call = -1;
    std::uint64_t times = 0;
    CallStack stack = {};
  };

  const std::string path_;
  std::array<Place, kMostPlaces> places_{};
  std::size_t count_ = 0;
  std::uint64_t others_ = 0;
};

class RealTimeWatch::Watched final : public WatchedTask {
 public:
  Watched(const RealTimeWatch& watch, BoundCall run, Record& record) : watch_(watch), run_(run), record_(record) {}

  // Not inlined: where it returns to is where the task's own calls end.
  [[gnu::noinline]] void Run() override {
    if (cycles_++ < watch_.first_cycles_) return run_();
    const Scope scope(*this, __builtin_return_address(0));
    run_();
  }

 private:
  // While one lives, this thread is watched. Tasks do not run within tasks.
  class Scope {
   public:
    Scope(Watched& watched, const void* outside) : hooks_(watched.watch_.hooks_) {
      current = {&watched.record_, outside, &hooks_};
      hooks_.Listen([](RealTimeOffence offence, const char* function, const void* caller) noexcept {
        current.record->Note(offence, function, -1, caller, current.outside);
      });
      if (SystemCallTrap::works()) SystemCallTrap::Arm(&OnSystemCall);
    }
    ~Scope() {
      SystemCallTrap::Disarm();
      hooks_.Listen(nullptr);
      current = {};
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    static void OnSystemCall(long call, const void* place) noexcept {
      if (current.hooks->is_within()) return;  // has been told as what it is
      current.record->Note(RealTimeOffence::kSystemCall, nullptr, call, place, current.outside);
    }
    const RealTimeHooks& hooks_;
  };

  struct Current {
    Record* record = nullptr;
    const void* outside = nullptr;
    const RealTimeHooks* hooks = nullptr;
  };
  static thread_local constinit Current current;

  const RealTimeWatch& watch_;
  const BoundCall run_;
  Record& record_;
  std::uint64_t cycles_ = 0;
};

thread_local constinit RealTimeWatch::Watched::Current RealTimeWatch::Watched::current{};

RealTimeWatch::RealTimeWatch(const RealTimeHooks& hooks, std::uint64_t first_cycles)
    : hooks_(hooks), first_cycles_(first_cycles) {
  (void)CallStack::Take();  // the first one loads what unwinds
}
RealTimeWatch::~RealTimeWatch() = default;

std::unique_ptr<WatchedTask> RealTimeWatch::Watch(const Task& task) {
  return std::make_unique<Watched>(*this, task.run, records_.emplace_back(task.element->path()));
}

std::vector<RealTimeBreaches> RealTimeWatch::Breaches() const {
  std::vector<RealTimeBreaches> all;
  for (const Record& record : records_) {
    auto breaches = record.Breaches();
    if (!breaches.breaches.empty()) all.push_back(std::move(breaches));
  }
  return all;
}

std::string RealTimeBreach::ToString() const {
  std::string text = std::string(kVerbs[static_cast<std::size_t>(offence)]) + " in its cycle (" + what + ", " +
                     (times == 1 ? "once" : std::to_string(times) + " times") + "):";
  for (const std::string& call : stack.Texts()) {
    if (call.starts_with("runnel::BoundCall::To<")) break;  // between the two, by Clang
    text += "\n    " + call;
  }
  return text;
}

}  // namespace runnel
