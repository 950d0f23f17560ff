#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/element/own_thread.h"
#include "core/element/runtime.h"
#include "core/plugin/module_type_name.h"
#include "core/port/port.h"
#include "plugins/application/application.h"
#include "plugins/application/what_is_lost.h"
#include "plugins/testing/fault_injection.h"
#include "tests/support/held_resources.h"

namespace runnel::test {

/// All that a person sees of an application that stands still: elements with types, values and connections, what its file
/// would be, whether STOP is in force. `has_ids`: whether each element is the same object as before counts, too.
inline std::string PictureOf(Application& application, bool has_ids) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  std::string text;
  application.runtime().root().Visit([&](FrameworkElement& each) {
    text += each.path() + " " + FindModuleType(each) + " " + std::to_string(static_cast<int>(each.life_cycle()));
    if (has_ids) text += " #" + std::to_string(each.id());
    if (const auto* const value = dynamic_cast<const Configurable*>(&each)) text += " = " + value->ToText();
    const auto* const port = dynamic_cast<const Port*>(&each);
    if (port != nullptr && port->is_set_by_hand()) text += " by hand";
    text += "\n";
    if (port == nullptr) return;
    std::set<std::string> edges;
    for (const Connection& edge : port->outgoing()) {
      edges.insert("  > " + edge.to->path() + " " + std::to_string(edge.options.queue) + "\n");
    }
    for (const Port* from : port->incoming()) edges.insert("  < " + from->path() + "\n");
    for (const std::string& edge : edges) text += edge;
  });
  const auto saved = internal::TextToSave(application.element(), {application.plugins(), application.tags()}, "");
  text += saved ? saved->after : saved.error().ToString();
  return text + (application.runtime().robot_stop().in_force() ? "STOP" : "");
}

/// What somebody has done to an application.
struct FaultyOperation {
  std::function<std::unique_ptr<Application>()> make;
  std::function<Result<void>(Application&)> carry_out;
  /// That what it has made works.
  std::function<void(Application&)> prove = [](Application&) {};
  /// What else is to be as it was if it fails: files …
  std::function<std::string(Application&)> look = [](Application&) { return std::string(); };
  std::vector<InjectedFault> faults = {InjectedFault::kAllocation};
  /// Whether STOP is in force meanwhile.
  bool is_stopped = true;
};

/// Has the operation meet each fault at each point, with a new application each time (a few points are left out where
/// there are hundreds). What has failed has said why, and has changed nothing that a person sees; what has not failed
/// has done all of it. Then the operation succeeds at the second try, works, and nothing is left of the application when
/// it is gone. How many points there were.
inline std::size_t Endure(const FaultyOperation& operation) {
  const auto carry_out = [&](Application& application) -> Result<void> {
    try {
      return operation.carry_out(application);
    } catch (const std::bad_alloc&) {
      return Error{.message = "out of memory"};
    }
  };
  const auto make = [&] {
    auto application = operation.make();
    if (application != nullptr && operation.is_stopped) application->runtime().robot_stop().Press("a test");
    return application;
  };
  const auto picture = [&](Application& application, bool has_ids) {
    return PictureOf(application, has_ids) + operation.look(application);
  };
  std::string done;
  {
    const auto application = make();  // and what the process does once
    if (application == nullptr) ADD_FAILURE() << "it cannot be made";
    if (application == nullptr) return 0;
    const auto outcome = carry_out(*application);
    EXPECT_TRUE(outcome) << outcome.error().ToString();
    done = picture(*application, false);
    operation.prove(*application);
  }
  const HeldResources held;
  std::size_t points = 0;
  for (const InjectedFault fault : operation.faults) {
    bool has_struck = true;
    for (std::size_t nth = 1; has_struck && !::testing::Test::HasFailure(); nth += 1 + nth / 50) {
      SCOPED_TRACE(NameOf(fault) + " " + std::to_string(nth));
      auto application = make();
      const std::string before = picture(*application, true);
      const HeldResources held_before;
      FaultInjection injection(fault, nth);
      auto outcome = carry_out(*application);
      injection.End();
      has_struck = injection.has_struck();
      points += has_struck ? 1 : 0;
      if (!outcome) {
        EXPECT_TRUE(has_struck) << outcome.error().ToString();
        EXPECT_FALSE(outcome.error().ToString().empty());
        EXPECT_EQ(picture(*application, true), before) << outcome.error().ToString();
        held_before.AwaitAgain();
        outcome = carry_out(*application);
      }
      EXPECT_TRUE(outcome) << outcome.error().ToString();
      EXPECT_EQ(picture(*application, false), done);
      operation.prove(*application);
      application.reset();
      held.AwaitAgain();
    }
  }
  return points;
}

}  // namespace runnel::test
