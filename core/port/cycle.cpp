#include "core/port/cycle.h"

namespace runnel {

namespace internal {
thread_local constinit const Cycle* current_cycle = nullptr;
}  // namespace internal

CycleScope::CycleScope(const Cycle& cycle) noexcept
    : cycle_(cycle), outer_(internal::current_cycle) {
  internal::current_cycle = &cycle_;
}

CycleScope::~CycleScope() { internal::current_cycle = outer_; }

}  // namespace runnel
