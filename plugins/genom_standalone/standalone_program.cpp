// The main function of components as processes.

#include <algorithm>
#include <csignal>
#include <cstring>
#include <deque>
#include <iostream>
#include <string_view>
#include <thread>
#include <vector>

#include <pthread.h>
#include <sched.h>

#include "core/base/clock.h"
#include "core/lockfree/wake_event.h"
#include "plugins/genom_execution/engine.h"
#include "plugins/genom_standalone/request_server.h"

namespace runnel::genom_standalone {

using genom_execution::Engine;
using genom_execution::Pass;

namespace {

constexpr int kDone = 0, kFailed = 1, kBadArguments = 2;

LineServer* g_server = nullptr;  // for signal handlers
volatile std::sig_atomic_t g_is_told_to_end = 0;

struct Arguments {
  std::string socket;
  bool is_stepped = false;
  bool wants_help = false;
};

bool Parse(int count, char** words, Arguments& arguments) {
  for (int i = 1; i < count; ++i) {
    const std::string_view word = words[i];
    if (word == "--stepped") {
      arguments.is_stepped = true;
    } else if (word == "--socket" && i + 1 < count) {
      arguments.socket = words[++i];
    } else if (word == "--help" || word == "-h") {
      arguments.wants_help = true;
    } else {
      std::cerr << "error: '" << word << "' is not known; see --help\n";
      return false;
    }
  }
  return true;
}

// Priority 0 is the highest of a component, 255 the lowest. Who may not have it goes on without, and says so.
void BecomeRealTime(const genom_execution::TaskTable& task) {
  sched_param parameters{};
  parameters.sched_priority = std::clamp(90 - task.priority / 3, 1, 90);
  const int code = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (code == 0) return;
  std::cerr << std::string("warning: task '") + task.name + "' gets no real-time priority (SCHED_FIFO " +
                   std::to_string(parameters.sched_priority) + "): " + std::strerror(code) +
                   "; permit it by ulimit -r, or as root\n";
}

// A thread for the control task and one for each other task, by the machine's clock.
class TaskThreads {
 public:
  explicit TaskThreads(std::size_t tasks) : wakes_(tasks + 1) {}
  // Preconditions: Begin() was called, and the engine ends or has ended.
  ~TaskThreads() { Join(); }
  TaskThreads(const TaskThreads&) = delete;
  TaskThreads& operator=(const TaskThreads&) = delete;

  void Begin(Engine& engine) {
    threads_.emplace_back([this, &engine] { RunControl(engine); });
    for (std::size_t i = 0; i < engine.tasks().size(); ++i) {
      threads_.emplace_back([this, &engine, i] { RunTask(engine, i); });
    }
  }
  // Something has happened: EngineOptions::wake. Any thread.
  void WakeAll() noexcept {
    for (WakeEvent& each : wakes_) each.Notify();
  }
  void Join() {
    for (std::thread& each : threads_) each.join();
    threads_.clear();
  }

 private:
  void RunControl(Engine& engine) {
    while (!engine.is_ended()) {
      const std::uint64_t changes = engine.changes();
      (void)engine.RunControl();
      if (!engine.is_ended() && engine.changes() == changes) wakes_[0].Wait();
    }
    WakeAll();
  }
  void RunTask(Engine& engine, std::size_t task) {
    auto& own = engine.tasks()[task];
    if (own.table().is_real_time) BecomeRealTime(own.table());
    while (!engine.is_ended()) {
      const std::uint64_t changes = engine.changes();
      if (engine.RunTask(task, clock_.Now()) != Pass::kIdle || engine.is_ended()) continue;
      const Time tick = own.next_tick();
      if (tick != Time::max() && own.is_periodic()) {
        wakes_[task + 1].WaitUntil(tick);
      } else if (engine.changes() == changes) {
        wakes_[task + 1].Wait();
      }
    }
  }

