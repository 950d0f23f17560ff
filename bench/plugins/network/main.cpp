// What it costs to have ports read by another process: bin/bench_network [publishing] [latency] [uneven] [pictures] [throughput]
// [discovery] [many] [crowd] [large_crowd], or all of them.
// Beside each figure stands that of the engine alone, by the seam of octets, in the same run, one after the other.
// All processes are in a network of their own if the system permits that.

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "bench/plugins/network/network_bench.h"
#include "tests/support/own_network.h"

namespace runnel {
namespace {

constexpr double kMicro = 1e6;

Figures Median(std::vector<Figures> rounds) {
  std::ranges::sort(rounds, {}, &Figures::p50);
  return rounds[rounds.size() / 2];
}

void PrintLatency(const char* what, const Figures& figures) {
  fmt::print("{:32} {:8.1f} us {:8.1f} us   {:7.1f} + {:7.1f} us   {:5.1f} %", what, kMicro * figures.p50,
             kMicro * figures.p99, kMicro * figures.processor_writing, kMicro * figures.processor_reading,
             100 * figures.arrived / figures.sent);
}

// Round by round, since the machine is faster and slower in turn: median, and the quarter on either side.
void PrintRatios(const std::vector<Figures>& whole, const std::vector<Figures>& alone) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < whole.size(); ++i) ratios.push_back(whole[i].p50 / alone[i].p50);
  std::ranges::sort(ratios);
  const std::size_t count = ratios.size();
  fmt::print("   {:4.2f} ({:4.2f} to {:4.2f})\n", ratios[count / 2], ratios[count / 4], ratios[count - 1 - count / 4]);
}

/// A way from port to port that is held beside the engine.
struct Way {
  const char* name;
  std::function<Figures()> measure;
};

// In turn, so that whatever else the machine does is in all of them.
void CompareLatency(const char* what, int rounds, const std::function<Figures()>& engine,
                    const std::vector<Way>& ways) {
  std::vector<Figures> alone;
  std::vector<std::vector<Figures>> whole(ways.size());
  for (int round = 0; round < rounds; ++round) {
    alone.push_back(engine());
    for (std::size_t i = 0; i < ways.size(); ++i) whole[i].push_back(ways[i].measure());
  }
  fmt::print("{:32} {:>11} {:>11}   {:>20}   {:>7}   {}\n", what, "p50", "p99", "CPU of both a value", "arrived",
             "p50 to the engine's");
  PrintLatency("  the engine alone", Median(alone));
  fmt::print("\n");
  for (std::size_t i = 0; i < ways.size(); ++i) {
    PrintLatency(ways[i].name, Median(whole[i]));
    PrintRatios(whole[i], alone);
  }
}

constexpr const char* kByNetwork = "  ports, by the network's thread";
constexpr const char* kByUdp = "  ports, without shared memory";
constexpr const char* kAfterCycle = "  ports, sent after the cycle";

void PrintThroughput(const char* what, std::size_t size, const Figures& engine, const std::vector<Way>& ways) {
  const auto print = [&](const char* who, const Figures& figures) {
    fmt::print("{:32} {:9.0f} values/s {:8.1f} MB/s   {:7.1f} + {:7.1f} us CPU a value   {:4.2f}\n", who, figures.rate,
               1e-6 * figures.rate * static_cast<double>(size), kMicro * figures.processor_writing,
               kMicro * figures.processor_reading, figures.rate / engine.rate);
  };
  fmt::print("{}\n", what);
  print("  the engine alone", engine);
  for (const Way& way : ways) print(way.name, way.measure());
}

std::vector<Way> WaysOfBlocks(const Load& load, ValueQuality quality) {
  return {{kByNetwork, [=] { return MeasureBlocks(load, quality, ValueSending::kNetwork); }},
          {kAfterCycle, [=] { return MeasureBlocks(load, quality, ValueSending::kAfterCycle); }}};
}

void CompareBlocks(const char* what, bool is_even) {
  constexpr int kRounds = 9;
  const Load load{300, std::chrono::milliseconds(1), is_even};
  CompareLatency(
      what, kRounds, [&] { return MeasureEngine(load, sizeof(Block)); }, WaysOfBlocks(load, ValueQuality::kNewest));
}

void Latency() { CompareBlocks("128 B at 1 kHz", true); }
void Uneven() { CompareBlocks("128 B at about 1 kHz, unevenly", false); }

void Pictures() {
  const Load load{40, std::chrono::milliseconds(33)};
  CompareLatency(
      "6.2 MB at 30 Hz", 3, [&] { return MeasureEngine(load, kPicture); },
      {{kByNetwork, [&] { return MeasurePictures(load); }}, {kByUdp, [&] { return MeasurePictures(load, false); }}});
}

void Throughput() {
  const Load flood{0, {}};
  PrintThroughput("128 B, as fast as it goes", sizeof(Block), MeasureEngine(flood, sizeof(Block)),
                  WaysOfBlocks(flood, ValueQuality::kEach));
  PrintThroughput(
      "6.2 MB, as fast as it goes", kPicture, MeasureEngine(flood, kPicture),
      {{kByNetwork, [&] { return MeasurePictures(flood); }}, {kByUdp, [&] { return MeasurePictures(flood, false); }}});
}

int Run(const std::vector<std::string>& wanted) {
  const std::vector<std::pair<std::string_view, void (*)()>> parts = {{"publishing", PrintPublishing},
                                                                      {"latency", Latency},
                                                                      {"uneven", Uneven},
                                                                      {"pictures", Pictures},
                                                                      {"throughput", Throughput},
                                                                      {"discovery", [] { PrintDiscovery(50); }},
                                                                      {"many", [] { PrintMany(500); }},
                                                                      {"crowd", [] { PrintCrowd(30); }},
                                                                      {"large_crowd", [] { PrintCrowd(100); }}};
  (void)test::EnterOwnNetwork();
  bool is_known = wanted.empty();
  for (const auto& [name, run] : parts) {
    if (!wanted.empty() && std::ranges::find(wanted, name) == wanted.end()) continue;
    is_known = true;
    run();
    std::fflush(stdout);
  }
  if (!is_known)
    fmt::print(stderr,
               "usage: bench_network [publishing] [latency] [uneven] [pictures] [throughput] [discovery] [many] "
               "[crowd] [large_crowd]\n");
  return is_known ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace runnel

int main(int count, char** words) { return runnel::Run({words + 1, words + count}); }
