#include "plugins/genom_execution/codel_runner.h"

#include <algorithm>
#include <cstring>

#include "core/lockfree/asymmetric_fence.h"
#include "plugins/genom_execution/engine.h"

namespace runnel::genom_execution {

ConflictMatrix::ConflictMatrix(const ComponentTable& component)
    : words_((component.units() + 63) / 64),
      bits_(component.units() * words_),
      has_any_(component.units()),
      has_async_(component.units()) {
  for (const auto& [a, b] : component.conflicts) {
    bits_[a * words_ + b / 64] |= std::uint64_t{1} << (b % 64);
    bits_[b * words_ + a / 64] |= std::uint64_t{1} << (a % 64);
    has_any_[a] = has_any_[b] = true;
    if (a < component.codels.size() && component.codels[a].is_async) has_async_[b] = true;
    if (b < component.codels.size() && component.codels[b].is_async) has_async_[a] = true;
  }
}

void Exclusion::Want(std::size_t place, std::size_t unit) noexcept {
  board_.Want(place, unit);
  WakeOthers(place, unit);  // who looked while there was no ticket
}

bool Exclusion::May(std::size_t place) const noexcept {
  return board_.May(place, [this](std::size_t a, std::size_t b) { return conflicts_.Conflict(a, b); });
}

void Exclusion::Leave(std::size_t place) noexcept {
  const std::size_t unit = board_.unit(place);
  board_.Leave(place);
  WakeOthers(place, unit);
}

void Exclusion::WakeOthers(std::size_t place, std::size_t unit) noexcept {
  if (!sleeps_) return;
  FullFence();
  board_.ForEachWaiting(
      place, unit, [this](std::size_t a, std::size_t b) { return conflicts_.Conflict(a, b); },
      [this](std::size_t other) { may_look_[other].Notify(); });
}

void AsyncWork::Run() noexcept {
  Engine& engine = *engine_;  // once it is done, the task may give the next codel at once
  try {
    event_ = codel_->call(invocation_);
  } catch (...) {
    event_ = RaiseMiddlewareError(*invocation_.context, "a codel has thrown");
  }
  state_.store(State::kDone, std::memory_order_release);
  engine.Wake();
}

/// However the codel ends, others may run.
class CodelRunner::Leaving {
 public:
  explicit Leaving(CodelRunner& runner) : runner_(runner) {}
  ~Leaving() {
    runner_.is_inside_ = false;
    if (runner_.is_excluding_) runner_.engine_.exclusion().Leave(runner_.place_);
    runner_.is_excluding_ = false;
  }
  Leaving(const Leaving&) = delete;
  Leaving& operator=(const Leaving&) = delete;

 private:
  CodelRunner& runner_;
};

CodelRunner::CodelRunner(Engine& engine, std::size_t place, std::size_t largest_detail)
    : engine_(engine), place_(place) {
  raising_.detail.resize(largest_detail);
  raising_.context.data = engine.options().glue;
  raising_.context.raise = [](Event exception, const void* detail, std::size_t size, const CodelContext* self) {
    auto& raising = *reinterpret_cast<Raising*>(const_cast<CodelContext*>(self));
    raising.exception = exception;
    raising.size = detail != nullptr ? std::min(size, raising.detail.size()) : 0;
    if (raising.size > 0) std::memcpy(raising.detail.data(), detail, raising.size);
    return exception;
  };
  raising_.context.raised = [](Event* exception, const CodelContext* self) {
    const auto& raising = *reinterpret_cast<const Raising*>(self);
    if (exception != nullptr) *exception = raising.exception;
    return raising.size > 0 ? static_cast<const void*>(raising.detail.data()) : nullptr;
  };
}

bool CodelRunner::Enter(std::size_t unit) noexcept {
  if (!is_inside_) {
    is_inside_ = true;
    is_excluding_ = engine_.Excludes(unit);
    if (is_excluding_) engine_.exclusion().Want(place_, unit);
  }
  if (!is_excluding_) return true;
  if (engine_.exclusion().May(place_)) return true;
  if (!engine_.IsWorthSleeping(unit)) return false;
  const SteadyClock clock;
  const Time now = clock.Now();
  const Duration patience = engine_.options().patience;
  const Time deadline = patience < Time::max() - now ? now + patience : Time::max();
  while (!engine_.exclusion().May(place_)) {
    if (clock.Now() >= deadline) return false;
    engine_.exclusion().Wait(place_, deadline);
  }
  return true;
}

bool CodelRunner::Run(std::size_t codel, Request* request, Event& event) {
  const CodelTable& table = engine_.component().codels[codel];
  const AsyncWork::State async = work_.state_.load(std::memory_order_acquire);
  if (async == AsyncWork::State::kGiven) return false;
  if (async == AsyncWork::State::kNone) {
    if (!Enter(codel)) return false;
    raising_.exception = nullptr;
    raising_.size = 0;
    raising_.context.request = request;
    void* const data = request != nullptr ? request->data() : nullptr;
    const Invocation invocation{engine_.options().ids, data, &raising_.context};
    if (!table.is_async || engine_.options().run_async == nullptr) {
      const Leaving leaving(*this);
      event = table.call(invocation);
      return true;
    }
    work_.engine_ = &engine_;
    work_.codel_ = &table;
    work_.invocation_ = invocation;
    work_.state_.store(AsyncWork::State::kGiven, std::memory_order_relaxed);  // handed over by run_async
    engine_.options().run_async(engine_.options().glue, place_, work_);
    if (work_.state_.load(std::memory_order_acquire) == AsyncWork::State::kGiven) return false;
  }
  const Leaving leaving(*this);
  event = work_.event_;
  work_.state_.store(AsyncWork::State::kNone, std::memory_order_relaxed);
  return true;
}

bool CodelRunner::Assign(const ServiceTable& attribute, void* data) {
  if (attribute.assign == nullptr) return true;
  if (!Enter(engine_.component().AttributeUnit(attribute.number))) return false;
  const Leaving leaving(*this);
  attribute.assign(engine_.options().ids, data);
  return true;
}

bool CodelRunner::TakeException(Event event, std::span<const Event> throws, Outcome& outcome) const noexcept {
  if (std::ranges::find(throws, event) == throws.end()) return false;
  if (event == raising_.exception) {
    outcome.Fail(event, raising_.detail.data(), raising_.size);
  } else {
    outcome.Fail(event);
  }
  return true;
}

}  // namespace runnel::genom_execution
