#pragma once

#include <csignal>
#include <cstddef>

#include <sys/mman.h>

namespace runnel {

/// A stack of its own for the handlers of signals of the calling thread, as long as it lives, so that they run where
/// the thread's has overflown. A thread that has one already keeps that.
///
/// Threads:  made and destroyed by the same one. Errors: without memory for it there is none.
class SignalStack {
 public:
  SignalStack() noexcept {
    stack_t before{};
    if (sigaltstack(nullptr, &before) != 0 || (before.ss_flags & SS_DISABLE) == 0) return;
    void* const memory = mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return;
    stack_t stack{};
    stack.ss_sp = memory;
    stack.ss_size = kSize;
    if (sigaltstack(&stack, nullptr) == 0) {
      memory_ = memory;
    } else {
      munmap(memory, kSize);
    }
  }

  ~SignalStack() {
    if (memory_ == nullptr) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
    munmap(memory_, kSize);
  }

  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  static constexpr std::size_t kSize = 256 * 1024;
  void* memory_ = nullptr;
};

}  // namespace runnel
