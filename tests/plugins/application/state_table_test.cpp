// The table of states and operations: what has been set at an element, tried with everything that can be done to it. No
// cell is silent: a state is kept, or whoever does it is told that it is gone, or it is refused. The table stands in
// apps/documentation/pages/concepts/states.md.

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/robot_stop.h"
#include "core/element/tags.h"
#include "core/log/log_level.h"
#include "core/port/hand_slot.h"
#include "core/port/port_options.h"
#include "core/port/port_stop.h"
#include "core/port/probe_port.h"
#include "plugins/network/network_element.h"
#include "plugins/network/network_engines.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application/state_operations.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

void Say(Trial& trial, const std::string& change) {
  const auto outcome = trial.application->Apply(change);
  if (!outcome) throw std::runtime_error(outcome.diagnostics.ToString());
}

struct State {
  std::string name;
  std::vector<std::string> words;  // by one of which who is told knows that it is meant
  std::function<void(Trial&)> set;
  std::function<bool(Trial&)> is_there;
};

State OfConnection(const std::string& name, const std::string& input, const ConnectOptions& options) {
  return {name,
          {"connect", "has been changed"},
          [=](Trial& trial) {
            trial.Must({ConnectPorts{"/app/source/out", trial.module + "/" + input, options}});
          },
          [=](Trial& trial) {
            const Port& to = trial.In(input);
            for (const Connection& each : trial.At<Port>("/app/source/output/out").outgoing()) {
              const ConnectOptions& now = each.options;
              const bool is_same = now.queue == options.queue && now.pull == options.pull &&
                                   now.convert == options.convert && now.late == options.late;
              if (each.to == &to) return is_same;
            }
            return false;
          }};
}

// One line for each.
const std::vector<State>& States() {
  static const double five = 5;
  static const std::vector<State> states{
      {"value by hand",
       {"value by hand"},
       [](Trial& trial) { Require(PublishByHand(trial.In(), &five)); },
       [](Trial& trial) {
         const auto found = trial.In().ValueByHand();
         return found && *static_cast<const double*>(found->value.get()) == five;
       }},
      {"deadline of it",
       {"value by hand"},
       [](Trial& trial) {
         Require(PublishByHand(trial.In("late"), &five));
         const auto slot = HandSlot::Of(trial.In("late"));
         slot->hold = std::make_unique<HandSlot::Hold>();
         slot->hold->safe_value = AnyValue(0.0);
       },
       // In force, or as if it had passed.
       [](Trial& trial) {
         const auto found = trial.In("late").ValueByHand();
         return found && *static_cast<const double*>(found->value.get()) == 0.0;
       }},
      {"block of the port",
       {"block"},
       [](Trial& trial) { Require(trial.In().Block()); },
       [](Trial& trial) { return trial.In().is_blocked(); }},
      {"STOP of the robot",
       {"STOP", "driving", "has been changed"},
       [](Trial& trial) { trial.application->runtime().robot_stop().Press("the test"); },
       [](Trial& trial) { return trial.In().is_driving() && trial.application->runtime().robot_stop().in_force(); }},
      {"limits",
       {"limits", "has been changed"},
       [](Trial& trial) {
         const InputLimits limits{.minimum = 0, .maximum = 9};
         Require(trial.In().SetLimits(limits));
         const std::lock_guard lock(trial.application->runtime().structure_mutex());
         trial.In().Annotate(std::make_unique<GivenLimits>(limits));
       },
       [](Trial& trial) { return BoundsText(trial.In().limits()) == "0 .. 9"; }},
      {"paused",
       {"pause"},
       [](Trial& trial) { Require(trial.application->Pause(trial.module)); },
       [](Trial& trial) { return trial.application->scheduler().IsPaused(trial.Module()); }},
      {"log level",
       {"log", "has been changed"},
       [](Trial& trial) { SetLogLevel(trial.application->runtime(), trial.module, LogLevel::kDebug); },
       [](Trial& trial) {
         for (const auto& [path, level] : ReadLogLevels(trial.application->runtime())) {
           if (path == trial.module) return level == LogLevel::kDebug;
         }
         return false;
       }},
      {"tag",
       {"tags", "has been changed"},
       [](Trial& trial) { Require(SetTags(trial.Module(), {"safety"})); },
       [](Trial& trial) { return TagsText(trial.Module()) == "safety"; }},
      {"parameter",
       {"gain", "has been changed"},
       [](Trial& trial) {
         trial.Must({SetParameter{trial.module + "/gain", "3"}});
       },
       [](Trial& trial) { return trial.application->Get(trial.module + "/gain").value() == "3"; }},
      {"thread",
       {"thread", "has been changed"},
       [](Trial& trial) {
         trial.Must({AssignToThread{trial.module, "fast"}});
       },
       [](Trial& trial) {
         const auto* const thread = OwnThread(trial.Module());
         return thread != nullptr && thread->name() != "slow";
       }},
      {"recorded",
       {"record"},
       [](Trial& trial) {
         auto started =
             Recorder::Start(trial.application->runtime(), nullptr,
                             {.file = (trial.folder.path() / "run.mcap").string(), .ports = {trial.module + "/out"}});
         if (!started) throw std::runtime_error(started.error().ToString());
         trial.recorder = std::move(*started);
       },
       [](Trial& trial) {
         for (const Connection& each : trial.Out().outgoing()) {
           if (dynamic_cast<const ProbePort*>(each.to) != nullptr) return true;
         }
         return false;
       }},
      {"offered",
       {"offer", "has been changed"},
       [](Trial& trial) {
         const auto connections = [&] {
           const std::lock_guard lock(trial.application->runtime().structure_mutex());
           return trial.Out().outgoing().size();
         };
         const std::size_t before = connections();
         Say(trial, "offer " + trial.module + "/out topic=/x qos=latched");
         WaitUntil("the network's thread has connected it", [&] { return connections() > before; });
       },
       [](Trial& trial) {
         const auto& offers = NetworkElement::FindIn(trial.application->element())->options().offers;
         return std::ranges::any_of(offers, [&](const OfferOptions& each) {
           const auto port = PathSearch(trial.application->runtime()).FindPort(each.port, PathKind::kOutput);
           return port && *port == &trial.Out() && each.topic == "/x" && each.quality == ValueQuality::kLatched;
         });
       }},
      {"taken",
       {"take", "connect", "has been changed"},
       [](Trial& trial) { Say(trial, "take /y " + trial.module + "/taken live=true exclusive=true"); },
       [](Trial& trial) {
         const auto& takes = NetworkElement::FindIn(trial.application->element())->takes();
         return std::ranges::any_of(takes, [&](const NetworkElement::Take& each) {
           return each.options.topic == "/y" && each.options.is_exclusive &&
                  std::ranges::count(trial.In("taken").incoming(), each.output) == 1;
         });
       }},
      OfConnection("queue option", "queued", {.queue = 4}),
      OfConnection("pulled", "pulled", {.pull = true}),
      OfConnection("late", "late", {.late = true}),
      OfConnection("conversion", "rounded", {.convert = "round"}),
  };
  return states;
}

