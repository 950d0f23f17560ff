#include "bench/plugins/stop/loads.h"

#include <algorithm>
#include <csignal>
#include <memory>
#include <mutex>
#include <utility>

#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "plugins/control/control_folder.h"
#include "plugins/control/protocol.h"
#include "plugins/recording/recorder.h"
#include "tests/plugins/web_server/raw_client.h"

namespace runnel::bench {

namespace {

using namespace std::chrono_literals;
using test::RawClient;

constexpr rlim_t kDisk = 4 << 20;  // octets, with which a file fills it

void Carry(Robot& robot, TaskGroup& tasks, CommandRequest request) {
  const auto pending = robot.service->Begin(std::move(request), tasks);
  while (!pending->is_done()) std::this_thread::sleep_for(1ms);
}

ChangeRequest ChangesOf(ChangeSet changes) {
  ChangeRequest request;
  request.placed.positions.resize(changes.size());
  request.placed.changes = std::move(changes);
  return request;
}

Load::Step Construct(Robot& robot, TaskGroup& tasks) {
  return [&] {
    Carry(robot, tasks, ChangesOf({CreateModule{"/slow", "bench/slow"}}));
    Carry(robot, tasks, ChangesOf({DeleteElement{"/slow"}}));
  };
}

Load::Step LoadLibrary(Robot& robot, TaskGroup& tasks) {
  return [&] { Carry(robot, tasks, ChangesOf({CreateModule{"/other", "elsewhere/other"}})); };
}

Load::Step Change(Robot& robot, TaskGroup& tasks) {
  return [&] {
    ChangeSet create, remove;
    for (int i = 0; i < 1000; ++i) {
      create.push_back(CreateGroup{"/group" + std::to_string(i)});
      remove.push_back(DeleteElement{"/group" + std::to_string(i)});
    }
    Carry(robot, tasks, ChangesOf(create));
    Carry(robot, tasks, ChangesOf(remove));
  };
}

Load::Step Save(Robot& robot, TaskGroup& tasks) {
  return [&] { Carry(robot, tasks, SaveRequest{}); };
}

/// As long as one lives, no file of this process grows further than a disk that is full would let it.
class FullDisk {
 public:
  FullDisk() {
    std::signal(SIGXFSZ, SIG_IGN);
    Limit(kDisk);
  }
  ~FullDisk() { Limit(RLIM_INFINITY); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  static void Limit(rlim_t octets) {
    const rlimit limit{octets, RLIM_INFINITY};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) Fail("cannot limit the size of files");
  }
};

Load::Step RecordToFullDisk(Robot& robot, TaskGroup& /*tasks*/) {
  return [&, disk = std::make_shared<const FullDisk>()] {
    const std::string file = robot.folder / "full.mcap";
    auto recorder = Recorder::Start(robot.runtime, nullptr,
                                    {.file = file, .ports = {"/planner/output/picture"}, .compression = "none"});
    if (!recorder) Fail(recorder.error().ToString());
    const auto begin = SteadyClock::now();
    while (!(*recorder)->TakeFailure()) {
      robot.planner->PublishPicture();
      std::this_thread::sleep_for(1ms);
      if (Since(begin) > 10'000) Fail("the disk does not become full");
    }
    recorder->reset();
    std::filesystem::remove(file);
  };
}

Load::Step HoldStructure(Robot& robot, TaskGroup& /*tasks*/) {
  return [&] {
    const std::lock_guard lock(robot.runtime.structure_mutex());
    Nap(2s);
  };
}

// By three ways at once: of the service, of the control socket, of the page's protocol.
Load::Step Flood(Robot& robot, TaskGroup& tasks) {
  const auto viewer = std::make_shared<RawClient>(robot.web->port());
  (void)viewer->Upgrade("runnel.inspector.v1");
  auto connected = ConnectToSocket(robot.control->socket());
  if (!connected) Fail(connected.error().ToString());
  const auto terminal = std::make_shared<const FileDescriptor>(std::move(*connected));
  return [&, viewer, terminal] {
    const std::string asked = RawClient::Frame(1, R"({"op":"undo","request":1})");
    const std::string frame = FrameBytes("request", "undo");
    for (int i = 0; i < 1000; ++i) {
      (void)send(viewer->descriptor(), asked.data(), asked.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      (void)send(terminal->number(), frame.data(), frame.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    }
    char answer[1 << 14];
    for (const int each : {viewer->descriptor(), terminal->number()}) {
      while (recv(each, answer, sizeof answer, MSG_DONTWAIT) > 0) {
      }
    }
    std::vector<std::unique_ptr<PendingCommand>> all;
    for (int i = 0; i < 1000; ++i) all.push_back(robot.service->Begin(UndoRequest{}, tasks));
    while (!all.back()->is_done()) std::this_thread::sleep_for(1ms);
  };
}

Load::Step View(Robot& robot, TaskGroup& /*tasks*/) {
  const auto viewer = std::make_shared<RawClient>(robot.web->port());
  (void)viewer->Upgrade("runnel.inspector.v1");
  (void)viewer->SendText(R"({"op":"watch","path":"/base0/input/speed","rate":60})");
  (void)viewer->SendText(R"({"op":"watch_rates","rate":10})");
  return [viewer] {
    if (!viewer->Receive()) Fail("a viewer has been sent away");
  };
}

// Two viewers want more than passes: one reads as fast as it can, the other never.
Load::Step Saturate(Robot& robot, TaskGroup& /*tasks*/) {
  std::vector<std::shared_ptr<RawClient>> viewers;
  for (int i = 0; i < 2; ++i) {
    viewers.push_back(std::make_shared<RawClient>(robot.web->port()));
    (void)viewers.back()->Upgrade("runnel.inspector.v1");
    (void)viewers.back()->SendText(R"({"op":"watch","path":"/planner/output/picture","rate":60,"elements":1000000})");
  }
  return [&robot, viewers] {
    robot.planner->PublishPicture();
    std::vector<char> octets(1 << 20);
    const auto until = SteadyClock::now() + 16ms;
    while (SteadyClock::now() < until) {
      if (recv(viewers[0]->descriptor(), octets.data(), octets.size(), MSG_DONTWAIT) <= 0) {
        std::this_thread::sleep_for(1ms);
      }
    }
  };
}

Load::Step KeepBusy(Robot& /*robot*/, TaskGroup& /*tasks*/) {
  return [] {
    const auto until = SteadyClock::now() + 10ms;
    while (SteadyClock::now() < until) {
    }
  };
}

}  // namespace

std::vector<Load> Loads() {
  const int cores = static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
  return {{"nothing else"},
          {"a constructor of 5 s", Construct},
          {"a library that loads 5 s", LoadLibrary},
          {"sets of 1,000 changes", Change},
          {"a save of 5 s", Save},
          {"recordings to a full disk", RecordToFullDisk},
          {"the structure's lock held for 2 s", HoldStructure},
          {.name = "Update() of 2 s, in threads of their own", .driver = Driver::kSlowPlanners},
          {"a client that floods", Flood},
          {"50 viewers", View, 50},
          {"another connection saturated", Saturate, 1, true},
          {"all cores busy", KeepBusy, 2 * cores}};
}

Burden::Burden(const Load& load, Robot& robot) {
  loads_end = false;
  for (int i = 0; load.begin && i < load.threads; ++i) {
    threads_.emplace_back([&load, &robot] {
      TaskGroup tasks(robot.service->worker());
      const Load::Step step = load.begin(robot, tasks);
      while (!loads_end) step();
    });
  }
  std::this_thread::sleep_for(50ms);
}

Burden::~Burden() {
  loads_end = true;
  for (std::thread& thread : threads_) thread.join();
}

}  // namespace runnel::bench
