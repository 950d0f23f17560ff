#include "core/module/after_cycle.h"

#include <algorithm>
#include <utility>

namespace runnel {

namespace {

thread_local constinit AfterCycleScope* current __attribute__((tls_model("initial-exec"))) = nullptr;

}  // namespace

bool AfterCycleWork::DoAfterCycle() noexcept { return current != nullptr && current->Add(*this); }

AfterCycleScope::AfterCycleScope() noexcept : outer_(std::exchange(current, this)) {}

AfterCycleScope::~AfterCycleScope() {
  current = outer_;  // first, so that work finds no cycle
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
