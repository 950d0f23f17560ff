#pragma once

#include <functional>
#include <utility>

#include "core/element/annotation.h"

namespace runnel {

/// "Something of me goes on beside cycles": called before ports and kept states of a module go to the one that takes its
/// place, so that what it still publishes is read and nothing changes while it is copied. Neither module runs then. If the
/// change is taken back, the module runs again.
///
/// Threads: under the structure lock. Errors: what it throws has the change refused.
struct BeforeHandOver final : Annotation {
  explicit BeforeHandOver(std::function<void()> what) : settle(std::move(what)) {}
  const std::function<void()> settle;
};

}  // namespace runnel
