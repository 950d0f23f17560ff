#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "core/port/converted_flow.h"
#include "core/port/hand_slot.h"
#include "core/port/port_options.h"
#include "core/port/port_stop.h"
#include "core/port/stand_in.h"

namespace runnel::internal {

/// Of an input that looks at what comes.
struct HeldToLimits {
  InputLimits limits;
  std::unique_ptr<ConvertedFlow> flow;  // on the way of each of its sources
  // By publishers. A statistic.
  std::shared_ptr<std::atomic<std::uint64_t>> out_of_bounds;
  std::unique_ptr<StandIn> default_value;  // what readers find while there is no source; made when it is needed
};

/// What few ports have.
struct PortExtras {
  std::unique_ptr<HeldToLimits> limits;
  // What readers find instead of what is published: by Port::Setter, of which the first that is there counts.
  std::array<std::unique_ptr<StandIn>, 2> by_hand;
  std::shared_ptr<HandSlot> hand_slot;  // of the first of them, once somebody has needed it
  std::optional<Time> passed_over;  // what came before that does not count once nothing is set by hand here any more
  std::shared_ptr<const PortStop> stop;
  Time blocked_since{};  // by the machine's clock

  PortExtras() = default;
  PortExtras(const PortExtras&) = delete;
  PortExtras& operator=(const PortExtras&) = delete;
  // Who watches a deadline holds on to the slot.
  ~PortExtras() {
    if (!hand_slot) return;
    const std::lock_guard lock(hand_slot->mutex);
    hand_slot->stand_in = nullptr;
  }

  /// `port` has them now.
  void StandFor(const Port& port) const noexcept {
    for (const auto& each : by_hand) {
      if (each) each->set_goes_on_at(port);
    }
    if (!limits) return;
    limits->flow->set_target(port);
    if (limits->default_value) limits->default_value->set_goes_on_at(port);
  }
};

/// That the value, one of the port's type, is within the limits.
[[nodiscard]] Result<void> CheckWithin(const Port& port, const InputLimits& limits, const void* value);

}  // namespace runnel::internal