  SteadyClock clock_;
  std::deque<WakeEvent> wakes_;  // of the control task, then of the others
  std::vector<std::thread> threads_;
};

// False: something was thrown, as there is no memory; it is told.
bool Serve(LineServer& lines, RequestServer& server) {
  try {
    lines.Serve([&](LineServer::Client client, const std::string& line) { server.Take(client, line); },
                [&](LineServer::Client client) { server.ClientIsGone(client); },
                [&](LineServer::Client client) { return server.IsAwaitedBy(client); });
    server.Answer();
    return true;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return false;
  }
}

int Report(const Engine& engine) {
  const auto* const failure = engine.failure();
  if (failure == nullptr) return kDone;
  std::cerr << "error: a permanent activity has ended by " << failure->Text(engine.component()) << "\n";
  return kFailed;
}

int RunStepped(const StandaloneComponent& component, LineServer& lines) {
  Engine engine(component.table, {.ids = component.ids, .is_single_threaded = true});
  Time time{};
  const auto all = [](std::size_t) { return true; };
  const auto step = [&](Duration by) {
    time += by;
    engine.RunAll(time, false, all);
    return time;
  };
  bool is_well = true;
  {
    RequestServer server(component, engine, lines, step);
    while (is_well && g_is_told_to_end == 0 && !engine.is_stopping() && engine.failure() == nullptr) {
      is_well = Serve(lines, server);
    }
    engine.Stop();
    for (int i = 0; i < Engine::kMostRounds && !engine.is_ended(); ++i) engine.RunAll(time, true, all);
    server.Answer();
    lines.Flush();
    if (!engine.is_ended()) {
      std::cerr << "error: something does not end\n";
      std::_Exit(kFailed);  // it may still be used by what does not
    }
  }
  return is_well ? Report(engine) : kFailed;
}

int RunThreads(const StandaloneComponent& component, LineServer& lines) {
  struct Glue {
    TaskThreads threads;
    LineServer& lines;
  } glue{TaskThreads(component.table.tasks.size()), lines};
  SteadyClock clock;
  Engine engine(component.table, {.ids = component.ids,
                                  .glue = &glue,
                                  .patience = Duration::max(),
                                  .wake = [](void* to) { static_cast<Glue*>(to)->threads.WakeAll(); },
                                  .clock = &clock});
  RequestServer server(component, engine, lines, nullptr);
  // Noticed here, too, when it has ended.
  std::thread ending([&] {
    glue.threads.Begin(engine);
    glue.threads.Join();
    lines.Wake();
  });
  bool is_well = true;
  while (is_well && !engine.is_ended()) {
    is_well = Serve(lines, server);
    if (!is_well || g_is_told_to_end != 0) engine.Stop();
  }
  ending.join();
  server.Answer();
  lines.Flush();
  return is_well ? Report(engine) : kFailed;
}

void HandleSignals() {
  struct sigaction action {};
  action.sa_handler = [](int) {
    g_is_told_to_end = 1;
    if (g_server != nullptr) g_server->Wake();
  };
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace

std::string TextOf(const ValueType& type, const void* value) {
  return ToJson(type, value).dump(-1, ' ', false, Json::error_handler_t::replace);
}

int RunStandalone(const StandaloneComponent& component, int count, char** words) {
  Arguments arguments{.socket = std::string(component.table.name) + ".socket"};
  if (!Parse(count, words, arguments)) return kBadArguments;
  if (arguments.wants_help) {
    std::cout << "Component " << component.table.name
              << " as a process. Requests are JSON, one a line, over a Unix socket.\n"
              << "  --socket PATH  where (otherwise " << arguments.socket << ")\n"
              << "  --stepped      time passes only by requests: {\"step\": SECONDS}\n";
    return kDone;
  }
  try {
    LineServer lines;
    g_server = &lines;
    HandleSignals();
    if (const auto listening = lines.Listen(arguments.socket); !listening) {
      std::cerr << "error: " << listening.error().ToString() << "\n";
      return kFailed;
    }
    const int code = arguments.is_stepped ? RunStepped(component, lines) : RunThreads(component, lines);
    g_server = nullptr;
    return code;
  } catch (const std::exception& error) {
    g_server = nullptr;
    std::cerr << "error: " << error.what() << "\n";
    return kFailed;
  }
}

}  // namespace runnel::genom_standalone
