#include "plugins/scheduling/real_thread.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>

#include "core/base/signal_stack.h"
#include "core/log/logger.h"
#include "plugins/scheduling/thread_options.h"
#include "plugins/timing/tick_clock.h"

namespace runnel {

std::optional<Error> UseScheduling(pthread_t thread, int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int failure = pthread_setschedparam(thread, priority > 0 ? SCHED_FIFO : SCHED_OTHER, &parameters);
  if (failure == 0) return {};
  return Error{.message = "SCHED_FIFO with priority " + std::to_string(priority) + " was refused (" +
                          std::strerror(failure) + "); the thread runs under ordinary scheduling",
               .hint = "allow it with CAP_SYS_NICE or an rtprio limit (limits.conf)"};
}

std::optional<Error> LockMemory() {
  const char* const hint = "allow it with CAP_IPC_LOCK and an unlimited memlock (limits.conf)";
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  const bool unlimited = limit.rlim_cur == RLIM_INFINITY;
  if (mlockall(unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) != 0) {
    return Error{
        .message = std::string("memory was not locked (") + std::strerror(errno) + "); cycles may wait for pages",
        .hint = hint};
  }
  if (unlimited) return {};
  return Error{.message = "only the memory in use now was locked, since locked memory is limited", .hint = hint};
}

void PrefaultStack() noexcept {
  constexpr std::size_t kBytes = 128 * 1024;
  constexpr std::size_t kPage = 4096;
  std::byte stack[kBytes];
  volatile std::byte* const touched = stack;  // volatile: the stores have no other purpose
  for (std::size_t i = 0; i < kBytes; i += kPage) touched[i] = std::byte{0};
}

namespace {

// How soon a thread asks again whether another has let go of what data has come for. It sleeps
// meanwhile, so that the other gets to its end even if it has the lower priority.
constexpr Duration kLookAgain = std::chrono::microseconds(100);

// Sleeps until the steady clock shows `due`, at once if it does already. Wakes a few times a
// second to ask `give_up()`. Returns false if given up.
template <typename GiveUp>
bool SleepUntil(Time due, const GiveUp& give_up) {
  constexpr Duration kLongestSleep = std::chrono::milliseconds(100);
  const SteadyClock clock;
  for (Time now = clock.Now(); now < due; now = clock.Now()) {
    if (give_up()) return false;
    const auto until = std::min(due, now + kLongestSleep).time_since_epoch();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(until);
    timespec wake{};
    wake.tv_sec = static_cast<time_t>(seconds.count());
    wake.tv_nsec = static_cast<long>((until - seconds).count());
    // The steady clock is CLOCK_MONOTONIC. A signal that ends the sleep early does no harm.
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
  }
  return !give_up();
}

}  // namespace

RealThread::RealThread(std::shared_ptr<CycleRunner> runner, FaultDispatcher& faults, Time first)
    : runner_(std::move(runner)),
      activation_(runner_->options().activation),
      faults_(faults),
      thread_([this, first] { Run(first); }) {}

RealThread::~RealThread() {
  RequestStop();
  thread_.join();
}

std::optional<Error> RealThread::Prioritize() {
  const int priority = runner_->options().priority;
  if (priority == std::exchange(priority_, priority)) return {};
  auto warning = UseScheduling(thread_.native_handle(), priority);
  if (warning) warning->path = runner_->path();
  return warning;
}

void RealThread::RequestStop() noexcept {
  stopping_.store(true, std::memory_order_release);
  leaves_.store(true, std::memory_order_release);
  runner_->event().Notify();
}

void RealThread::FollowActivation() noexcept {
  const auto wanted = runner_->options().activation;
  if (wanted == std::exchange(activation_, wanted)) return;
  leaves_.store(true, std::memory_order_release);
  runner_->event().Notify();
}

void RealThread::Run(Time first) {
  const SignalStack for_handlers;
  runner_->quiescence()->Take();
  PrefaultStack();
  PrepareLogging();
  RunCycles(first);
  ended_.store(true, std::memory_order_release);
}

void RealThread::RunCycles(Time first) {
  for (; !stopping(); first = SteadyClock().Now()) {
    switch (runner_->options().activation) {
      case ThreadOptions::Activation::kPeriod:
        RunPeriodically(first);
        break;
      case ThreadOptions::Activation::kFreeRunning:
        RunFreely();
        break;
      case ThreadOptions::Activation::kTrigger:
        RunOnData();
    }
    // acq_rel: what is stored before the flag is seen by the next round, or the flag is up again then.
    leaves_.exchange(false, std::memory_order_acq_rel);
  }
}

void RealThread::RunPeriodically(Time first) {
  const SteadyClock clock;
  ThreadOptions options = runner_->options();
  DueTime due(first, options.period, options.on_overrun);
  const auto is_disturbed = [&] { return leaves() || runner_->period() != options.period; };
  for (;;) {
    const bool is_due = SleepUntil(due.next(), is_disturbed);
    if (leaves()) return;
    if (runner_->period() != options.period) {
      options = runner_->options();
      due.Change(options.period, options.on_overrun, clock.Now());
    }
    if (!is_due) continue;
    const Time planned = due.next();
    Time now = clock.Now();
    for (; !runner_->RunCycle({now, options.period}, faults_); now = clock.Now()) {
      runner_->gate().WaitUntilOpen();
    }
    const Time ended = clock.Now();
    const bool overrun = due.Advance(ended);
    runner_->Record({planned, now, ended - now, overrun});
  }
}

// The end of a cycle is the start of the next, so that the clock is read once for both.
void RealThread::RunFreely() {
  TickClock clock;
  Time now = clock.Now();
  while (!leaves()) {
    if (!runner_->RunCycle({now, Duration::zero()}, faults_)) {
      runner_->gate().WaitUntilOpen();
      now = clock.Now();
      continue;
    }
    const Time ended = clock.Now();
    runner_->Record({now, now, ended - now, false});
    now = ended;
  }
}

void RealThread::RunOnData() {
  const SteadyClock clock;
  for (;;) {
    // Data may have come while no thread was waiting for it.
    if (!runner_->is_activated()) runner_->event().Wait();
    if (leaves()) return;
    if (!runner_->TakeActivation()) continue;
    Time now = clock.Now();
    for (; !runner_->RunCycle({now, Duration::zero()}, faults_); now = clock.Now()) {
      runner_->gate().WaitUntilOpen();
    }
    runner_->Record({now, now, clock.Now() - now, false});
    if (runner_->is_held_up()) std::this_thread::sleep_for(kLookAgain);
  }
}

}  // namespace runnel
