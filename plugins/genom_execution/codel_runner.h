#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "plugins/genom_execution/component_table.h"
#include "plugins/genom_execution/exclusion.h"
#include "plugins/genom_execution/request.h"

namespace runnel::genom_execution {

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
  CodelRunner(const CodelRunner&) = delete;
  CodelRunner& operator=(const CodelRunner&) = delete;

  /// Runs the codel if it may, and says what it returned. False: it may not run yet, or is being run by another
  /// thread; the same call is to be made again later, and nothing else meanwhile.
  /// `request`: of whose activity it is; nullptr for permanent ones.
  [[nodiscard]] bool Run(std::size_t codel, Request* request, Event& event);
  /// The same for an attribute's values.
  [[nodiscard]] bool Assign(const ServiceTable& attribute, void* data);
  /// The exception that the last codel has returned, with its detail, if it is one of these; else false.
  [[nodiscard]] bool TakeException(Event event, std::span<const Event> throws, Outcome& outcome) const noexcept;
  /// Whether a codel has been handed to another thread and has not come back.
  [[nodiscard]] bool is_away() const noexcept;

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
