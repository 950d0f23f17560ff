#pragma once

namespace runnel::testing {

/// How often the calling thread has asked operator new for memory since it started.
[[nodiscard]] int AllocationsOfThisThread();

}  // namespace runnel::testing
