#pragma once

#include <string>

#include "core/base/clock.h"
#include "plugins/command_service/element_search.h"

namespace runnel {

/// What a listing tells besides names and types.
struct ListingOptions {
  bool is_long = false;  ///< connections, threads, counts, rates, statistics
  /// Counts of a moment ago, for rates; empty: no rates.
  PublicationCounts before = {};
  Duration since{};  ///< how long ago, on the application's clock
};

/// `start` and all below it as a tree, one line each. Under the structure lock.
[[nodiscard]] std::string ListElements(FrameworkElement& start, const ListingOptions& options);

/// One line for each element: kind (of ports "input" or "output"), path, and "interface" for ports of
/// groups; separated by tabulators. For programs. Under the structure lock.
[[nodiscard]] std::string ListPaths(FrameworkElement& start);

/// "12.3"; "0" for none. Five digits.
[[nodiscard]] std::string RateText(double hertz);

}  // namespace runnel
