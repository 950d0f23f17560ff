#pragma once

#include <cstddef>

namespace runnel {

/// A stack of its own for the handlers of signals of the calling thread, as long as it lives, so that they run where
/// the thread's has overflown. A thread that has one already keeps that.
///
/// Threads:  made and destroyed by the same one. Errors: without memory for it there is none.
class SignalStack {
 public:
  SignalStack() noexcept;
  ~SignalStack();
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  static constexpr std::size_t kSize = 256 * 1024;
  void* memory_ = nullptr;
};

}  // namespace runnel
