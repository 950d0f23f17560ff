#pragma once

#include <cstdint>
#include <vector>

#include "core/element/annotation.h"
#include "core/element/runtime.h"
#include "core/port/port.h"

namespace runnel {

/// Inputs by which outputs set parameters (Configurable::Feed()) are made as soon as somebody looks for them: whoever
/// then connects nothing there deletes them again. An annotation of the root.
///
/// Threads: under the structure lock.
class UnusedFeeds final : public Annotation {
 public:
  /// `feed` is the only port of an element that its parameter owns.
  static void NoteNew(Port& feed);

  /// At its end, the new ones go to which nothing is connected, nor waits for it. For those that
  /// could not go for lack of memory, that is at the end of the next one.
  ///
  /// Threads: as Runtime::Delete().
  class Cleanup {
   public:
    explicit Cleanup(Runtime& runtime) : runtime_(runtime) {}
    ~Cleanup();
    Cleanup(const Cleanup&) = delete;
    Cleanup& operator=(const Cleanup&) = delete;

   private:
    Runtime& runtime_;
  };

 private:
  std::vector<std::uint64_t> new_;  // ids of the owned elements
};

}  // namespace runnel
