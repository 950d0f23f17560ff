#pragma once

#include <cstdint>
#include <vector>

#include "core/element/runtime.h"
#include "core/port/port.h"

namespace runnel {

/// Inputs by which outputs set parameters (Configurable::Feed()) are made as soon as somebody looks for them. Whoever looks,
/// and may be refused in the end, has one of these: at its end those go again that its thread has made meanwhile, unless
/// something is connected there, or waits for it.
///
/// Threads: by the one that has made it, the latest first; its end, if not all are kept, as Runtime::Delete().
class NewFeeds {
 public:
  explicit NewFeeds(Runtime& runtime) : runtime_(runtime) { current_ = this; }
  ~NewFeeds();
  NewFeeds(const NewFeeds&) = delete;
  NewFeeds& operator=(const NewFeeds&) = delete;
  void KeepAll() noexcept { made_.clear(); }

  /// `feed` is the only port of an element that its parameter owns.
  static void Note(const Port& feed);

 private:
  static thread_local NewFeeds* current_;
  NewFeeds* const outer_ = current_;
  Runtime& runtime_;
  std::vector<std::uint64_t> made_ = {};  // ids of the owned elements
};

}  // namespace runnel
