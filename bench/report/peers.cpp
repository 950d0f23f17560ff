#include "bench/report/peers.h"

#include <vector>

#include "bench/report/text.h"

namespace runnel::bench {

namespace {

// What both runs have measured, so that their figures can be divided by it. Theirs is of two virtual
// cores of a Xeon at 2.5 GHz, GCC 12, -O3.
struct Yardstick {
  std::string shown;
  double theirs;
  std::string workload;
  std::string subject;
  std::string quantity;
};

const std::string kQueue = "queue of 128 B, two threads";
const std::string kLatency = "one-way latency of 128 B, polled";
const std::string kImages = "image transport, ";

const Yardstick& YardstickOf(const std::string& quantity) {
  static const Yardstick fetch_add{"f", 6.3, kBaselineWorkload, kFetchAdd, "time"};
  static const Yardstick queue{"x boost spsc", 12.5, kQueue, "boost spsc_queue", "throughput"};
  static const Yardstick latency{"x seqlock", 187, kLatency, "seqlock", "p50"};
  static const Yardstick images{"x filling", 7.3, kImages + "0 consumers", "filling alone", "CPU"};
  if (quantity == queue.quantity) return queue;
  if (quantity == latency.quantity) return latency;
  return quantity == images.quantity ? images : fetch_add;
}

struct Peer {
  std::string workload;
  std::string subject;  // Runnel's
  std::string quantity;
  std::string name;
  double value;  // in the unit of Runnel's
};

const std::string kRing = "ring of 5, 4x4 double";
const std::string kModules = "modules, thread";
const std::string kQueued = "queued input";
const std::string kTriggered = "triggered modules";

const std::vector<Peer>& Peers() {
  static const std::vector<Peer> peers = {
      {kRing, kModules, "time", "FINROC 17.03, cheap copy", 1000 / 1.24},
      {kRing, kModules, "time", "FINROC 17.03, standard ports", 1000 / 1.03},
      {kRing, kModules, "time", "Orocos RTT 2.9, lock-free data", 1000 / 0.59},
      {kRing, kModules, "time", "Cyclone DDS, one process", 1000 / 0.14},
      {kRing, kModules, "time", "ROS 1, nodelet style", 1000 / 0.10},
      {kRing, kModules, "time", "iceoryx, one process", 1000 / 0.09},
      {kRing, "raw ports", "time", "FINROC 17.03, thread-local pool", 1000 / 3.7},
      {kRing, "raw ports", "time", "FINROC 17.03, zero copy", 1000 / 3.15},
      {"publish a double, 1 input", "Publish", "time", "FINROC, thread-local pool", 47},
      {"publish a double, 7 inputs", "Publish", "time", "FINROC, thread-local pool", 167},
      {"publish a double, 15 inputs", "Publish", "time", "FINROC, thread-local pool", 338},
      {"get a copy of a double", "Get", "time", "FINROC, cheap copy (a data race)", 2},
      {"get a copy of 128 B", "Get", "time", "FINROC, standard ports", 18.6},
      {"loan + publish an image, 1 input", "Loan, Publish", "time", "FINROC, by pointer", 103},
      {"loan + publish an image, 15 inputs", "Loan, Publish", "time", "FINROC, by pointer", 455},
      {kQueue, kQueued, "throughput", "FINROC (drops silently)", 2.1},
      {kQueue, kQueued, "throughput", "Orocos RTT 2.9", 0.83},
      {kQueue, kQueued, "throughput", "Cyclone DDS", 0.36},
      {kQueue, kQueued, "throughput", "iceoryx", 0.32},
      {kQueue, kQueued, "throughput", "ROS 1", 0.25},
      {kLatency, "Read", "p50", "FINROC", 484},
      {kLatency, "Read", "p50", "Orocos RTT 2.9", 340},
      {kImages + "1 consumer", kTriggered, "CPU", "FINROC", 7.4},
      {kImages + "7 consumers", kTriggered, "CPU", "FINROC", 7.2},
      {kImages + "15 consumers", kTriggered, "CPU", "FINROC", 8.2},
      {kImages + "15 consumers", kTriggered, "CPU", "Orocos RTT 2.9, by value", 172},
      {kImages + "15 consumers", kTriggered, "CPU", "ROS 1, one process, pool", 9.9},
      {kImages + "15 consumers", kTriggered, "CPU", "iceoryx and daemon", 10.3},
  };
  return peers;
}

double OursOf(const Yardstick& yardstick, const std::string& group, const Results& results) {
  if (yardstick.subject == kFetchAdd) return results.FetchAdd(group);
  const auto* found = results.Find(yardstick.workload, yardstick.subject, yardstick.quantity);
  return found != nullptr ? found->Typical() : 0;
}

}  // namespace

std::string PeerTable(const Results& results) {
  TextTable table({"workload: by", "Runnel", "framework, elsewhere", "its figure", "ratio"});
  bool is_empty = true;
  for (const Peer& peer : Peers()) {
    const auto* mine = results.Find(peer.workload, peer.subject, peer.quantity);
    if (mine == nullptr) continue;
    const Yardstick& yardstick = YardstickOf(peer.quantity);
    const double ours = OursOf(yardstick, mine->group, results);
    if (ours <= 0 || mine->Typical() <= 0) continue;
    const double own = mine->Typical() / ours;
    const double theirs = peer.value / yardstick.theirs;
    table.Add({peer.workload + ": " + peer.subject, Rounded(own) + " " + yardstick.shown, peer.name,
               Rounded(theirs) + " " + yardstick.shown,
               Rounded(mine->quantity.more_is_better ? own / theirs : theirs / own)});
    is_empty = false;
  }
  return is_empty ? "" : table.ToString();
}

}  // namespace runnel::bench
