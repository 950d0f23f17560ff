#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/path_use.h"

namespace runnel {

/// A path followed as far as it leads.
///
/// Threads: under the structure lock. Lifetime: within that of the path.
class PathWalk {
 public:
  explicit PathWalk(const PathUse& use);

  /// Where the path ends, or the last element on the way that is there.
  [[nodiscard]] FrameworkElement& at() const noexcept { return *at_; }
  /// The first name that is not there; "" if all are.
  [[nodiscard]] std::string_view missing() const noexcept { return missing_; }
  /// Whether nothing comes after missing().
  [[nodiscard]] bool misses_only_the_last() const noexcept { return misses_only_the_last_; }

  /// Reports that missing() is not there and which of `candidates` comes nearest, unless an error
  /// has been reported for its not being there.
  void ReportMissing(const std::vector<std::string>& candidates, BuildContext& context) const;
  void Report(Error error, BuildContext& context) const;

 private:
  const PathUse& use_;
  FrameworkElement* at_;
  std::string_view missing_;
  bool misses_only_the_last_ = false;
};

/// The element that a path names, or nullptr after reporting what is not there.
[[nodiscard]] FrameworkElement* SearchElement(const PathUse& use, BuildContext& context);

/// Of those that the file names.
[[nodiscard]] std::vector<std::string> ChildNames(const FrameworkElement& element);

}  // namespace runnel
