#pragma once

#include <map>
#include <optional>
#include <string>

#include "core/base/clock.h"
#include "plugins/command_service/command_service.h"

namespace runnel {

class Port;

/// How an application is, for people: "running", and all that somebody should know, as "running, STOP in force for 4 s,
/// by a terminal, 1 module PAUSED". Waits for 10 ms at most: what needs the structure lock is left out while somebody else
/// has it, which is said.
[[nodiscard]] std::string StateText(const ServedApplication& application);

/// "STOP in force for 4 s, by a terminal", and whether that stops nothing; "" if it is not. Any thread.
[[nodiscard]] std::string StopText(Runtime& runtime);

/// Whether nothing feeds the input although its module requires it.
[[nodiscard]] bool LacksSource(const Port& port);

/// How long an output has been silent that published steadily since the application began, for 3 s and 20 values at least;
/// what is published now and then is not silent. Under the structure lock.
[[nodiscard]] std::optional<Duration> SilentFor(const Port& port, Time began, Time now);

/// Modules that have failed, by path, with what they have thrown. Under the structure lock.
[[nodiscard]] std::map<std::string, std::string> FailedModules(FrameworkElement& start, Scheduler& scheduler,
                                                               const ApplicationLog* log);

}  // namespace runnel
