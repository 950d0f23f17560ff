// What it costs to have ports read by another process: bin/bench_network. Beside each figure stands that of the engine
// alone, by the seam of octets, in the same run. Both processes are in a network of their own if the system permits that.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/own_cycle.h"
#include "plugins/network/network_link.h"
#include "plugins/wire_cyclone/cyclone_wire.h"
#include "tests/support/own_network.h"

namespace runnel {
namespace {

struct Block {
  std::array<double, 16> values;
};
void Describe(TypeBuilder<Block>& type) { type.Name("bench::Block").Field("values", &Block::values); }

struct Picture {
  double sent = 0;
  std::vector<std::uint8_t> data;
};
void Describe(TypeBuilder<Picture>& type) {
  type.Name("bench::Picture").Field("sent", &Picture::sent).Field("data", &Picture::data);
}

constexpr std::size_t kPicture = 1920 * 1080 * 3;

// Seconds by a clock that both processes have.
double Now() { return ToSeconds(SteadyClock().Now()); }
double ProcessorTime() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

struct Figures {
  double p50 = 0;  // s
  double p99 = 0;
  double processor_writing = 0;  // s a value
  double processor_reading = 0;
  double arrived = 0;  // of those that were sent
};

/// What the reading process hands over.
struct Report {
  double p50, p99, processor, count;
};

/// How many values, how often.
struct Load {
  int count;
  std::chrono::microseconds period;
};

/// Latencies of one process, until nothing has come for a second after the first.
class Arrivals {
 public:
  void Add(double sent) {
    const std::size_t place = count_.load(std::memory_order_relaxed);
    if (place >= latencies_.size()) return;
    latencies_[place] = Now() - sent;
    count_.store(place + 1, std::memory_order_release);
  }
  Report Finish() {
    const double began = ProcessorTime();
    for (std::size_t seen = 0;;) {
      std::this_thread::sleep_for(std::chrono::seconds(1));
      const std::size_t now = count_.load(std::memory_order_acquire);
      if (now > 0 && now == seen) break;
      seen = now;
    }
    const double processor = ProcessorTime() - began;
    std::vector<double> all(latencies_.begin(), latencies_.begin() + static_cast<std::ptrdiff_t>(count_.load()));
    std::ranges::sort(all);
    const auto n = static_cast<double>(all.size());
    return {all[all.size() / 2], all[all.size() * 99 / 100], processor / n, n};
  }

 private:
  std::vector<double> latencies_ = std::vector<double>(1'000'000);
  std::atomic<std::size_t> count_{0};
};

/// Runs `read` in a process of its own and `write` in this one.
Figures Measure(const Load& load, const std::function<Report()>& read, const std::function<void()>& write) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) std::abort();
  const pid_t reader = fork();
  if (reader == 0) {
    const Report report = read();
    if (::write(ends[1], &report, sizeof report) < 0) _exit(1);
    _exit(0);
  }
  const pid_t writer = fork();
  if (writer == 0) {
    const double before = ProcessorTime();
    write();
    const double processor = (ProcessorTime() - before) / load.count;
    if (::write(ends[1], &processor, sizeof processor) < 0) _exit(1);
    _exit(0);
  }
  double processor = 0;
  Report report{};
  if (::read(ends[0], &processor, sizeof processor) < 0 || ::read(ends[0], &report, sizeof report) < 0) std::abort();
  waitpid(writer, nullptr, 0);
  waitpid(reader, nullptr, 0);
  close(ends[0]);
  close(ends[1]);
  return {report.p50, report.p99, processor, report.processor, report.count / load.count};
}

class Nobody final : public WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}
};

const WireEndpointOptions kRaw = {.topic = "rt/raw", .type = "bench::Raw"};

