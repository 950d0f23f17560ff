#include "plugins/real_time_check/system_call_trap.h"

#include <csignal>

#include <sys/prctl.h>
#include <ucontext.h>

#include "plugins/real_time_check/sanitizer.h"

namespace runnel {

namespace {

// From linux/prctl.h, which older header packages lack.
constexpr int kSetSyscallUserDispatch = 59;
constexpr unsigned long kDispatchOff = 0;
constexpr unsigned long kDispatchOn = 1;
constexpr char kAllow = 0;
constexpr char kBlock = 1;

// The kernel looks at the first of these at each system call of the thread.
#define RUNNEL_OF_THREAD thread_local constinit __attribute__((tls_model("initial-exec")))
RUNNEL_OF_THREAD volatile char selector = kAllow;
RUNNEL_OF_THREAD bool is_set_up = false;
RUNNEL_OF_THREAD SystemCallTrap::Listener listener = nullptr;
#undef RUNNEL_OF_THREAD

#if defined(__x86_64__) && !RUNNEL_UNDER_SANITIZER

bool Dispatch(unsigned long mode) noexcept {
  const bool on = mode == kDispatchOn;
  return prctl(kSetSyscallUserDispatch, mode, 0UL, 0UL, on ? &selector : nullptr) == 0;
}

// Tells, stops watching, and goes back to make the call.
void OnSystemCall(int, siginfo_t*, void* context) {
  selector = kAllow;
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  if (listener != nullptr) {
    listener(static_cast<long>(registers[REG_RAX]), reinterpret_cast<const void*>(registers[REG_RIP]));
  }
  constexpr greg_t kSyscallInstructionSize = 2;
  registers[REG_RIP] -= kSyscallInstructionSize;
}

bool Prepare() noexcept {
  struct sigaction action {};
  action.sa_sigaction = &OnSystemCall;
  action.sa_flags = SA_SIGINFO;
  const bool possible = sigaction(SIGSYS, &action, nullptr) == 0 && Dispatch(kDispatchOn);
  if (possible) Dispatch(kDispatchOff);
  return possible;
}

#else

bool Dispatch(unsigned long) noexcept { return false; }
bool Prepare() noexcept { return false; }

#endif

}  // namespace

bool SystemCallTrap::works() noexcept {
  static const bool possible = Prepare();
  return possible;
}

void SystemCallTrap::Arm(Listener heard) noexcept {
  if (!is_set_up) is_set_up = Dispatch(kDispatchOn);
  listener = heard;
  if (is_set_up) selector = kBlock;
}

void SystemCallTrap::Disarm() noexcept { selector = kAllow; }

void SystemCallTrap::Remove() noexcept {
  Disarm();
  if (is_set_up) Dispatch(kDispatchOff);
  is_set_up = false;
}

}  // namespace runnel
