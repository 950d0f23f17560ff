#include "bench/report/bars.h"

#include <sstream>

namespace runnel::bench {

namespace {

constexpr auto kAtMost = Bar::Kind::kAtMost;
constexpr auto kAtLeast = Bar::Kind::kAtLeast;

const std::string kRing = "ring of 5, 4x4 double";
const std::string kPublish = "publish a double, ";
const std::string kImage = "loan + publish an image, ";
const std::string kLease = "lease a large value, ";
const std::string kQueue = "queue of 128 B, two threads";
const std::string kLatency = "one-way latency of 128 B, polled";
const std::string kTransport = "image transport, ";
const std::string kModules = "triggered modules";

const Bar::Reference kPublishToOne{kPublish + "1 input", "Publish", "1 input"};
const Bar::Reference kImageToOne{kImage + "1 input", "Loan, Publish", "1 input"};
const Bar::Reference kFilling{kTransport + "0 consumers", "filling alone", "filling alone"};
const Bar::Reference kNobody{kTransport + "0 consumers", kModules, "0 consumers"};

// Readers of one port must cost no more than readers of a port each.
Bar LeaseBeside(const std::string& threads) {
  return {kLease + threads, "Read", kAtMost, 1.2, {kLease + threads, "a port for each", "a port each"}};
}

}  // namespace

const std::vector<Bar>& Bars() {
  static const std::vector<Bar> bars = {
      {kRing, "modules, thread", kAtMost, 20},
      {kRing, "modules, simulated time", kAtMost, 20},
      {kRing, "raw ports", kAtMost, 12},

      {kPublish + "1 input", "Publish", kAtMost, 2},
      {kPublish + "7 inputs", "Publish", kAtMost, 2},
      {kPublish + "15 inputs", "Publish", kAtMost, 2},
      {kPublish + "1000 inputs", "Publish", kAtMost, 2},
      {kPublish + "1000 inputs", "Publish", kAtMost, 1.2, kPublishToOne},

      {"get a copy of a double", "Get", kAtMost, 0.5},
      {"get a copy of 128 B", "Get", kAtMost, 2},

      {kImage + "1 input", "Loan, Publish", kAtMost, 6},
      {kImage + "15 inputs", "Loan, Publish", kAtMost, 6},
      {kImage + "1000 inputs", "Loan, Publish", kAtMost, 6},
      {kImage + "1000 inputs", "Loan, Publish", kAtMost, 1.2, kImageToOne},

      {kLease + "1 thread", "Read", kAtMost, 1.5},
      LeaseBeside("2 threads"),
      LeaseBeside("4 threads"),
      LeaseBeside("8 threads"),
      LeaseBeside("16 threads"),

      {kQueue, "queued input", kAtLeast, 0.7, {kQueue, "boost spsc_queue", "boost spsc_queue"}, "throughput"},
      {kQueue,
       "queued input, drop oldest",
       kAtLeast,
       0.7,
       {kQueue, "boost spsc_queue", "boost spsc_queue"},
       "throughput"},
      {kLatency, "Read", kAtMost, 1.5, {kLatency, "seqlock", "seqlock"}, "p50"},

      {kTransport + "0 consumers", kModules, kAtMost, 1.15, kFilling, "CPU"},
      {kTransport + "1 consumer", kModules, kAtMost, 1.15, kFilling, "CPU"},
      {kTransport + "7 consumers", kModules, kAtMost, 1.15, kFilling, "CPU"},
      {kTransport + "15 consumers", kModules, kAtMost, 1.15, kFilling, "CPU"},
      {kTransport + "1 consumer", kModules, kAtMost, 1.1, kNobody, "peak RSS"},
      {kTransport + "7 consumers", kModules, kAtMost, 1.1, kNobody, "peak RSS"},
      {kTransport + "15 consumers", kModules, kAtMost, 1.1, kNobody, "peak RSS"},
  };
  return bars;
}

Verdict Judge(const Bar& bar, const Measurement& measurement, const Results& results) {
  const bool is_upper = bar.kind == kAtMost;
  std::ostringstream words;
  words << (is_upper ? "<= " : ">= ") << bar.limit << (bar.reference.workload.empty() ? " " : " x ")
        << bar.reference.shown;
  double reference = results.FetchAdd(measurement.group);
  if (!bar.reference.workload.empty()) {
    const auto* found = results.Find(bar.reference.workload, bar.reference.subject, bar.quantity);
    reference = found != nullptr ? found->Typical() : 0;
  }
  const double value = measurement.Typical();
  if (reference <= 0 || value <= 0) return {words.str()};
  const double limit = bar.limit * reference;
  return {words.str(), true, is_upper ? value <= limit : value >= limit};
}

}  // namespace runnel::bench
