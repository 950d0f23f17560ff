#include "core/module/after_cycle.h"

#include <algorithm>

namespace runnel {

thread_local constinit AfterCycleScope* internal::after_cycle __attribute__((tls_model("initial-exec"))) = nullptr;

bool AfterCycleWork::DoAfterCycle() noexcept {
  return internal::after_cycle != nullptr && internal::after_cycle->Add(*this);
}

void AfterCycleScope::RunAll() noexcept {
  for (std::size_t i = 0; i < count_; ++i) work_[i]->RunAfterCycle();
}

bool AfterCycleScope::Add(AfterCycleWork& work) noexcept {
  const auto end = work_.begin() + static_cast<std::ptrdiff_t>(count_);
  if (std::find(work_.begin(), end, &work) != end) return true;
  if (count_ == kMost) return false;
  work_[count_++] = &work;
  return true;
}

}  // namespace runnel
