// The table of losses: each value on the way from a sensor to the wheels is lost in each way, in each demonstration that
// drives in one process. The robot stands within the stated time, and goes on when the value is back.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/plugin/module_type_name.h"
#include "core/port/port.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "modules/types/algorithm/pose.h"
#include "plugins/services/callable.h"
#include "plugins/services/cycle_work.h"
#include "tests/integration/application_run.h"
#include "tests/integration/printed_losses.h"
#include "tests/integration/values_on_the_way.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

constexpr Duration kLost = 6s, kBack = 36s, kEnd = 48s;
constexpr Duration kStated = 1500ms;  // the time-out of 0.5 s, then drive and body come to rest

enum class Loss {
  kNeverComes,
  kCeases,
  kDisconnected,
  kStale,
  kNotMeasured,
  kPartly,
  kNoNumber,
  kDeleted,
  kSwapped,
  kStuck
};
constexpr std::array kLosses = {Loss::kNeverComes,  Loss::kCeases, Loss::kDisconnected, Loss::kStale,
                                Loss::kNotMeasured, Loss::kPartly, Loss::kNoNumber,     Loss::kDeleted,
                                Loss::kSwapped,     Loss::kStuck};

Spoil SpoilOf(const OnTheWay& value, Loss loss) {
  if (loss == Loss::kNoNumber) return value.no_number;
  if (loss == Loss::kPartly) return value.partly;
  return loss == Loss::kNotMeasured ? value.not_measured : nullptr;
}

double Moved(const Pose2& before, const Pose2& after) {
  return std::hypot(after.x - before.x, after.y - before.y) + std::abs(after.heading - before.heading);
}
double Moved(const ApplicationRun& run, Duration from, Duration to) {
  double moved = 0;
  const auto cycle = [&](Duration at) { return static_cast<std::size_t>(at / 50ms); };
  for (std::size_t i = cycle(from) + 1; i < std::min(cycle(to), run.truth.size()); ++i) {
    moved += Moved(run.truth[i - 1], run.truth[i]);
  }
  return moved;
}

Port& PortAt(FrameworkElement& application, const std::string& path) {
  std::string full = path.substr(1);
  full.insert(full.rfind('/'), "/output");
  return dynamic_cast<Port&>(**application.Find(full));
}

FrameworkElement& ElementAt(FrameworkElement& application, const std::string& path) {
  return **application.Find(path.substr(1));
}

/// The call that sends a robot, if it has to be sent.
class Sending {
 public:
  explicit Sending(const Demo& demo) : demo_(demo) {}
  void Begin(RunningApplication& run) {
    if (demo_.activity.empty()) return;
    const std::lock_guard lock(run.runtime.structure_mutex());
    auto& callable = *(*run.application.Find(demo_.activity))->FindAnnotation<Callable>();
    call_ = callable.NewCall();
    (void)SetFromText(*callable.arguments(), demo_.arguments, call_->arguments());
    if (call_->Begin(run.runtime.clock().Now(), 1h) != CallStatus::kPending) throw std::runtime_error(call_->error());
  }
  /// While the application is there.
  void End() { call_.reset(); }

 private:
  const Demo& demo_;
  std::unique_ptr<AnyCall> call_;
};

/// What is done to the running application, and taken back.
class Losing {
 public:
  Losing(const OnTheWay& value, Loss loss) : value_(value), loss_(loss), spoil_(SpoilOf(value, loss)) {}

  void Begin(RunningApplication& run) {
    switch (loss_) {
      case Loss::kNeverComes:
      case Loss::kDisconnected:
        return Apply(run, {DisconnectPorts{value_.output, value_.input}});
      case Loss::kDeleted:
        return Apply(run, {DeleteElement{value_.source}});
      case Loss::kSwapped:
        return Apply(run, {ReplaceModule{.path = value_.source,
                                         .type = FindModuleType(ElementAt(run.application, value_.source))}});
      case Loss::kCeases:
        return Pause(run, true);
      default:
        return Hold(run);
    }
  }
  /// In each cycle, as somebody does who measures nothing, with a new stamp each time.
  void GoOn(RunningApplication& run) {
    if (spoil_ != nullptr) Hold(run);
  }
  void End(RunningApplication& run) {
    switch (loss_) {
      case Loss::kNeverComes:
      case Loss::kDisconnected:
        return Apply(run, {ConnectPorts{value_.output, value_.input}});
      case Loss::kDeleted:
        if (const auto undone = run.history.Undo(); !undone) throw std::runtime_error(undone.diagnostics.ToString());
        return;
      case Loss::kSwapped:
        return;
      case Loss::kCeases:
        return Pause(run, false);
      default:
        PortAt(run.application, value_.output).Release();
    }
  }

