#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "core/lockfree/wake_event.h"
#include "plugins/genom_execution/component_table.h"
#include "plugins/genom_execution/request.h"
#include "plugins/genom_execution/ticket_board.h"

namespace runnel::genom_execution {

/// Which units (codels, attributes) must not run at the same time.
class ConflictMatrix {
 public:
  explicit ConflictMatrix(const ComponentTable& component);
  [[nodiscard]] bool HasAny(std::size_t unit) const noexcept { return has_any_[unit]; }
  /// Whether it conflicts with an asynchronous codel, which may take long.
  [[nodiscard]] bool HasAsync(std::size_t unit) const noexcept { return has_async_[unit]; }
  [[nodiscard]] bool Conflict(std::size_t a, std::size_t b) const noexcept {
    return (bits_[a * words_ + b / 64] >> (b % 64) & 1) != 0;
  }

 private:
  const std::size_t words_;
  std::vector<std::uint64_t> bits_;
  std::vector<bool> has_any_;
  std::vector<bool> has_async_;
};

/// Keeps units that conflict apart, first come first served, and lets threads sleep until it is their turn.
///
/// Sleeping: who wants stores its ticket, passes a full fence, looks, and sleeps; who leaves, or has got its ticket,
/// stores that, passes a full fence, and wakes whom it finds wanting. So either the look of the one finds the other's
/// store, or the other finds it wanting; notifications stay until they are looked at. Where nobody sleeps there are no
/// fences.
///
/// Threads:    each place by one thread at a time.
class Exclusion {
 public:
  Exclusion(const ConflictMatrix& conflicts, std::size_t places, bool sleeps)
      : conflicts_(conflicts), sleeps_(sleeps), board_(places), may_look_(places) {}

  /// From now on others wait for this one. Precondition: the place wants nothing.
  void Want(std::size_t place, std::size_t unit) noexcept;
  /// Whether it may run now.
  [[nodiscard]] bool May(std::size_t place) const noexcept;
  void Leave(std::size_t place) noexcept;
  /// Sleeps until May() is worth asking again, or until `deadline` by the steady clock. Precondition: made to sleep.
  void Wait(std::size_t place, Time deadline) noexcept { may_look_[place].WaitUntil(deadline); }

 private:
  void WakeOthers(std::size_t place, std::size_t unit) noexcept;

  const ConflictMatrix& conflicts_;
  const bool sleeps_;
  TicketBoard<> board_;
  std::deque<WakeEvent> may_look_;  // by places
};

class Engine;

/// An asynchronous codel that is to be called by a thread that may wait.
class AsyncWork {
 public:
  /// Calls it. Once, by any thread. Codels that throw what is no exception of theirs: is kept, and told to the engine.
  void Run() noexcept;
  [[nodiscard]] const CodelTable& codel() const noexcept { return *codel_; }

 private:
  friend class CodelRunner;
  enum class State : std::uint8_t { kNone, kGiven, kDone };
  Engine* engine_ = nullptr;
  const CodelTable* codel_ = nullptr;
  Invocation invocation_{};
  Event event_ = nullptr;
  // release at the end of Run(), acquire by the task: what the codel did is there.
  std::atomic<State> state_{State::kNone};
};

/// What a task needs to run codels, one at a time: its place among those that are kept apart, and the context in which
/// codels raise exceptions.
///
/// Threads: the task's.
class CodelRunner {
 public:
  CodelRunner(Engine& engine, std::size_t place, std::size_t largest_detail);

  /// Runs the codel if it may, and says what it returned. False: it may not run yet, or is being run by another
  /// thread; the same call is to be made again later, and nothing else meanwhile.
  /// `request`: of whose activity it is; nullptr for permanent ones.
  [[nodiscard]] bool Run(std::size_t codel, Request* request, Event& event);
  /// The same for an attribute's values.
  [[nodiscard]] bool Assign(const ServiceTable& attribute, void* data);
  /// The exception that the last codel has returned, with its detail, if it is one of these; else false.
  [[nodiscard]] bool TakeException(Event event, std::span<const Event> throws, Outcome& outcome) const noexcept;

 private:
  /// The context first: codels get its address.
  struct Raising {
    CodelContext context;
    Event exception = nullptr;
    std::size_t size = 0;
    std::vector<std::byte> detail;
  };
  class Leaving;
  [[nodiscard]] bool Enter(std::size_t unit) noexcept;

  Engine& engine_;
  const std::size_t place_;
  Raising raising_;
  bool is_inside_ = false;  // has a ticket, or needs none: goes on with the same codel
  bool is_excluding_ = false;
  AsyncWork work_;
};

}  // namespace runnel::genom_execution
