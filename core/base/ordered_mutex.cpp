#include "core/base/ordered_mutex.h"

#include "core/base/check.h"

namespace runnel {

namespace {
thread_local OrderedMutex* innermost = nullptr;  // a chain through outer_
}  // namespace

bool OrderedMutex::HeldByThisThread() const noexcept {
  for (const OrderedMutex* held = innermost; held != nullptr; held = held->outer_) {
    if (held == this) return true;
  }
  return false;
}

void OrderedMutex::CheckOrder() const {
  if (HeldByThisThread()) return;
  RUNNEL_CHECK(innermost == nullptr || innermost->level_ < level_, "locks must be taken in the order of their levels");
}

void OrderedMutex::lock() {
  CheckOrder();
  mutex_.lock();
  Locked();
}

bool OrderedMutex::try_lock() {
  CheckOrder();
  if (!mutex_.try_lock()) return false;
  Locked();
  return true;
}

void OrderedMutex::Locked() noexcept {
  if (depth_++ > 0) return;
  outer_ = innermost;
  innermost = this;
}

void OrderedMutex::unlock() {
  if (--depth_ == 0) {
    RUNNEL_CHECK(innermost == this, "locks must be released in the reverse order");
    innermost = outer_;
    outer_ = nullptr;
  }
  mutex_.unlock();
}

}  // namespace runnel