 private:
  static void Apply(RunningApplication& run, const ChangeSet& changes) {
    const ChangeOutcome outcome = run.history.Apply(changes);
    if (!outcome) throw std::runtime_error(outcome.diagnostics.ToString());
  }
  void Pause(RunningApplication& run, bool is_paused) {
    const std::string path = ElementAt(run.application, value_.source).path();
    if (auto set = run.scheduler.SetPaused(path, is_paused); !set) throw std::runtime_error(set.error().ToString());
  }
  void Hold(RunningApplication& run) {
    Port& port = PortAt(run.application, value_.output);
    const std::shared_ptr<void> last = port.type().Make();
    port.VisitLatest([&](const void* now, ValueTimes) { (void)CopyValue(port.type(), now, last.get()); });
    const auto filled = port.PublishByHand([&](void* to) -> Result<void> {
      (void)CopyValue(port.type(), last.get(), to);
      if (spoil_ != nullptr) spoil_(to);
      return {};
    });
    if (!filled) throw std::runtime_error(filled.error().ToString());
  }

  const OnTheWay& value_;
  const Loss loss_;
  const Spoil spoil_;
};

ApplicationChoice ChoiceOf(const Demo& demo) {
  ApplicationChoice choice{.name = demo.file, .arguments = {"world=" RUNNEL_XML "/worlds/rooms.xml"}, .limit = kEnd};
  if (demo.activity.empty()) choice.arguments.emplace_back("picture=");
  return choice;
}

/// What is in the cell: "stands, goes on", or what it does instead.
std::string Try(const Demo& demo, const OnTheWay& value, Loss loss) {
  const bool needs_spoil = loss == Loss::kNoNumber || loss == Loss::kPartly || loss == Loss::kNotMeasured;
  if (needs_spoil && SpoilOf(value, loss) == nullptr) return "-";
  ApplicationChoice choice = ChoiceOf(demo);
  const Duration lost = loss == Loss::kNeverComes ? Duration{} : kLost;
  // What does not know any more where it was going has to be sent anew.
  const bool is_sent_anew = value.source == "/guide" && (loss == Loss::kDeleted || loss == Loss::kSwapped);
  Losing losing(value, loss);
  Sending sending(demo);
  bool is_lost = false;
  choice.each_step = [&](RunningApplication& run, Duration passed) {
    if (passed == lost && !std::exchange(is_lost, true)) losing.Begin(run);  // the first cycle is that of 0 s
    if (passed > lost && passed < kBack) losing.GoOn(run);
    if (passed == kBack) losing.End(run);
    if (passed == 50ms || (is_sent_anew && passed == kBack + 50ms)) sending.Begin(run);
    if (passed == kEnd - 50ms || (is_sent_anew && passed == kLost - 50ms)) sending.End();
  };
  const ApplicationRun run = RunApplication(choice);
  if (!run.faults.empty()) return "fault: " + run.faults.front().message;
  if (loss != Loss::kNeverComes && Moved(run, kLost - 1s, kLost) < 0.05) return "did not drive before";
  const Duration rested = lost + kStated;
  const Duration stands_until = value.has_stand_in ? std::min(lost + 4s, run.duration) : kBack;
  const bool has_stood = Moved(run, rested, stands_until) <= 1e-6 && run.duration >= stands_until;
  if (!has_stood && loss != Loss::kSwapped) return "DRIVES ON";
  const auto is_of_it = [&](const auto& warning) { return warning.first >= lost && warning.first <= rested; };
  if (loss != Loss::kSwapped && std::ranges::none_of(run.warnings, is_of_it)) return "stands, is NOT TOLD";
  if (!run.outcome && Moved(run, kBack, kEnd) < 0.5) return "stands for ever";
  if (run.outcome && run.outcome->verdict != "reached") return "is then " + run.outcome->verdict;
  if (!has_stood) return "goes on";
  if (value.has_stand_in && Moved(run, stands_until, kBack) > 0.5) return "stands, then drives by another, goes on";
  return "stands, goes on";
}

/// Has a module not return from its cycle.
class Stuck final : public CyclePart {
 public:
  void BeforeUpdate() override {
    while (is_stuck) std::this_thread::sleep_for(5ms);
  }
  void SetWaker(Waker*) override {}
  std::atomic<bool> is_stuck{false};
};

double MovesWithin(RunningApplication& run, Duration time) {
  const auto& pose = dynamic_cast<const Port&>(**run.application.Find("world/sensor_output/pose"));
  Pose2 before, now;
  const auto look = [&] {
    pose.VisitLatest([&](const void* value, ValueTimes) { now = *static_cast<const Pose2*>(value); });
    return Moved(std::exchange(before, now), now);
  };
  (void)look();
  double moved = 0;
  for (; time > Duration{}; time -= 50ms, moved += look()) std::this_thread::sleep_for(50ms);
  return moved;
}
bool Waits(RunningApplication& run, bool drives) {
  for (int i = 0; i < 120; ++i) {
    if ((MovesWithin(run, 500ms) > 1e-6) == drives) return true;
  }
  return false;
}

