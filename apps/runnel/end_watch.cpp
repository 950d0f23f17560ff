#include "apps/runnel/end_watch.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <utility>

#include "apps/runnel/command_line.h"
#include "apps/runnel/output.h"
#include "core/element/own_thread.h"
#include "core/element/runtime.h"

namespace runnel::program {

namespace {

std::atomic<Scheduler*> to_be_ended{nullptr};
std::atomic<int> handlers{0};  // that are under way, in whichever thread
std::atomic<int> signals{0};   // that have come
static_assert(std::atomic<Scheduler*>::is_always_lock_free, "a signal handler must not lock");

// The first one ends the run, the second has the program end in order, the third ends it at once.
void Handle(int) {
  const bool is_last = signals.fetch_add(1) > 0;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current {};
    sigaction(signal, nullptr, &current);
    if (is_last && current.sa_handler == Handle) std::signal(signal, SIG_DFL);
  }
  // All of them seq_cst: either who leaves the scheduler sees this handler, or this sees that there is nothing to
  // stop any more.
  handlers.fetch_add(1);
  if (Scheduler* scheduler = to_be_ended.load()) scheduler->RequestStop();
  handlers.fetch_sub(1);
}

constexpr Duration kLook = std::chrono::milliseconds(50);
// Longer than modules have to bring the robot to rest.
constexpr Duration kPatience = std::chrono::milliseconds(800);

}  // namespace

EndWatch::~EndWatch() {
  thread_ = {};
  for (const auto& [signal, action] : before_) sigaction(signal, &action, nullptr);
}

void EndWatch::BeginThreads(Application& application, std::function<void()> print, std::function<void()> rescue) {
  application_ = &application;
  print_ = std::move(print);
  rescue_ = std::move(rescue);
  signals.store(0);
  to_be_ended.store(&application.scheduler());
  struct sigaction action {};
  action.sa_handler = Handle;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    sigaction(signal, nullptr, &before_[signal]);
    if (before_[signal].sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
}

void EndWatch::WaitFor(std::string_view what) noexcept {
  const std::lock_guard lock(mutex_);
  if (awaited_.empty()) seen_ = std::min(signals.load(), 1);
  try {
    awaited_ = what;
  } catch (const std::bad_alloc&) {
    awaited_ = "something";
  }
  // The scheduler may go after this; a handler that has found it is about to end.
  to_be_ended.store(nullptr);
  while (handlers.load() != 0) std::this_thread::yield();
}

bool EndWatch::has_come() noexcept { return signals.load() > 0; }

void EndWatch::Run(const std::stop_token& stop) {
  Duration since_asked{};
  const auto look = [&] {
    const std::lock_guard lock(mutex_);
    const int come = signals.load();
    if (awaited_.empty()) {
      print_();
      if (come > 1) Leave(application_->scheduler().StuckModules());
      since_asked = application_->scheduler().stop_requested() ? since_asked + kLook : Duration{};
    } else if (come > std::exchange(seen_, come)) {
      if (!told_.empty()) Leave({});
      since_asked = kPatience + kLook;
    } else {
      since_asked += kLook;
    }
    if (since_asked > kPatience) Look();
  };
  for (; !stop.stop_requested(); std::this_thread::sleep_for(kLook)) {
    try {
      look();
    } catch (const std::bad_alloc&) {  // the next look tells what this one could not
    }
  }
}

void EndWatch::Look() {
  std::string waits = "the run waits for ";
  if (!awaited_.empty()) {
    waits += awaited_ + " to come to its end";
  } else if (const auto stuck = application_->scheduler().StuckModules(); stuck.empty()) {
    waits = "the run is still coming to its end";
  } else {
    if (application_->scheduler().ended_by_fault()) Leave(stuck);
    for (const StuckModule& each : stuck) {
      waits += (&each != &stuck.front() ? ", " : "") + each.path;
    }
    waits += " to return from its cycle";
  }
  if (waits == std::exchange(told_, waits)) return;
  std::cerr << waits << "; Ctrl-C again ends the program\n" << std::flush;
}

void EndWatch::Leave(const std::vector<StuckModule>& stuck) {
  for (const StuckModule& each : stuck) {
    PrintError({.message = "has still not returned; the program ends without it", .path = each.path});
  }
  if (awaited_.empty()) {
    rescue_();
    print_();
  } else if (stuck.empty()) {
    PrintError({.message = awaited_ + " has still not come to its end; the program ends without it"});
  }
  (void)FinishOutput();
  std::_Exit(static_cast<int>(ExitCode::kRunFailed));
}

void EndWatch::EndThreads() {
  constexpr Duration kLongest = std::chrono::seconds(5);
  for (Duration waited{};; waited += kLook) {
    std::string at_work;
    {
      const auto lock = TryStructureLock(application_->runtime(), kLook);
      const auto tell = [&](const FrameworkElement& each) {
        at_work += (at_work.empty() ? "a call of " : ", ") + each.parent()->path();
      };
      if (lock && OwnThread::AskToEnd(application_->runtime().root(), tell)) break;
      if (!lock) at_work = "what changes the structure";
    }
    WaitFor(at_work);
    if (waited >= kLongest) Leave({});
    std::this_thread::sleep_for(kLook);
  }
  WaitFor("one of its connections or extensions");
  if (const auto stuck = application_->scheduler().StuckModules(); !stuck.empty()) Leave(stuck);
}

void EndWatch::AddHooks(Application& application, ServiceHooks& hooks) {
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
