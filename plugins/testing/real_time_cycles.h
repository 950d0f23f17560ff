#pragma once

#include <cstdint>
#include <vector>

#include "plugins/real_time_check/real_time_watch.h"
#include "plugins/testing/module_rig.h"

namespace runnel::test {

/// Runs so many cycles, and returns what the module has done in them that it should not: allocating, locking, calling
/// the system. Run a few before, in which pools of buffers find their size. Under a sanitizer nothing is noticed.
///
/// The program that uses this has its malloc and its locks replaced, see plugins/real_time_check.
[[nodiscard]] std::vector<RealTimeBreach> RunWatched(ModuleRigBase& rig, std::uint64_t cycles);

}  // namespace runnel::test
