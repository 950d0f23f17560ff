#pragma once

namespace runnel {

/// Of modules whose Prepare() only looks at their settings, and at files that these name: `runnel check` calls it, too, on a
/// machine that is no robot. Those that open devices, start threads or write are none.
struct PreparesAnywhere {
  virtual ~PreparesAnywhere() = default;
};

}  // namespace runnel
