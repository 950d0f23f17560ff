// What publishing costs while another thread connects and disconnects a reader as fast as it can,
// and how many changes that thread gets through. The publisher has one reader that stays, and
// publishes ten doubles a cycle.

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "bench/core/rivals/mutex_shared_pointer.h"
#include "bench/core/support/pinned_thread.h"
#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

constexpr int kPublicationsOfACycle = 10;

class RunnelWiring {
 public:
  RunnelWiring() { MustSucceed(Port::Disconnect(star_.output(), Guest())); }

  void Connect() { MustSucceed(Port::Connect(star_.output(), Guest())); }
  void Disconnect() { MustSucceed(Port::Disconnect(star_.output(), Guest())); }
  void PublishCycle(double value) {
    const InACycle cycle;
    for (int i = 0; i < kPublicationsOfACycle; ++i) star_.output().Publish(value);
  }

 private:
  Input<double>& Guest() { return star_.input(1); }

  Star<double> star_{2};
};

/// A list of readers, guarded by a mutex while the publisher goes through it.
class GuardedList {
 public:
  void Connect() {
    const std::lock_guard lock(mutex_);
    readers_.push_back(&guest_);
  }
  void Disconnect() {
    const std::lock_guard lock(mutex_);
    std::erase(readers_, &guest_);
  }
  void PublishCycle(double value) {
    for (int i = 0; i < kPublicationsOfACycle; ++i) {
      const auto shared = std::make_shared<const double>(value);
      const std::lock_guard lock(mutex_);
      for (auto* reader : readers_) reader->Write(shared);
    }
  }

 private:
  using Reader = MutexSharedPointer<double>;

  Reader resident_;
  Reader guest_;
  std::mutex mutex_;
  std::vector<Reader*> readers_{&resident_};
};

template <typename Wiring>
void RunWiring(benchmark::State& state, bool changes_go_on) {
  Wiring wiring;
  std::atomic<std::uint64_t> changes{0};
  const PinnedThread first_core(0);
  std::jthread changer([&](const std::stop_token& stop) {
    const PinnedThread second_core(1);
    while (changes_go_on && !stop.stop_requested()) {
      wiring.Connect();
      wiring.Disconnect();
      changes.fetch_add(2, std::memory_order_relaxed);
    }
  });
  double value = 0;
  const std::uint64_t before = changes;
  while (state.KeepRunningBatch(kPublicationsOfACycle)) wiring.PublishCycle(value += 1);
  state.counters["changes"] =
      benchmark::Counter(static_cast<double>(changes - before) * 1e-3, benchmark::Counter::kIsRate);
}

template <typename Wiring>
void AddWiring(Suite& suite, Role role, const std::string& name, bool changes_go_on) {
  suite.Add(role, name, [changes_go_on](benchmark::State& state) { RunWiring<Wiring>(state, changes_go_on); });
}

}  // namespace

void AddConnecting(Suite& suite) {
  for (const bool changes_go_on : {false, true}) {
    Workload workload{changes_go_on ? "publish while connections change" : "publish, connections at rest"};
    if (changes_go_on) workload.quantities.push_back({"changes", "k/s", true});
    suite.Start(workload);
    AddWiring<RunnelWiring>(suite, Role::kRunnel, "Publish", changes_go_on);
    AddWiring<GuardedList>(suite, Role::kRival, "mutex, list of readers", changes_go_on);
  }
}

}  // namespace runnel::bench