Figures MeasureEngine(const Load& load, std::size_t size) {
  const auto read = [] {
    Nobody nobody;
    Arrivals arrivals;
    const auto engine = MakeCycloneWire();
    const auto member = std::move(*engine->Join({}, nobody));
    const auto reader = member->MakeReader(
        kRaw, [&](const WireSample& sample) {
          double sent = 0;
          std::memcpy(&sent, sample.octets.data() + 4, sizeof sent);
          arrivals.Add(sent);
        }, {});
    return arrivals.Finish();
  };
  const auto write = [&] {
    Nobody nobody;
    const auto engine = MakeCycloneWire();
    const auto member = std::move(*engine->Join({}, nobody));
    std::atomic<bool> is_matched{false};
    const auto writer = std::move(*member->MakeWriter(kRaw, [&](std::size_t count) { is_matched = count > 0; }));
    while (!is_matched) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    OctetPool pool;
    for (int i = 0; i < load.count; ++i) {
      std::this_thread::sleep_for(load.period);
      auto octets = pool.Take();
      octets->resize(size + 4);
      const double now = Now();
      std::memcpy(octets->data() + 4, &now, sizeof now);
      (void)writer->Write(octets, 0);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  };
  return Measure(load, read, write);
}

template <typename T>
class Sender final : public FrameworkElement {
 public:
  explicit Sender(const Placement& placement) : FrameworkElement(placement) {}
  Output<T> output{*this, "output"};
};

template <typename T>
class Receiver final : public FrameworkElement {
 public:
  explicit Receiver(const Placement& placement) : FrameworkElement(placement) {}
  Input<T> input{*this, "input"};
};

template <typename T>
class Reading final : public Waker {
 public:
  Reading(Input<T>& input, std::function<void(const T&)> look) : input_(input), look_(std::move(look)) {}
  void Wake() noexcept override {
    if (const auto read = input_.Read(); read.is_new()) look_(*read);
  }

 private:
  Input<T>& input_;
  const std::function<void(const T&)> look_;
};

/// An application with one element.
template <typename Element>
struct Application {
  Runtime runtime;
  Group& group = runtime.Create<Group>(runtime.root(), "application");
  Element& element = runtime.Create<Element>(group, "element");
  const std::shared_ptr<WireEngine> engine = MakeCycloneWire();
  NetworkElement* network = nullptr;
  std::unique_ptr<NetworkLink> link;

  void Begin(NetworkOptions options, Port* taken) {
    network = &runtime.Create<NetworkElement>(group, "network", std::move(options));
    if (taken != nullptr) (void)Port::Connect(**network->AddTake({.topic = "/values"}, taken->type()), *taken);
    (void)runtime.MakeReady(runtime.root());
    link = std::move(*NetworkLink::Start(group, *network, *engine, false));
  }
};

template <typename T>
Figures MeasurePorts(const Load& load, const std::function<void(T&)>& fill, double (*sent)(const T&)) {
  const auto read = [&] {
    Arrivals arrivals;
    Application<Receiver<T>> application;
    Reading<T> reading(application.element.input, [&](const T& value) { arrivals.Add(sent(value)); });
    application.Begin({.member = {.name = "reader"}}, &application.element.input);
    application.element.input.SetWaker(&reading);
    const Report report = arrivals.Finish();
    application.element.input.SetWaker(nullptr);
    WaitForReaders();
    application.link.reset();
    return report;
  };
  const auto write = [&] {
    Application<Sender<T>> application;
    Output<T>& output = application.element.output;
    application.Begin({.member = {.name = "writer"}, .offers = {{.port = "/application/element/output", .topic = "/values"}}}, nullptr);
    while (output.outgoing().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    for (int i = 0; i < load.count; ++i) {
      std::this_thread::sleep_for(load.period);
      auto loan = output.Loan();
      fill(*loan);
      output.Publish(std::move(loan));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    application.link.reset();
  };
  return Measure(load, read, write);
}

void Print(const char* what, const Figures& figures) {
  fmt::print("{:32} {:8.1f} us {:8.1f} us   {:6.1f} + {:6.1f} us   {:5.1f} %\n", what, 1e6 * figures.p50, 1e6 * figures.p99,
             1e6 * figures.processor_writing, 1e6 * figures.processor_reading, 100 * figures.arrived);
}

// What Publish() costs, in nanoseconds.
double PublishingTime(Output<Block>& output) {
  constexpr int kCount = 200'000;
  double best = 1;
  for (int round = 0; round < 20; ++round) {
    const OwnCycle cycle(SteadyClock().Now());
    const double began = Now();
    for (int i = 0; i < kCount; ++i) output.Publish(Block{});
    best = std::min(best, (Now() - began) / kCount);
  }
  return 1e9 * best;
}

void PrintPublishing() {
  Application<Sender<Block>> application;
  (void)application.runtime.MakeReady(application.runtime.root());
  fmt::print("Publish() of 128 B: {:.1f} ns without a network, ", PublishingTime(application.element.output));
  application.Begin({.member = {.name = "writer"}, .offers = {{.patterns = {"**"}}}}, nullptr);
  fmt::print("{:.1f} ns offered, and read by nobody\n", PublishingTime(application.element.output));
  application.link.reset();
}

int Run() {
  (void)test::EnterOwnNetwork();
  PrintPublishing();
  fmt::print("{:32} {:>11} {:>11}   {:>18}   {:>7}\n", "", "p50", "p99", "CPU of both", "arrived");
  const Load small{3000, std::chrono::milliseconds(1)};
  const Load large{120, std::chrono::milliseconds(33)};
  for (int round = 0; round < 2; ++round) {
    Print("128 B, 1 kHz: the engine alone", MeasureEngine(small, 128));
    Print("128 B, 1 kHz: from port to port",
          MeasurePorts<Block>(small, [](Block& block) { block.values[0] = Now(); }, [](const Block& block) { return block.values[0]; }));
    Print("6.2 MB, 30 Hz: the engine alone", MeasureEngine(large, kPicture));
    Print("6.2 MB, 30 Hz: from port to port", MeasurePorts<Picture>(
                                                  large,
                                                  [](Picture& picture) {
                                                    picture.data.resize(kPicture);
                                                    picture.sent = Now();
                                                  },
                                                  [](const Picture& picture) { return picture.sent; }));
  }
  return 0;
}

}  // namespace
}  // namespace runnel

int main() { return runnel::Run(); }
