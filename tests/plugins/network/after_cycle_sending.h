#pragma once

#include <memory>
#include <regex>
#include <string>

#include <gmock/gmock.h>

#include "core/lockfree/thread_epoch.h"
#include "core/module/after_cycle.h"
#include "core/port/cycle.h"
#include "tests/plugins/network/gated_engine.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {

/// As an executor does it.
class OneCycle {
 public:
  explicit OneCycle(Time now) : cycle_(now) {}

 private:
  const EpochGuard guard_;
  const AfterCycleScope after_;
  const OwnCycle cycle_;
};

/// Two applications: /place and /row of the first are read by the second.
class AfterCycleSending : public testing::Test {
 protected:
  void Begin(ValueQuality quality = ValueQuality::kNewest) {
    a_.Offer({.port = "/application/module/place",
              .topic = "/place",
              .quality = quality,
              .sending = ValueSending::kAfterCycle});
    a_.Offer(
        {.port = "/application/module/row", .topic = "/row", .quality = quality, .sending = ValueSending::kAfterCycle});
    b_.Take({.topic = "/place"}, b_.module.goal);
    b_.Take({.topic = "/row"}, b_.module.wanted);
    a_.Begin();
    b_.Begin();
    WaitUntil("they are read", [&] { return IsConnected(a_.module.place) && IsConnected(a_.module.row); });
  }
  /// The first value goes by the network's thread, since nothing is known of its size. So do those that find that thread
  /// just at it: how many there are of these is its matter.
  void SendFirst() {
    PublishOutside(0);
    WaitUntil("it has come", [&] { return b_.module.goal.Read().has_value(); });
  }
  /// Of /place.
  [[nodiscard]] int Count(const std::string& what) const {
    const std::string text = a_.Text();
    std::smatch found;
    const std::regex line("as /place  [^\n]*[ (]([0-9]+) " + what);
    return std::regex_search(text, found, line) ? std::stoi(found[1]) : 0;
  }
  void PublishInCycle(double x) {
    const OneCycle cycle(a_.runtime.clock().Now());
    a_.module.place.Publish({x, 0});
  }
  void PublishOutside(double x) {
    const OwnCycle cycle(a_.runtime.clock().Now());
    a_.module.place.Publish({x, 0});
  }
  void WaitForPlace(double x) {
    WaitUntil("the newest has come", [&] { return b_.module.goal.Get().x == x; });
  }

  Gate gate_;
  const std::shared_ptr<WireEngine> engine_ = std::make_shared<GatedEngine>(MakeFakeWire(), gate_);
  Member a_{*engine_, "a"};
  Member b_{*engine_, "b"};
};

}  // namespace runnel::test
