#pragma once

#include <functional>
#include <list>
#include <utility>

#include "core/element/annotation.h"
#include "core/element/unlisted_element.h"

namespace runnel {

/// Kept with an element that has a thread of its own, which uses what is around the element, and for which it waits when
/// it is destroyed. Who deletes it waits for a moment only: it is destroyed later, once that thread has ended (Leaving).
///
/// Threads: both functions by any.
struct OwnThread final : Annotation {
  OwnThread(std::function<bool()> works, std::function<void()> ask)
      : is_at_work(std::move(works)), ask_to_end(std::move(ask)) {}
  const std::function<bool()> is_at_work;
  const std::function<void()> ask_to_end;

  using Tell = std::function<void(const FrameworkElement& element)>;
  /// Asks all at and below `top` to end; of the root also those that are Leaving. False, and `tell` for each of them:
  /// some have not. Under the structure lock, if `top` is in the tree.
  static bool AskToEnd(FrameworkElement& top, const Tell& tell = {});
};

/// Kept with the root of the tree: what has been deleted, and has a thread that has not ended yet. Under the structure
/// lock.
struct Leaving final : Annotation {
  std::list<UnlistedElement> elements = {};
};

}  // namespace runnel
