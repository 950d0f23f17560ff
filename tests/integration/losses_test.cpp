// The table of losses: each value on the way from a sensor to the wheels is lost in each way, in each demonstration that drives
// by its own clock. The robot stands within the stated time, and goes on when the value is back.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/plugin/module_registry.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/input_base.h"
#include "core/port/port.h"
#include "core/port/port_stop.h"
#include "core/types/value_copy.h"
#include "modules/types/algorithm/infrared_ranges.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/range_scan.h"
#include "modules/types/algorithm/surroundings.h"
#include "modules/types/algorithm/wheel_speeds.h"
#include "tests/integration/application_run.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr Duration kLost = 6s, kBack = 36s, kEnd = 48s;
constexpr Duration kStated = 1500ms;  // the time-out of 0.5 s, then drive and body come to rest

using Spoil = void (*)(void*);
template <typename T>
void Reset(void* value) {
  *static_cast<T*>(value) = T{};
}
template <typename T>
void SpoilNumbers(void* value) {
  auto& spoiled = *static_cast<T*>(value);
  if constexpr (std::is_same_v<T, Pose2>) spoiled = {kNaN, kNaN, kNaN};
  if constexpr (std::is_same_v<T, Twist2>) spoiled = {kNaN, kNaN};
  if constexpr (std::is_same_v<T, WheelSpeeds>) spoiled = {kNaN, kNaN};
  if constexpr (std::is_same_v<T, InfraredRanges>) spoiled.front = kNaN;
  if constexpr (std::is_same_v<T, RangeScan>)
    std::ranges::fill(spoiled.ranges, static_cast<float>(kNaN));
}

/// A value on the way to the wheels.
struct OnTheWay {
  std::string output;  ///< as changes name it
  std::string input;   ///< that it goes to
  std::string source;  ///< the module that publishes it
  Spoil no_number = nullptr;
  Spoil not_measured = nullptr;
  bool has_stand_in =
      false;  ///< after 4 s without coming nearer, another behaviour drives, by measurements of its own
};
struct Demo {
  std::string file;
  std::vector<OnTheWay> values;
};

std::vector<OnTheWay> BugWay(OnTheWay sensor) {
  return {{"/localisation/pose", "/robot/pose", "/localisation", SpoilNumbers<Pose2>},
          std::move(sensor),
          {"/robot/eyes/surroundings", "/robot/planner/surroundings", "/robot/eyes", nullptr,
           Reset<Surroundings>},
          {"/robot/planner/twist", "/robot/gate/wanted", "/robot/planner", SpoilNumbers<Twist2>},
          {"/robot/gate/allowed", "/robot/drive/twist", "/robot/gate", SpoilNumbers<Twist2>},
          {"/robot/drive/wheels", "/robot/wheels", "/robot/drive", SpoilNumbers<WheelSpeeds>}};
}
const OnTheWay kScan{"/laser/scan", "/robot/scan", "/laser", SpoilNumbers<RangeScan>,
                     Reset<RangeScan>};
const OnTheWay kRanges{"/infrared/ranges", "/robot/ranges", "/infrared",
                       SpoilNumbers<InfraredRanges>, Reset<InfraredRanges>};

std::vector<Demo> Demos() {
  return {{"bug_demo.xml", BugWay(kScan)},
          {"bug_infrared.xml", BugWay(kRanges)},
          {"behaviour_demo.xml",
           {{"/localisation/pose", "/network/pose", "/localisation", SpoilNumbers<Pose2>},
            {"/laser/scan", "/eyes/scan", "/laser", SpoilNumbers<RangeScan>, Reset<RangeScan>},
            {"/eyes/surroundings", "/network/surroundings", "/eyes", nullptr, Reset<Surroundings>},
            {"/network/drive/twist", "/network/motion/in1", "/network/drive", SpoilNumbers<Twist2>,
             nullptr, true},
            {"/network/avoid/activity", "/network/motion/activity2", "/network/avoid"},
            {"/network/emergency_stop/activity", "/network/safe_motion/activity1",
             "/network/emergency_stop"},
            {"/network/motion/out", "/network/emergency_stop/wanted", "/network/motion",
             SpoilNumbers<Twist2>},
            {"/network/safe_motion/out", "/network/twist", "/network/safe_motion",
             SpoilNumbers<Twist2>},
            {"/gate/allowed", "/wheels/twist", "/gate", SpoilNumbers<Twist2>},
            {"/wheels/wheels", "/world/wheels", "/wheels", SpoilNumbers<WheelSpeeds>}}}};
}

