#include <array>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/plugins/network/network_bench.h"
#include "core/module/after_cycle.h"
#include "core/port/cycle.h"

namespace runnel {

namespace {

class Nobody final : public WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}
};

const WireEndpointOptions kRaw = {.topic = "rt/raw", .type = "bench::Raw"};

template <typename T>
class Reading final : public Waker {
 public:
  Reading(Input<T>& input, Course& course, double (*sent)(const T&)) : input_(input), course_(course), sent_(sent) {}
  void Wake() noexcept override {
    if (const auto read = input_.Read(); read.is_new()) course_.Note(sent_(*read));
  }

 private:
  Input<T>& input_;
  Course& course_;
  double (*const sent_)(const T&);
};

OfferOptions OfferOf(ValueQuality quality, ValueSending sending) {
  return {.port = "/application/element/output", .topic = "/values", .quality = quality, .sending = sending};
}

template <typename T>
Figures MeasurePorts(const Load& load, const OfferOptions& offer, bool has_shared_memory, void (*fill)(T&),
                     double (*sent)(const T&)) {
  const auto read = [&](Course& course) {
    Application<Receiver<T>> application;
    if (!has_shared_memory) application.engine = MakeCycloneWire();
    Input<T>& input = application.element.input;
    Reading<T> reading(input, course, sent);
    application.Begin({.member = {.name = "reader"}}, &input);
    input.SetWaker(&reading);
    course.WaitForEnd();
    input.SetWaker(nullptr);
    WaitForReaders();
    application.link.reset();
  };
  const auto write = [&](Course& course) {
    Application<Sender<T>> application;
    if (!has_shared_memory) application.engine = MakeCycloneWire();
    Output<T>& output = application.element.output;
    application.Begin({.member = {.name = "writer"}, .offers = {offer}}, nullptr);
    while (output.outgoing().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    course.Write([&] {
      // As executors do.
      const EpochGuard guard;
      const AfterCycleScope after;
      auto loan = output.Loan();
      fill(*loan);
      const OwnCycle cycle(SteadyClock().Now());
      output.Publish(std::move(loan));
    });
    application.link.reset();
  };
  return Measure(load, read, write);
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

}  // namespace

Figures MeasureEngine(const Load& load, std::size_t size) {
  const auto read = [](Course& course) {
    Nobody nobody;
    const auto engine = MakeCycloneWire();
    const auto member = std::move(*engine->Join({}, nobody));
    const auto reader = member->MakeReader(kRaw,
                                           [&](const WireSample& sample) {
                                             double sent = 0;
                                             std::memcpy(&sent, sample.octets.data() + 4, sizeof sent);
                                             course.Note(sent);
                                           },
                                           {});
    course.WaitForEnd();
  };
  const auto write = [&](Course& course) {
    Nobody nobody;
    const auto engine = MakeCycloneWire();
    const auto member = std::move(*engine->Join({}, nobody));
    std::atomic<bool> is_matched{false};
    const auto writer = std::move(*member->MakeWriter(kRaw, [&](std::size_t count) { is_matched = count > 0; }));
    while (!is_matched) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    OctetPool pool;
    course.Write([&] {
      auto octets = pool.Take();
      octets->resize(size + 4);
      const double now = Now();
      std::memcpy(octets->data() + 4, &now, sizeof now);
      (void)writer->Write(octets, 0);
    });
  };
  return Measure(load, read, write);
}

Figures MeasureBlocks(const Load& load, ValueQuality quality, ValueSending sending) {
  return MeasurePorts<Block>(
      load, OfferOf(quality, sending), true, [](Block& block) { block.values[0] = Now(); },
      [](const Block& block) { return block.values[0]; });
}

Figures MeasurePictures(const Load& load, bool has_shared_memory) {
  return MeasurePorts<Picture>(
      load, OfferOf(ValueQuality::kNewest, ValueSending::kNetwork), has_shared_memory,
      [](Picture& picture) {
        picture.data.resize(kPicture);
        picture.sent = Now();
      },
      [](const Picture& picture) { return picture.sent; });
}

void PrintPublishing() {
  // Before there are threads. It reads, and waits for the end of this process's end.
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) std::abort();
  const pid_t other = fork();
  if (other == 0) {
    close(ends[1]);
    Application<Receiver<Block>> reading;
    reading.Begin({.member = {.name = "reader"}}, &reading.element.input);
    char octet = 0;
    (void)!read(ends[0], &octet, 1);
    _exit(0);
  }
  {
    Application<Sender<Block>> application;
    (void)application.runtime.MakeReady(application.runtime.root());
    fmt::print("Publish() of 128 B: {:.1f} ns without a network, ", PublishingTime(application.element.output));
    application.Begin({.member = {.name = "writer"}, .offers = {{.patterns = {"**"}}}}, nullptr);
    fmt::print("{:.1f} ns offered, and read by nobody, ", PublishingTime(application.element.output));
    application.link.reset();
  }
  {
    Application<Sender<Block>> application;
    application.Begin(
        {.member = {.name = "writer"}, .offers = {OfferOf(ValueQuality::kNewest, ValueSending::kNetwork)}}, nullptr);
    while (application.element.output.outgoing().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    fmt::print("{:.1f} ns read by another process, while the network's thread is awake\n",
               PublishingTime(application.element.output));
    application.link.reset();
  }
  close(ends[1]);
  waitpid(other, nullptr, 0);
}

}  // namespace runnel