/// The same of a source that is stuck in a thread of its own for 3 s, on the machine's clock.
std::string TryStuck(const Demo& demo, const OnTheWay& value) {
  ApplicationChoice choice = ChoiceOf(demo);
  choice.replace = {{demo.activity.empty() ? "\"simulated\" speed=\"10\"" : "\"simulated\" speed=\"5\"", "\"real\""}};
  std::string cell;
  UseApplication(choice, [&](RunningApplication& run) {
    Stuck stuck;
    CycleWork* const work = CycleWork::Add(ElementAt(run.application, value.source), stuck);
    const auto changed = run.history.Apply({AddThread{"own", {.period = 50ms}}, AssignToThread{value.source, "own"}});
    if (!changed) throw std::runtime_error(changed.diagnostics.ToString());
    if (auto started = run.scheduler.Start(); !started) throw std::runtime_error(started.error().ToString());
    Sending sending(demo);
    sending.Begin(run);
    cell = [&] {
      if (!Waits(run, true)) return "did not drive before";
      stuck.is_stuck = true;
      if (!Waits(run, false) || MovesWithin(run, 2500ms) > 1e-6) return "DRIVES ON";
      stuck.is_stuck = false;
      return Waits(run, true) ? "stands, goes on" : "stands for ever";
    }();
    stuck.is_stuck = false;
    run.scheduler.Stop();
    sending.End();
    work->Remove(stuck);
  });
  return cell;
}

void ExpectStands(const std::string& cell) {
  for (const char* fault : {"DRIVES ON", "NOT TOLD", "for ever", "fault", "is then", "did not"})
    EXPECT_THAT(cell, testing::Not(testing::HasSubstr(fault)));
}

// Who drives in the place of another has measurements of its own.
TEST(Losses, WhoDrivesInsteadStandsWithoutItsMeasurements) {
  const ApplicationRun run =
      RunApplication({.name = "behaviour_demo.xml",
                      .arguments = {"world=" RUNNEL_XML "/worlds/rooms.xml", "picture="},
                      .limit = kBack,
                      .changes = {{kLost, {DisconnectPorts{"/network/drive/twist", "/network/motion/in1"}}},
                                  {20s, {DisconnectPorts{"/eyes/surroundings", "/network/surroundings"}}}}});
  EXPECT_GT(Moved(run, kLost + 4s, 20s), 0.5);
  EXPECT_LE(Moved(run, 20s + kStated, kBack), 1e-6);
  EXPECT_GE(run.duration, kBack) << "nor has it met anything";
}

TEST(Losses, TheTableThatIsPrintedHasTheseRows) {
  auto printed = Printed();
  EXPECT_THAT(printed["value"], testing::ElementsAre("never comes", "ceases", "disconnected", "stale", "not measured",
                                                     "partly not measured", "no number", "source deleted",
                                                     "source swapped", "source stuck"));
  for (const Row& each : Rows()) EXPECT_EQ(printed[each.name()].size(), kLosses.size()) << each.name();
  for (const auto& [name, cells] : printed) {  // those of other processes are tried by tests/apps/python/test_losses.py
    const bool is_ours = name != "value" && !name.starts_with("python/") && !name.starts_with("two processes/");
    EXPECT_EQ(is_ours, std::ranges::count(Rows(), name, &Row::name) == 1) << name;
  }
}

// A test for each value, so that they run beside each other.
class LossOf : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Losses, LossOf, testing::Range(std::size_t{0}, Rows().size()),
                         [](const auto& at) { return AsTestName(Rows()[at.param].name()); });

TEST_P(LossOf, ARobotThatDoesNotKnowStands) {
  const Row& row = Rows()[GetParam()];
  const std::vector<std::string> printed = Printed()[row.name()];
  ASSERT_EQ(printed.size(), kLosses.size());
  for (std::size_t i = 0; i < kLosses.size(); ++i) {
    if (kLosses[i] == Loss::kStuck) continue;
    const std::string cell = Try(row.demo, row.value, kLosses[i]);
    EXPECT_EQ(cell, printed[i]) << "column " << i;
    ExpectStands(cell);
  }
}

class StuckSourceOf : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Losses, StuckSourceOf, testing::Range(std::size_t{0}, Demos().size()),
                         [](const auto& at) { return AsTestName(Demos()[at.param].file); });

TEST_P(StuckSourceOf, ARobotThatDoesNotKnowStands) {
  const std::string file = Demos()[GetParam()].file;
  auto printed = Printed();
  std::vector<std::pair<std::string, std::future<std::string>>> cells;  // they wait more than they work
  for (const Row& row : Rows()) {
    if (row.demo.file != file) continue;
    cells.emplace_back(row.name(), std::async(std::launch::async, [&row] { return TryStuck(row.demo, row.value); }));
  }
  for (auto& [name, future] : cells) {
    const std::string cell = future.get();
    ASSERT_EQ(printed[name].size(), kLosses.size()) << name;
    EXPECT_EQ(cell, printed[name].back()) << name;
    ExpectStands(cell);
  }
}

}  // namespace
}  // namespace runnel::test