enum class Loss { kNeverComes, kCeases, kDisconnected, kStale, kNotMeasured, kNoNumber, kDeleted };
constexpr std::array kLosses = {Loss::kNeverComes, Loss::kCeases,      Loss::kDisconnected,
                                Loss::kStale,      Loss::kNotMeasured, Loss::kNoNumber,
                                Loss::kDeleted};

double Moved(const ApplicationRun& run, Duration from, Duration to) {
  double moved = 0;
  const auto cycle = [&](Duration at) { return static_cast<std::size_t>(at / 50ms); };
  for (std::size_t i = cycle(from) + 1; i < std::min(cycle(to), run.truth.size()); ++i) {
    const Pose2 &before = run.truth[i - 1], &after = run.truth[i];
    moved += std::hypot(after.x - before.x, after.y - before.y) +
             std::abs(after.heading - before.heading);
  }
  return moved;
}

Port& PortAt(FrameworkElement& application, const std::string& path) {
  std::string full = path.substr(1);
  full.insert(full.rfind('/'), "/output");
  return dynamic_cast<Port&>(**application.Find(full));
}

/// What is in the cell: "stands, goes on", or what it does instead.
std::string Try(const Demo& demo, const OnTheWay& value, Loss loss) {
  const Spoil spoil = loss == Loss::kNoNumber      ? value.no_number
                      : loss == Loss::kNotMeasured ? value.not_measured
                                                   : nullptr;
  if ((loss == Loss::kNoNumber || loss == Loss::kNotMeasured) && spoil == nullptr) return "-";
  ApplicationChoice choice{.name = demo.file,
                           .arguments = {"world=" RUNNEL_XML "/worlds/rooms.xml", "picture="},
                           .limit = kEnd};
  const Duration lost = loss == Loss::kNeverComes ? Duration{} : kLost;
  const auto hold = [&](FrameworkElement& application, bool afresh) {
    Port& port = PortAt(application, value.output);
    std::shared_ptr<void> last = port.type().Make();
    port.VisitLatest(
        [&](const void* now, ValueTimes) { (void)CopyValue(port.type(), now, last.get()); });
    const auto filled = port.PublishByHand([&](void* to) -> Result<void> {
      (void)CopyValue(port.type(), last.get(), to);
      if (afresh) spoil(to);
      return {};
    });
    if (!filled) throw std::runtime_error(filled.error().ToString());
  };
  switch (loss) {
    case Loss::kNeverComes:
    case Loss::kDisconnected:
      choice.changes = {{lost, {DisconnectPorts{value.output, value.input}}},
                        {kBack, {ConnectPorts{value.output, value.input}}}};
      break;
    case Loss::kDeleted:
      choice.changes = {{lost, {DeleteElement{value.source}}}};
      break;
    case Loss::kCeases:
      choice.each_step = [&](FrameworkElement& application, Scheduler& scheduler, Duration passed) {
        if (passed != kLost && passed != kBack) return;
        const std::string path = (*application.Find(value.source.substr(1)))->path();
        if (auto set = scheduler.SetPaused(path, passed == kLost); !set)
          throw std::runtime_error(set.error().ToString());
      };
      break;
    case Loss::kStale:
    case Loss::kNotMeasured:
    case Loss::kNoNumber:
      choice.each_step = [&](FrameworkElement& application, Scheduler&, Duration passed) {
        if (passed == kBack) PortAt(application, value.output).Release();
        if (passed < lost || passed >= kBack || (spoil == nullptr && passed != lost)) return;
        hold(application, spoil != nullptr);
      };
      break;
  }
  const ApplicationRun run = RunApplication(choice);
  if (!run.faults.empty()) return "fault: " + run.faults.front().message;
  if (loss != Loss::kNeverComes && Moved(run, kLost - 1s, kLost) < 0.05)
    return "did not drive before";
  const Duration rested = lost + kStated;
  const Duration stands_until = value.has_stand_in ? std::min(lost + 4s, run.duration) : kBack;
  if (Moved(run, rested, stands_until) > 1e-6 || run.duration < stands_until) return "DRIVES ON";
  if (loss == Loss::kDeleted) return "stands";
  if (value.has_stand_in && Moved(run, stands_until, kBack) > 0.5)
    return "stands, then drives by another";
  if (!run.outcome && Moved(run, kBack, kEnd) < 0.5) return "stands for ever";
  if (run.outcome && run.outcome->verdict != "reached") return "is then " + run.outcome->verdict;
  return "stands, goes on";
}

