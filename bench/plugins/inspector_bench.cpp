// What viewers cost the application that they look at.
//
// 1. A thread publishes through ten ports at full rate, alone, and with a viewer that watches all ten as fast
//    as is allowed (60 times a second), that measures rates, or that never reads. In turns, so that what else
//    the machine does hits all alike; the medians of the publisher's processor time are printed.
// 2. The structure of applications of up to 10,000 modules: how long it takes to be seen for the first time,
//    for how long the structure is locked at a time meanwhile, what looking costs when nothing has changed,
//    and how long it takes until a swapped module is told.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/module/group.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/inspector/inspector.h"
#include "plugins/inspector/structure_mirror.h"
#include "plugins/parameters/parameter.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/web_server/web_server.h"

namespace runnel {

namespace {

using namespace std::chrono_literals;
using MachineClock = std::chrono::steady_clock;

constexpr int kPorts = 10;
constexpr int kRounds = 21;
constexpr int kPublications = 2'000'000;

class Publisher final : public Module {
 public:
  using Module::Module;
  std::vector<std::unique_ptr<Output<double>>> ports;

  void MakePorts() {
    for (int i = 0; i < kPorts; ++i) {
      ports.push_back(std::make_unique<Output<double>>(this, "p" + std::to_string(i)));
    }
  }

 private:
  void Update() override {}
};

double ProcessorNanoseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e9 + static_cast<double>(time.tv_nsec);
}

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

// A client that says what it is told to, and, if it reads, reads till it is told to stop.
class Viewer {
 public:
  Viewer(std::uint16_t port, const std::vector<std::string>& messages, bool reads)
      : descriptor_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      std::abort();
    }
    Send(
        "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Protocol: runnel.inspector.v1\r\n\r\n");
    for (const std::string& each : messages) {  // all short; masked with zeroes
      Send("\x81" + std::string(1, static_cast<char>(0x80U | each.size())) + std::string(4, '\0') + each);
    }
    if (reads) thread_ = std::thread([this] { Read(); });
  }
  ~Viewer() {
    ends_.store(true);
    if (thread_.joinable()) thread_.join();
    close(descriptor_);
  }

 private:
  void Send(const std::string& bytes) const {
    if (send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) std::abort();
  }
  void Read() {
    std::vector<char> bytes(1 << 20);
    while (!ends_.load()) {
      const ssize_t count = recv(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT);
      if (count <= 0) std::this_thread::sleep_for(1ms);
    }
  }
  int descriptor_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

struct Case {
  const char* name;
  bool watches;
  bool measures;
  bool reads;
  std::vector<double> each = {};
};

std::vector<std::string> MessagesOf(const Case& each) {
  std::vector<std::string> messages;
  for (int i = 0; each.watches && i < kPorts; ++i) {
    messages.push_back(R"({"op":"watch","rate":60,"path":"/publisher/output/p)" + std::to_string(i) + "\"}");
  }
  if (each.measures) messages.emplace_back(R"({"op":"watch_rates","rate":10})");
  return messages;
}

double PublishAll(const std::vector<std::unique_ptr<Output<double>>>& ports) {
  const Cycle cycle{Time(1ms), 1ms};
  const CycleScope scope(cycle);
  const double before = ProcessorNanoseconds();
  for (int i = 0; i < kPublications / kPorts; ++i) {
    for (const auto& port : ports) port->Publish(static_cast<double>(i));
  }
  return (ProcessorNanoseconds() - before) / kPublications;
}

int MeasurePublishing() {
  Runtime runtime;
  ModuleRegistry modules;
  Scheduler scheduler(runtime);
  StructureEditor editor(runtime, modules, &scheduler);
  ApplicationLog log(runtime.clock());
  Publisher& publisher = runtime.Create<Publisher>(runtime.root(), "publisher");
  publisher.MakePorts();
  if (!runtime.MakeReady(runtime.root())) return 1;
  CommandService service({runtime, modules, editor, log});
  Inspector inspector(service, scheduler, {.application = "bench"});
  const auto server = WebServer::Start({.port = 0}, {}, {inspector.Protocol()});
  if (!server) return 1;
  std::vector<Case> cases{{"nobody watches", false, false, false},
                          {"10 ports watched, 60 Hz", true, false, true},
                          {"10 ports and rates", true, true, true},
                          {"10 ports, never read", true, true, false}};
  for (int round = 0; round < kRounds; ++round) {
    for (Case& each : cases) {
      std::unique_ptr<Viewer> viewer;
      if (each.watches) {
        viewer = std::make_unique<Viewer>((*server)->port(), MessagesOf(each), each.reads);
        std::this_thread::sleep_for(20ms);
      }
      each.each.push_back(PublishAll(publisher.ports));
    }
  }
  std::printf(
      "Publishing through %d ports at full rate; processor time of the publisher, median of "
      "%d x %d\n\n%-26s %14s %10s\n",
      kPorts, kRounds, kPublications, "", "ns a value", "");
  const double alone = Median(cases.front().each);
  for (const Case& each : cases) {
    const double median = Median(each.each);
    std::printf("%-26s %14.2f %+9.1f%%\n", each.name, median, 100 * (median / alone - 1));
  }
  return 0;
}

