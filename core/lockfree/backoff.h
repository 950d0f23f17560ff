#pragma once

namespace runnel {

/// Backs off: one round of waiting for another thread, outside of cycles: yields in the first rounds, in which
/// most waits end, then sleeps for 50 us each.
void BackOff(int round);

}  // namespace runnel
