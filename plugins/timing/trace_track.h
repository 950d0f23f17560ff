#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/lockfree/spsc_queue.hpp>

#include "core/base/clock.h"
#include "core/module/executable.h"
#include "core/port/port.h"
#include "plugins/timing/tick_clock.h"

namespace runnel {

/// What has happened in a cycle, as short as it can be said. Who is meant is a number that whoever reads
/// it has given out.
struct TraceEvent {
  enum class Kind : std::uint8_t {
    kCycle,        ///< words: begin, end, the cycle's time on the application's clock; number: the cycle's
    kUpdate,       ///< words: begin, end; number: the element's
    kPublication,  ///< words: when it was noticed, how many values; number: the port's
    kFault,        ///< words: when; number: the element's; its text follows
    kArrow,        ///< words: when, which Arrow, the number of what goes along; number: the name's
    kText,         ///< the bytes of `words`, as far as `length` says: goes on with the fault's message
  };
  static constexpr std::size_t kTextBytes = 24;
  /// From one update to another: what a value goes back to.
  enum class Arrow : std::uint8_t { kBegins, kPasses, kEnds };

  Kind kind = Kind::kCycle;
  Phase phase = Phase::kUpdate;
  std::uint8_t length = 0;
  std::uint64_t number = 0;
  std::array<std::int64_t, 3> words{};  ///< times in ns, of the machine unless said otherwise
};

/// An output that is looked at after each update of its module.
struct TracedPort {
  const Port* port;
  std::uint64_t number;
  std::uint64_t publications;  ///< seen so far
};

/// What is written down of the cycles of one thread: taken in the cycle, read by another thread.
///
/// Threads:     Note…() and Now() by the thread of the cycles; events() and TakeLost() by one reader.
/// Progress:    wait-free. What finds no room is counted and lost.
/// Allocation:  in the constructor only. Asks the system for the time, once a millisecond.
class TraceTrack {
 public:
  explicit TraceTrack(std::size_t capacity) : events_(capacity) {}

  [[nodiscard]] Time Now() noexcept { return clock_.Now(); }

  /// From when to when, on the machine's clock.
  struct Span {
    Time began;
    Time ended;
  };
  void NoteCycle(Span span, Time application_time, std::uint64_t number) noexcept {
    Add({.kind = TraceEvent::Kind::kCycle,
         .number = number,
         .words = {Count(span.began), Count(span.ended), Count(application_time)}});
  }
  /// An update that has just ended, and what has been published since the one before.
  void NoteUpdate(Span span, Phase phase, std::uint64_t element, std::vector<TracedPort>& ports) noexcept {
    const std::int64_t now = Count(span.ended);
    Add({.kind = TraceEvent::Kind::kUpdate, .phase = phase, .number = element, .words = {Count(span.began), now, 0}});
    for (TracedPort& each : ports) {
      const std::uint64_t before = each.publications;
      each.publications = each.port->publications();
      if (each.publications <= before) continue;  // fewer: the channel of another one, taken over
      Add({.kind = TraceEvent::Kind::kPublication,
           .number = each.number,
           .words = {now, static_cast<std::int64_t>(each.publications - before), 0}});
    }
  }
  void NoteArrow(TraceEvent::Arrow arrow, std::uint64_t name, std::uint64_t number, Time when) noexcept {
    Add({.kind = TraceEvent::Kind::kArrow,
         .number = name,
         .words = {Count(when), static_cast<std::int64_t>(arrow), static_cast<std::int64_t>(number)}});
  }
  void NoteFault(std::uint64_t element, std::string_view message) noexcept {
    Add({.kind = TraceEvent::Kind::kFault, .number = element, .words = {Count(Now()), 0, 0}});
    for (; !message.empty(); message.remove_prefix(std::min(message.size(), kPart))) {
      TraceEvent text{.kind = TraceEvent::Kind::kText};
      text.length = static_cast<std::uint8_t>(std::min(message.size(), kPart));
      std::memcpy(text.words.data(), message.data(), text.length);
      Add(text);
    }
  }

  /// One writer, the thread of the cycles, and one reader.
  using Events = boost::lockfree::spsc_queue<TraceEvent>;
  [[nodiscard]] Events& events() noexcept { return events_; }
  /// How many have been lost since the last call.
  [[nodiscard]] std::uint64_t TakeLost() noexcept {
    const std::uint64_t lost = lost_.load(std::memory_order_relaxed);
    return lost - std::exchange(lost_taken_, lost);
  }

 private:
  static constexpr std::size_t kPart = TraceEvent::kTextBytes;
  static std::int64_t Count(Time time) noexcept { return time.time_since_epoch().count(); }

  void Add(const TraceEvent& event) noexcept {
    if (events_.push(event)) return;
    // relaxed: a count, which one thread writes.
    lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  Events events_;
  TickClock clock_;
  std::atomic<std::uint64_t> lost_{0};
  std::uint64_t lost_taken_ = 0;  // the reader's
};

/// What is written down of one element. By the thread whose cycle has it.
struct TracedElement {
  std::uint64_t number = 0;
  std::vector<TracedPort> ports = {};
  TraceTrack* track = nullptr;  ///< of the thread that is just running it
};

class FrameworkElement;

/// Who has it written down what cycles do, and gives out the numbers by which that is done. Must outlive
/// the scheduler and the runtime.
class CycleTracer {
 public:
  /// Where the cycles of a thread container are noted; the same for the same container. Under the
  /// structure lock.
  [[nodiscard]] virtual TraceTrack& TrackOf(std::uint64_t id, const std::string& path) = 0;
  /// An element is going to be run. Under the structure lock.
  [[nodiscard]] virtual std::unique_ptr<TracedElement> Watch(FrameworkElement& element) = 0;
  /// By which arrows of this name are noted. Any thread.
  [[nodiscard]] virtual std::uint64_t NumberOf(const std::string& name) = 0;
  /// A thread has been kept between two cycles, from about `began` to `ended` of the machine's clock.
  /// Outside of cycles, by whoever has kept it.
  virtual void OnHold(const std::string& path, Time began, Time ended) noexcept = 0;

 protected:
  virtual ~CycleTracer() = default;
};

}  // namespace runnel