class Node final : public Module {
 public:
  using Module::Module;
  Input<double> a{this, "a"};
  Input<double> b{this, "b"};
  Output<double> x{this, "x"};
  Output<double> y{this, "y"};
  Parameter<double> gain{this, "gain", {.default_value = 1, .bounds = {0, 9}, .unit = "1/s"}};
  Parameter<double> offset{this, "offset", {.default_value = 0}};

 private:
  void Update() override {}
};

double Milliseconds(MachineClock::duration duration) { return std::chrono::duration<double>(duration).count() * 1e3; }

struct Looking {
  double all = 0;      // ms
  double longest = 0;  // ms
  int looks = 0;
};
Looking LookUntilSeen(internal::StructureMirror& mirror) {
  Looking looking;
  const auto start = MachineClock::now();
  for (bool is_done = false; !is_done; ++looking.looks) {
    const auto before = MachineClock::now();
    is_done = mirror.Look();
    looking.longest = std::max(looking.longest, Milliseconds(MachineClock::now() - before));
  }
  looking.all = Milliseconds(MachineClock::now() - start);
  return looking;
}

bool MeasureStructure(int count) {
  Runtime runtime;
  ModuleRegistry modules;
  const auto added = modules.Add(
      {"bench/node", "", "bench", [](const Placement& placement) { return std::make_unique<Node>(placement); }});
  if (!added) return false;
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  StructureEditor editor(runtime, modules, &scheduler);
  std::vector<Node*> nodes;
  {
    const ChangeScope changes(runtime);
    auto& application = runtime.Create<Group>(runtime.root(), "application");
    for (int i = 0; i < count; ++i) {
      nodes.push_back(dynamic_cast<Node*>(modules.Create("bench/node", application, "m" + std::to_string(i)).value()));
      if (i > 0 && !Port::Connect(nodes[static_cast<std::size_t>(i - 1)]->x, nodes.back()->a)) {
        return false;
      }
    }
    if (!runtime.MakeReady(runtime.root())) return false;
  }
  const ApplicationLog log(runtime.clock());
  internal::StructureMirror mirror(runtime, modules, scheduler, log);
  const Looking first = LookUntilSeen(mirror);
  const auto before = MachineClock::now();
  const std::string whole = mirror.Whole();
  const double writing = Milliseconds(MachineClock::now() - before);
  std::vector<double> idle;
  for (int i = 0; i < 100; ++i) idle.push_back(LookUntilSeen(mirror).all);
  std::vector<double> swap;
  double longest = 0;
  for (int i = 0; i < 11; ++i) {
    if (!editor.Apply({ReplaceModule{"/application/m7", "bench/node", {}, 0}})) return false;
    const Looking looking = LookUntilSeen(mirror);
    swap.push_back(looking.all);
    longest = std::max(longest, looking.longest);
  }
  const std::string* const change = mirror.ChangeTo(mirror.revision());
  std::vector<double> counting;
  for (int i = 0; i < 11; ++i) {
    const auto start = MachineClock::now();
    if (!mirror.Count()) return false;
    counting.push_back(Milliseconds(MachineClock::now() - start));
  }
  std::printf("%8d %9zu %9.1f %8.2f %9.1f %9.1f %9.2f %9.1f %8.2f %9zu %9.2f\n", count, mirror.size(), first.all,
              first.longest, static_cast<double>(whole.size()) / 1e6, writing, Median(idle), Median(swap), longest,
              change != nullptr ? change->size() : 0, Median(counting));
  return true;
}

int Measure() {
  if (MeasurePublishing() != 0) return 1;
  std::printf(
      "\nSeeing the structure; times in ms, of the server's thread\n\n"
      "%8s %9s %9s %8s %9s %9s %9s %9s %8s %9s %9s\n",
      "modules", "elements", "first", "longest", "MB", "writing", "unchanged", "a swap", "longest", "bytes", "rates");
  for (const int count : {100, 1000, 10'000}) {
    if (!MeasureStructure(count)) return 1;
  }
  return 0;
}

}  // namespace

}  // namespace runnel

int main() { return runnel::Measure(); }
