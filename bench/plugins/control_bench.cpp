// What watching a port costs its publisher: a thread publishes 6 MB images at full rate, alone, with
// `echo` of each by a client that reads, with one that does not read, and with `hz`. In turns, so that
// what else the machine does hits all alike; the medians are printed.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <sys/socket.h>
#include <unistd.h>

#include "core/module/module.h"
#include "core/port/output.h"
#include "plugins/control/control_client.h"
#include "plugins/control/control_folder.h"
#include "plugins/control/control_server.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t kBytes = 6'000'000;
constexpr int kRounds = 15;
constexpr int kImages = 300;

class Camera final : public Module {
 public:
  using Module::Module;
  Output<std::vector<std::uint8_t>> image{this, "image"};

  void Publish(std::uint8_t shade) {
    auto loan = image.Loan();
    loan->resize(kBytes);
    std::fill(loan->begin(), loan->end(), shade);
    image.Publish(std::move(loan));
  }

 private:
  void Update() override {}
};

double ProcessorMicroseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

// One client that asks and, if it reads, reads till it is told to stop.
class Watcher {
 public:
  Watcher(const std::filesystem::path& socket, const std::string& request, bool reads) {
    socket_ = std::move(*ConnectToSocket(socket));
    const std::string bytes = FrameBytes("request", request);
    if (send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) std::abort();
    if (reads) thread_ = std::thread([this] { Read(); });
  }
  ~Watcher() {
    ends_.store(true);
    if (thread_.joinable()) thread_.join();
  }

 private:
  void Read() {
    std::vector<char> bytes(1 << 20);
    while (!ends_.load()) {
      if (recv(socket_.number(), bytes.data(), bytes.size(), 0) <= 0) std::this_thread::sleep_for(1ms);
    }
  }
  FileDescriptor socket_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

struct Case {
  const char* name;
  const char* request;
  bool reads;
  std::vector<double> each = {};
};

double Median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

int Measure() {
  std::string name = std::filesystem::temp_directory_path() / "runnel_bench_XXXXXX";
  const std::filesystem::path folder = mkdtemp(name.data());
  Runtime runtime;
  ModuleRegistry modules;
  StructureEditor editor(runtime, modules, nullptr);
  ApplicationLog log(runtime.clock());
  CommandService service({runtime, modules, editor, log});
  Camera& camera = runtime.Create<Camera>(runtime.root(), "camera");
  if (!runtime.MakeReady(runtime.root())) return 1;
  const auto server = ControlServer::Start(service, {.application = "bench", .folder = folder});
  if (!server) return 1;
  std::vector<Case> cases{{"nobody watches", "", false},
                          {"echo", "echo /camera/image", true},
                          {"echo --full", "echo /camera/image full=yes", true},
                          {"echo --full, never read", "echo /camera/image full=yes", false},
                          {"hz", "hz /camera/image", true}};
  for (int round = 0; round < kRounds; ++round) {
    for (Case& each : cases) {
      std::unique_ptr<Watcher> watcher;
      if (*each.request != '\0') {
        watcher = std::make_unique<Watcher>((*server)->socket(), each.request, each.reads);
      }
      for (int i = 0; i < 20; ++i) camera.Publish(0);
      const double before = ProcessorMicroseconds();
      for (int i = 0; i < kImages; ++i) camera.Publish(static_cast<std::uint8_t>(i));
      each.each.push_back((ProcessorMicroseconds() - before) / kImages);
    }
  }
  std::printf(
      "6 MB images filled and published at full rate; processor time of the publisher, median of "
      "%d x %d\n\n%-26s %14s %10s\n",
      kRounds, kImages, "", "us per image", "");
  const double alone = Median(cases.front().each);
  for (const Case& each : cases) {
    const double median = Median(each.each);
    std::printf("%-26s %14.1f %+9.1f%%\n", each.name, median, 100 * (median / alone - 1));
  }
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace

}  // namespace runnel

int main() { return runnel::Measure(); }
