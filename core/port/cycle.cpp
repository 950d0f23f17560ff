#include "core/port/cycle.h"

namespace runnel {

namespace internal {
thread_local constinit const Cycle* current_cycle = nullptr;
}  // namespace internal

}  // namespace runnel
