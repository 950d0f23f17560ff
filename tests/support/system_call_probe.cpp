#include "tests/support/system_call_probe.h"

#include <csignal>

#include <sys/prctl.h>
#include <ucontext.h>

#include "tests/support/sanitizer.h"

namespace runnel::test {

namespace {

// From linux/prctl.h, which older header packages lack.
constexpr int kSetSyscallUserDispatch = 59;
constexpr unsigned long kDispatchOff = 0;
constexpr unsigned long kDispatchOn = 1;
constexpr char kAllow = 0;
constexpr char kBlock = 1;

// The kernel looks at this byte at each system call of the thread.
thread_local constinit volatile char selector = kAllow;
thread_local constinit volatile long first_call = -1;

#if defined(__x86_64__) && !RUNNEL_UNDER_SANITIZER

bool Dispatch(unsigned long mode) noexcept {
  const bool on = mode == kDispatchOn;
  return prctl(kSetSyscallUserDispatch, mode, 0UL, 0UL, on ? &selector : nullptr) == 0;
}

// Notes the call, stops watching, and goes back to make the call.
void OnSystemCall(int, siginfo_t*, void* context) {
  selector = kAllow;
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  first_call = static_cast<long>(registers[REG_RAX]);
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

bool SystemCallProbe::works() noexcept {
  static const bool possible = Prepare();
  return possible;
}

SystemCallProbe::SystemCallProbe() noexcept {
  first_call = -1;
  if (works() && Dispatch(kDispatchOn)) selector = kBlock;
}

SystemCallProbe::~SystemCallProbe() { (void)Stop(); }

long SystemCallProbe::Stop() noexcept {
  selector = kAllow;
  if (works()) Dispatch(kDispatchOff);
  return first_call;
}

}  // namespace runnel::test
