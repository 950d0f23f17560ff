#pragma once

#include <functional>
#include <utility>

#include "core/channel/waker.h"
#include "core/element/annotation.h"

namespace runnel {

/// "Besides new data at my inputs, something else sets me off, if triggers do": the annotation of an element that is
/// Executable, by which an executor says whom to wake.
///
/// Threads: under the structure lock. What is set is woken inside an epoch guard, so that the executor knows when
///          nobody does any more.
class WakeSource final : public Annotation {
 public:
  /// `set`: from now on this waker; nullptr: nobody. It wakes at once if something waits already.
  explicit WakeSource(std::function<void(Waker*)> set) : set_(std::move(set)) {}
  void SetWaker(Waker* waker) const { set_(waker); }

 private:
  std::function<void(Waker*)> set_;
};

}  // namespace runnel
