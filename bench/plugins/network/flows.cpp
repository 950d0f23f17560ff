#include <cstring>
#include <thread>

#include <fmt/core.h>

#include "bench/plugins/network/network_bench.h"
#include "core/module/after_cycle.h"
#include "core/port/own_cycle.h"

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

template <typename T>
Figures MeasurePorts(const Load& load, ValueQuality quality, ValueSending sending, void (*fill)(T&), double (*sent)(const T&)) {
  const auto read = [&](Course& course) {
    Application<Receiver<T>> application;
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
    Output<T>& output = application.element.output;
    application.Begin({.member = {.name = "writer"},
                       .offers = {{.port = "/application/element/output", .topic = "/values", .quality = quality, .sending = sending}}},
                      nullptr);
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
    const auto reader = member->MakeReader(
        kRaw, [&](const WireSample& sample) {
          double sent = 0;
          std::memcpy(&sent, sample.octets.data() + 4, sizeof sent);
          course.Note(sent);
        }, {});
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
  return MeasurePorts<Block>(load, quality, sending, [](Block& block) { block.values[0] = Now(); },
                             [](const Block& block) { return block.values[0]; });
}

Figures MeasurePictures(const Load& load) {
  return MeasurePorts<Picture>(load, ValueQuality::kNewest, ValueSending::kNetwork,
                               [](Picture& picture) {
                                 picture.data.resize(kPicture);
                                 picture.sent = Now();
                               },
                               [](const Picture& picture) { return picture.sent; });
}

void PrintPublishing() {
  Application<Sender<Block>> application;
  (void)application.runtime.MakeReady(application.runtime.root());
  fmt::print("Publish() of 128 B: {:.1f} ns without a network, ", PublishingTime(application.element.output));
  application.Begin({.member = {.name = "writer"}, .offers = {{.patterns = {"**"}}}}, nullptr);
  fmt::print("{:.1f} ns offered, and read by nobody\n", PublishingTime(application.element.output));
  application.link.reset();
}

}  // namespace runnel