class StateTable : public ::testing::Test {
 protected:
  StateTable() {
    std::ofstream(file_) << kTrialText;
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    AddWireEngine("fake", MakeFakeWire());
  }
  ~StateTable() override { unsetenv("XDG_RUNTIME_DIR"); }

  // "kept", "told", "refused", or "SILENT", of each of the states.
  std::vector<std::string> Try(const std::vector<const State*>& states, const Operation& operation) {
    std::vector<std::string> cells;
    try {
      Trial trial(file_);
      for (const State* each : states) each->set(trial);
      for (const State* each : states) EXPECT_TRUE(each->is_there(trial)) << each->name;
      operation.act(trial);
      for (const State* each : states) {
        bool is_there = false;
        try {
          is_there = each->is_there(trial);
        } catch (const std::exception&) {  // nor is its port
        }
        const bool is_told = std::ranges::any_of(
            each->words, [&](const std::string& word) { return trial.told.find(word) != std::string::npos; });
        cells.emplace_back(trial.is_refused ? (trial.told.empty() ? "SILENT" : "refused")
                           : is_there       ? "kept"
                           : is_told        ? "told"
                                            : "SILENT");
        last_told_ = trial.told;
      }
    } catch (const std::exception& error) {
      ADD_FAILURE() << operation.name << ": " << error.what();
      cells.resize(states.size(), "FAILED");
    }
    return cells;
  }

  TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_.path() / "app.xml";
  std::string last_told_;
};

std::string Table(const std::vector<std::vector<std::string>>& cells) {
  std::string text = "| |";
  for (const Operation& each : Operations()) text += " " + each.name + " |";
  text += "\n|---|";
  for (std::size_t i = 0; i < Operations().size(); ++i) text += "---|";
  for (std::size_t i = 0; i < States().size(); ++i) {
    text += "\n| " + States()[i].name + " |";
    for (const std::string& each : cells[i]) text += " " + each + " |";
  }
  return text + "\n";
}

TEST_F(StateTable, IsTheOneThatIsPrinted) {
  std::vector<std::vector<std::string>> cells(States().size());
  for (std::size_t i = 0; i < States().size(); ++i) {
    for (const Operation& operation : Operations()) {
      cells[i].push_back(Try({&States()[i]}, operation).front());
      EXPECT_NE(cells[i].back(), "SILENT") << States()[i].name << ", " << operation.name;
    }
  }
  std::ifstream stream(std::filesystem::path(RUNNEL_TEST_SOURCES) / "apps/documentation/pages/concepts/states.md");
  const std::string printed{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_THAT(printed, ::testing::HasSubstr(Table(cells))) << "the table is now:\n" << Table(cells);
}

class StatesBesideEachOther : public StateTable, public ::testing::WithParamInterface<std::size_t> {};
// Two states do not disturb each other: whatever one of them is alone it is beside the other, unless the whole is refused.
TEST_P(StatesBesideEachOther, AreTheSameAsAlone) {
  const Operation& each = Operations()[GetParam()];
  std::vector<std::string> alone;
  for (const State& state : States()) alone.push_back(Try({&state}, each).front());
  for (std::size_t i = 0; i < States().size(); ++i) {
    for (std::size_t j = i + 1; j < States().size(); ++j) {
      const State &one = States()[i], &other = States()[j];
      const auto cells = Try({&one, &other}, each);
      const bool is_refused = alone[i] == "refused" || alone[j] == "refused";
      EXPECT_EQ(cells[0], is_refused ? "refused" : alone[i])
          << one.name << " beside " << other.name << ": " << last_told_;
      EXPECT_EQ(cells[1], is_refused ? "refused" : alone[j])
          << other.name << " beside " << one.name << ": " << last_told_;
    }
  }
}

// They run beside each other.
INSTANTIATE_TEST_SUITE_P(Under, StatesBesideEachOther, ::testing::Range(std::size_t{0}, Operations().size()),
                         [](auto at) {
                           std::string name = Operations()[at.param].name;
                           std::ranges::replace_if(
                               name, [](char each) { return std::isalnum(each) == 0; }, '_');
                           return name;
                         });
}  // namespace
}  // namespace runnel::test
