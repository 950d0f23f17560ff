#pragma once

#include <memory>
#include <mutex>

#include "core/base/result.h"
#include "core/types/any_value.h"

namespace runnel {

class Port;

/// What a person's value by hand has besides the value (Port::PublishByHand(), Setter::kPerson): who has to be heard of for
/// it, and what readers find if he is not. Kept with the port (PortExtras), and goes along to one that takes its place;
/// what an undo brings back has a new one, as nobody drives it.
///
/// Threads:    any, under `mutex`, which comes after the structure lock. PublishByHand() calls `fill` under it.
/// Ownership:  shared: who watches a deadline holds on to it without the structure lock.
struct HandSlot {
  /// Of whoever sets values. Port::Release() ends it.
  struct Hold {
    virtual ~Hold() = default;
    AnyValue safe_value;     ///< none: it has no deadline, and its value stays
    bool is_renewed = true;  ///< with the value that is being set: a value of somebody else ends the hold
  };

  /// The port's own one, made when it is needed. Under the structure lock.
  [[nodiscard]] static std::shared_ptr<HandSlot> Of(Port& port);
  /// nullptr: nobody has needed one. Under the structure lock.
  [[nodiscard]] static std::shared_ptr<HandSlot> Find(const Port& port);

  /// In the place of the value by hand, if there is one: at once, without the structure lock. Under `mutex`.
  [[nodiscard]] Result<void> Publish(const AnyValue& value) const;

  std::mutex mutex;
  Port* stand_in = nullptr;    ///< guarded by mutex; nullptr: nothing is set by hand
  std::unique_ptr<Hold> hold;  ///< guarded by mutex
};

}  // namespace runnel
