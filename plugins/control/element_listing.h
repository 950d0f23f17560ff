#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/base/clock.h"
#include "core/element/framework_element.h"

namespace runnel {

/// How many values have passed each port at and below `start`, by path. Under the structure lock.
using PublicationCounts = std::map<std::string, std::uint64_t, std::less<>>;
[[nodiscard]] PublicationCounts CountPublications(FrameworkElement& start);

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
