#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/element/robot_stop.h"
#include "plugins/mcap/mcap_reader.h"
#include "plugins/structure/change.h"
#include "tests/plugins/application/state_trial.h"

namespace runnel::test {

/// Whatever can be done to an element at which something has been set.
struct Operation {
  std::string name;
  std::function<void(Trial&)> act;
};

// One line for each.
inline const std::vector<Operation>& Operations() {
  const auto rename = [](Trial& trial) {
    trial.Do({RenameElement{trial.module, "n"}});
    trial.module = "/app/g/n";
  };
  const auto rename_group = [](Trial& trial) {
    trial.Do({RenameElement{"/app/g", "h"}});
    trial.module = "/app/h/m";
  };
  const auto swap = [](Trial& trial) { trial.Do({ReplaceModule{trial.module, "states/other", {}, 0}}); };
  const auto box = [](Trial& trial) {
    // Where something moves, no composite takes the place of a module.
    if (!trial.application->runtime().robot_stop().in_force()) Require(trial.In().SetDriving(false));
    trial.Do({ReplaceModule{trial.module, "states/box", {}, 0}});
  };
  const auto swap_to_empty = [](Trial& trial) { trial.Do({ReplaceModule{trial.module, "states/empty", {}, 0}}); };
  const auto erase = [](Trial& trial) { trial.Do({DeleteElement{trial.module}}); };
  const auto undone = [](const std::function<void(Trial&)>& act) {
    return [=](Trial& trial) {
      const std::string module = trial.module;
      act(trial);
      if (!trial.is_refused) trial.Undo();
      trial.module = module;
    };
  };
  static const std::vector<Operation> operations{
      {"rename", rename},
      {"rename + undo", undone(rename)},
      {"rename of the group", rename_group},
      {"swap", swap},
      {"swap + undo", undone(swap)},
      {"swap for a composite", box},
      {"swap for it + undo", undone(box)},
      {"swap to a type without the ports",
       [=](Trial& trial) {
         trial.Must({DisconnectPorts{trial.module + "/out", "/app/sink/in"}});
         swap_to_empty(trial);
       }},
      {"the same + undo",
       [=](Trial& trial) {
         trial.Must({DisconnectPorts{trial.module + "/out", "/app/sink/in"}});
         undone(swap_to_empty)(trial);
       }},
      {"delete + undo", undone(erase)},
      {"delete of the group + undo", undone([](Trial& trial) { trial.Do({DeleteElement{"/app/g"}}); })},
      {"copy",
       [](Trial& trial) {
         trial.Do({CopyElement{trial.module, "n"}});
         trial.module = "/app/g/n";
       }},
      {"move to a thread",
       [](Trial& trial) {
         trial.Do({AssignToThread{"/app/g", "slow"}});
       }},
      {"save + load",
       [](Trial& trial) {
         const auto file = trial.folder.path() / "saved.xml";
         (void)trial.application->TakeEvents();
         if (const auto saved = trial.application->Save(file); !saved) trial.told += saved.error().ToString();
         for (const ApplicationEvent& each : trial.application->TakeEvents()) trial.told += each.text + "\n";
         trial.recorder.reset();
         trial.application = Trial::Load(file);
       }},
      {"restart of the application",
       [](Trial& trial) {
         const auto ended = trial.application->service().application().hooks.quit();
         trial.told += ended ? *ended : ended.error().ToString();
         trial.recorder.reset();
         trial.application = {};
         trial.application = Trial::Load(trial.file);
       }},
      {"replay",
       [](Trial& trial) {
         const std::string file = (trial.folder.path() / "played.mcap").string();
         auto recorder =
             Recorder::Start(trial.application->runtime(), nullptr, {.file = file, .ports = {"/app/source/out"}});
         if (!recorder) throw std::runtime_error(recorder.error().ToString());
         Require(trial.application->RunCycles(3));
         recorder->reset();
         auto reader = McapReader::Open(file);
         if (!reader) throw std::runtime_error(reader.error().ToString());
         auto player = Player::Prepare(trial.application->runtime(), std::move(*reader), {});
         if (!player) throw std::runtime_error(player.error().ToString());
         trial.player = std::move(*player);
         trial.player->Start(trial.application->runtime().clock().Now());
         Require(trial.application->RunCycles(3));
       }},
      {"reload of the plugin", [](Trial& trial) { trial.Note(trial.application->Reload("states")); }},
      {"restart of the module",
       [](Trial& trial) {
         trial.Do({ReplaceModule{trial.module, "states/filter"}});
       }},
      {"disconnect + undo", undone([](Trial& trial) {
         ChangeSet changes;
         for (const char* each : {"in", "queued", "pulled", "late", "rounded", "taken"}) {
           for (const Port* from : trial.In(each).incoming())
             changes.push_back(DisconnectPorts{from->path(), trial.In(each).path()});
         }
         changes.push_back(DisconnectPorts{trial.module + "/out", "/app/sink/in"});
         trial.Do(changes);
       })},
      {"another period",
       [](Trial& trial) { trial.Do({ScheduleThread{.thread = "fast", .period = std::chrono::milliseconds(5)}}); }},
  };
  return operations;
}

}  // namespace runnel::test
