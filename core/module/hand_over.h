#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "core/element/annotation.h"

namespace runnel {

/// "Something of me goes on beside cycles": called of both modules before ports and kept states of one go to the one that
/// takes its place, so that what it still publishes is read, nobody uses the ports, and nothing changes while it is copied.
/// Neither module runs then. What is returned is kept until the ports are where they are to be. If the change is taken back,
/// the module runs again. Of a composite each part is asked, one after the other, until one throws.
///
/// Threads: under the structure lock. Errors: what it throws has the change refused.
struct BeforeHandOver final : Annotation {
  using Held = std::shared_ptr<void>;
  explicit BeforeHandOver(std::function<Held()> what) : settle(std::move(what)) {}
  const std::function<Held()> settle;
};

}  // namespace runnel
