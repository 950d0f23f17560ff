#pragma once

#include <map>
#include <string>

#include "core/base/clock.h"
#include "core/element/framework_element.h"
#include "plugins/values/watched_port.h"

namespace runnel {

/// What has been seen of each port at and below `start`, by path. Under the structure lock.
using PublicationRates = std::map<std::string, PublicationRate, std::less<>>;
[[nodiscard]] PublicationRates LookAtRates(FrameworkElement& start);

class ApplicationLog;
class Scheduler;

/// What a listing tells besides names and types.
struct ListingOptions {
  Scheduler* scheduler = nullptr;       ///< which modules have failed and are paused; optional
  const ApplicationLog* log = nullptr;  ///< and why; optional
  Time now{};                           ///< by the application's clock, for how old values are
  Time began{};                         ///< when it began, for outputs that have fallen silent
  bool is_long = false;                 ///< connections, threads, counts, rates, statistics
  /// As of a moment ago; empty: no rates.
  PublicationRates rates = {};
};

/// `start` and all below it as a tree, one line each. Under the structure lock.
[[nodiscard]] std::string ListElements(FrameworkElement& start, const ListingOptions& options);

/// One line for each element: kind (of ports "input" or "output"), path; of ports and parameters also "interface" for
/// those of groups, their type, and the values that they may have, if these have names; separated by tabulators. For
/// programs. Under the structure lock.
[[nodiscard]] std::string ListPaths(FrameworkElement& start);

/// "12.3"; "0" for none. Five digits.
[[nodiscard]] std::string RateText(double hertz);

}  // namespace runnel
