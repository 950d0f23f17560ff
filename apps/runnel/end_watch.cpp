#include "apps/runnel/end_watch.h"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <utility>

#include "apps/runnel/commands.h"
#include "apps/runnel/output.h"
#include "core/element/own_thread.h"
#include "core/element/try_structure_lock.h"

namespace runnel::program {

namespace {

std::atomic<Scheduler*> to_be_ended{nullptr};
std::atomic<int> handlers{0};  // that are under way, in whichever thread
std::atomic<int> signals{0};   // that have come
static_assert(std::atomic<Scheduler*>::is_always_lock_free, "a signal handler must not lock");

// The first one ends the run, the second has the program end in order, the third ends it at once.
void Handle(int) {
  const bool is_last = signals.fetch_add(1) > 0;
  for (const int signal : EndSignal::kSignals) {
    struct sigaction current {};
    sigaction(signal, nullptr, &current);
    if (is_last && current.sa_handler == Handle) std::signal(signal, SIG_DFL);
  }
  // All of them seq_cst: either the destructor sees this handler, or this sees that there is nothing to
  // stop any more.
  handlers.fetch_add(1);
  if (Scheduler* scheduler = to_be_ended.load()) scheduler->RequestStop();
  handlers.fetch_sub(1);
}

constexpr Duration kLook = std::chrono::milliseconds(50);
// Longer than modules have to bring the robot to rest.
constexpr Duration kPatience = std::chrono::milliseconds(800);

}  // namespace

EndSignal::EndSignal(Scheduler& scheduler) {
  signals.store(0);
  to_be_ended.store(&scheduler);
  struct sigaction action {};
  action.sa_handler = Handle;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

EndSignal::~EndSignal() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  to_be_ended.store(nullptr);
  // The scheduler may go after this; a handler that has found it is about to end.
  while (handlers.load() != 0) std::this_thread::yield();
}

bool EndSignal::has_come() noexcept { return signals.load() > 0; }

bool EndSignal::has_come_again() noexcept { return signals.load() > 1; }

EndWatch::EndWatch(Application& application, std::function<void()> print,
                   std::function<void()> rescue)
    : application_(application),
      print_(std::move(print)),
      rescue_(std::move(rescue)),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

void EndWatch::Run(const std::stop_token& stop) {
  Duration since_asked{};
  for (; !stop.stop_requested(); std::this_thread::sleep_for(kLook)) {
    print_();
    if (EndSignal::has_come_again()) Leave();
    since_asked = application_.scheduler().stop_requested() ? since_asked + kLook : Duration{};
    if (since_asked > kPatience) Look();
  }
}

void EndWatch::Look() {
  const Scheduler& scheduler = application_.scheduler();
  const auto stuck = scheduler.StuckModules();
  if (!stuck.empty() && scheduler.ended_by_fault()) Leave();
  std::string waits = stuck.empty() ? "the run is still coming to its end" : "the run waits for ";
  for (const StuckModule& each : stuck) {
    waits += (&each != &stuck.front() ? ", " : "") + each.path;
  }
  if (!stuck.empty()) waits += " to return from its cycle";
  if (waits == std::exchange(told_, waits)) return;
  std::cerr << waits << "; Ctrl-C again ends the program\n" << std::flush;
}

// What a thread that does not end uses cannot be destroyed.
void EndWatch::Leave() {
  for (const StuckModule& each : application_.scheduler().StuckModules()) {
    PrintError(
        {.message = "has still not returned; the program ends without it", .path = each.path});
  }
  rescue_();
  print_();
  (void)FinishOutput();
  std::_Exit(static_cast<int>(ExitCode::kRunFailed));
}

std::string EndOwnThreads(Runtime& runtime) {
  constexpr Duration kTold = std::chrono::milliseconds(800);
  constexpr Duration kLongest = std::chrono::seconds(5);
  std::string told;
  for (Duration waited{};; waited += kLook) {
    std::string at_work;
    {
      const auto lock = TryStructureLock(runtime, kLook);
      const auto tell = [&](const FrameworkElement& each) {
        at_work += (at_work.empty() ? "a call of " : ", ") + each.parent()->path();
      };
      if (lock && OwnThread::AskToEnd(runtime.root(), tell)) return {};
      if (!lock) at_work = "what changes the structure";
    }
    if (waited >= kLongest) return at_work;
    if (waited >= kTold && at_work != std::exchange(told, at_work)) {
      std::cerr << "the run waits for " << at_work << " to come to its end; Ctrl-C again ends the program\n"
                << std::flush;
    }
    std::this_thread::sleep_for(kLook);
  }
}

void RunControl::AddHooks(Application& application, ServiceHooks& hooks) {
  hooks.quit = [this, &application]() -> Result<std::string> {
    is_asked_ = true;
    application.RequestStop();
    return std::string("the run ends");
  };
  hooks.restart = [this, &application]() -> Result<std::string> {
    if (auto good = check_(); !good) return good.error();
    shall_restart_ = true;
    is_asked_ = true;
    application.RequestStop();
    return std::string("runs again from its file");
  };
}

}  // namespace runnel::program
