#include "apps/runnel/end_watch.h"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <utility>

#include "apps/runnel/commands.h"
#include "apps/runnel/output.h"
#include "apps/runnel/stop_signal.h"

namespace runnel::program {

namespace {

constexpr Duration kLook = std::chrono::milliseconds(50);
// Longer than modules have to bring the robot to rest.
constexpr Duration kPatience = std::chrono::milliseconds(800);

}  // namespace

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
    if (StopSignal::has_come_again()) Leave();
    since_asked = application_.scheduler().stop_requested() ? since_asked + kLook : Duration{};
    if (since_asked > kPatience) Look();
  }
}

void EndWatch::Look() {
  const Scheduler& scheduler = application_.scheduler();
  const auto stuck = scheduler.StuckModules();
  if (!stuck.empty() && scheduler.stopped_by_fault()) Leave();
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