std::string Table() {
  std::ostringstream table;
  table << "| value | never comes | ceases | disconnected | stale | not measured | no number | "
           "source deleted |\n"
           "|---|---|---|---|---|---|---|---|\n";
  for (const Demo& demo : Demos()) {
    for (const OnTheWay& value : demo.values) {
      table << "| " << demo.file.substr(0, demo.file.find('.')) << value.output << " |";
      for (const Loss loss : kLosses) table << " " << Try(demo, value, loss) << " |";
      table << "\n";
    }
  }
  return table.str();
}

// A module type that commands a motion says of each input whether what comes there grows old.
TEST(Losses, ModuleTypesThatCommandAMotionSayWhatGrowsOld) {
  PluginManager plugins;
  for (const char* plugin : {"adaptors", "behaviours", "flow", "guide", "motion", "places",
                             "planning", "sensors", "signal", "simulation"}) {
    ASSERT_TRUE(plugins.Load(plugin)) << plugin;
  }
  std::vector<std::string> unsaid;
  int commanding = 0;
  for (const ModuleType* type : plugins.modules().All()) {
    Runtime runtime;
    const auto made = plugins.modules().CreateSample(type->name, runtime.root());
    ASSERT_TRUE(made) << made.error().ToString();
    std::vector<std::string> found;
    bool commands = false;
    (*made)->Visit([&](FrameworkElement& element) {
      if (const auto* input = dynamic_cast<InputBase*>(&element)) {
        if (input->ageing() == Ageing::kUnspecified)
          found.push_back(type->name + " " + input->path());
      } else if (const auto* port = dynamic_cast<Port*>(&element);
                 port != nullptr && port->direction() == Port::Direction::kOutput) {
        commands = commands || IsVelocity(port->type(), port->unit());
      }
    });
    if (!commands) continue;
    ++commanding;
    unsaid.insert(unsaid.end(), found.begin(), found.end());
  }
  EXPECT_GT(commanding, 10);
  EXPECT_THAT(unsaid, testing::IsEmpty());
}

TEST(Losses, ARobotThatDoesNotKnowStands) {
  const std::string table = Table();
  std::ifstream file(RUNNEL_XML "/../modules/motion/LOSSES.md");
  std::stringstream manual;
  manual << file.rdbuf();
  EXPECT_THAT(manual.str(), testing::HasSubstr(table)) << table;
  for (const char* fault : {"DRIVES ON", "for ever", "fault", "is then", "did not"}) {
    EXPECT_THAT(table, testing::Not(testing::HasSubstr(fault)));
  }
}

}  // namespace
}  // namespace runnel::test
