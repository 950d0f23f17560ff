#pragma once

#include "core/channel/waker.h"
#include "core/lockfree/event.h"

namespace runnel {

/// What the reader of one input sleeps on until a publisher, or a new connection, brings something.
class ArrivalEvent final : public Waker {
 public:
  void Wake() noexcept override { event_.Notify(); }

  template <typename HasCome>
  [[nodiscard]] bool Wait(KernelFutex::Deadline deadline, HasCome&& has_come) {
    return event_.Wait(deadline, has_come);
  }

 private:
  Event<> event_;
};

}  // namespace runnel
