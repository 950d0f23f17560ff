#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <new>
#include <set>
#include <string>
#include <thread>

#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/plugins/network/network_bench.h"
#include "core/port/cycle.h"

namespace runnel {

namespace {

const WireEndpointOptions kTopic = {.topic = "rt/found", .type = "bench::Found"};

/// Counts the members that there are, the own one among them.
class Members final : public WireDiscovery {
 public:
  [[nodiscard]] std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return ids_.size();
  }

 private:
  void OnMember(const WireMember& member) override {
    const std::lock_guard lock(mutex_);
    ids_.insert(member.id);
  }
  void OnMemberGone(const WireId& id) override {
    const std::lock_guard lock(mutex_);
    ids_.erase(id);
  }
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}

  mutable std::mutex mutex_;
  std::set<WireId> ids_;
};

/// Counts the writers of values that there are.
class Endpoints final : public WireDiscovery {
 public:
  [[nodiscard]] std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return ids_.size();
  }

 private:
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint& endpoint) override {
    const std::lock_guard lock(mutex_);
    if (endpoint.is_writer && endpoint.options.topic.starts_with("rt/writer/element_")) ids_.insert(endpoint.id);
  }
  void OnEndpointGone(const WireId&) override {}

  mutable std::mutex mutex_;
  std::set<WireId> ids_;
};

/// What processes share.
struct Common {
  std::atomic<int> ready{0};
  std::atomic<bool> has_ended{false};
  std::atomic<double> took{0};          // s
  std::atomic<std::int64_t> memory{0};  // kB, of all, what they share counted once
};

Common& MakeCommon() {
  void* const shared = mmap(nullptr, sizeof(Common), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) std::abort();
  return *new (shared) Common;
}

template <typename Part>
pid_t Fork(const Part& part) {
  const pid_t child = fork();
  if (child != 0) return child;
  part();
  _exit(0);
}

void Nap() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

std::int64_t OwnMemory() {
  std::ifstream file("/proc/self/smaps_rollup");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("Pss:")) return std::atoll(line.c_str() + 4);
  }
  return 0;
}

}  // namespace

void PrintDiscovery(int starts) {
  Common& common = MakeCommon();
  const pid_t writing = Fork([&] {
    Application<Sender<Block>> application;
    application.Begin(
        {.member = {.name = "writer"},
         .offers = {{.port = "/application/element/output", .topic = "/values", .quality = ValueQuality::kLatched}}},
        nullptr);
    {
      const OwnCycle cycle(SteadyClock().Now());
      application.element.output.Publish(Block{});
    }
    common.ready = 1;
    while (!common.has_ended) Nap();
    application.link.reset();
  });
  while (common.ready == 0) Nap();
  std::vector<double> all;
  for (int i = 0; i < starts; ++i) {
    const pid_t reading = Fork([&] {
      const double began = Now();
      Application<Receiver<Block>> application;
      application.Begin({.member = {.name = "reader"}}, &application.element.input);
      while (!application.element.input.Read().has_value()) std::this_thread::sleep_for(std::chrono::microseconds(100));
      common.took = Now() - began;
      application.link.reset();
    });
    waitpid(reading, nullptr, 0);
    all.push_back(common.took.load());
  }
  common.has_ended = true;
  waitpid(writing, nullptr, 0);
  std::ranges::sort(all);
  const auto soon = std::ranges::count_if(all, [](double each) { return each < 0.1; });
  fmt::print(
      "{} starts: an application has another one's value after {:.1f} ms (median), {:.1f} ms (worst); {} within 100 "
      "ms\n",
      starts, 1e3 * all[all.size() / 2], 1e3 * all.back(), soon);
}

void PrintMany(int count) {
  Common& common = MakeCommon();
  const pid_t looking = Fork([&] {
    Endpoints endpoints;
    const auto engine = MakeSharedMemoryWire(MakeCycloneWire());
    const auto member = std::move(*engine->Join({.name = "viewer"}, endpoints));
    common.ready = 1;
    while (endpoints.count() < static_cast<std::size_t>(count)) Nap();
    common.took = Now();
    while (!common.has_ended) Nap();
  });
  while (common.ready == 0) Nap();
  Runtime runtime;
  Group& group = runtime.Create<Group>(runtime.root(), "application");
  for (int i = 0; i < count; ++i) runtime.Create<Sender<Block>>(group, "element_" + std::to_string(i));
  const auto engine = MakeSharedMemoryWire(MakeCycloneWire());
  auto& network = runtime.Create<NetworkElement>(
      group, "network", NetworkOptions{.member = {.name = "writer"}, .offers = {{.patterns = {"**"}}}});
  (void)runtime.MakeReady(runtime.root());
  const std::int64_t before = OwnMemory();
  const double began = Now();
  auto link = std::move(*NetworkLink::Start(group, network, *engine, false));
  while (common.took == 0) Nap();
  fmt::print("{} ports offered: another process knows all after {:.0f} ms; {:.1f} MB\n", count,
             1e3 * (common.took - began), 1e-3 * static_cast<double>(OwnMemory() - before));
  common.has_ended = true;
  waitpid(looking, nullptr, 0);
  link.reset();
}

void PrintCrowd(int count) {
  Common& common = MakeCommon();
  std::vector<pid_t> processes;
  const double began = Now();
  for (int i = 0; i < count; ++i) {
    processes.push_back(Fork([&] {
      Members members;
      const auto engine = MakeSharedMemoryWire(MakeCycloneWire());
      const auto member = std::move(*engine->Join({.name = "robot"}, members));
      const auto writer = std::move(*member->MakeWriter(kTopic, {}));
      const auto reader = std::move(*member->MakeReader(kTopic, [](const WireSample&) {}, {}));
      while (members.count() < static_cast<std::size_t>(count))
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      ++common.ready;
      while (common.ready < count) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      common.memory += OwnMemory();
      while (!common.has_ended) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      _exit(0);  // all at once, without goodbye
    }));
  }
  while (common.ready < count) Nap();
  const double took = Now() - began;
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  common.has_ended = true;
  for (const pid_t each : processes) waitpid(each, nullptr, 0);
  fmt::print("{} applications know each other after {:.2f} s; {:.1f} MB each\n", count, took,
             1e-3 * static_cast<double>(common.memory) / count);
}

}  // namespace runnel
