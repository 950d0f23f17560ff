#include "plugins/genom_execution/execution_task.h"

#include "plugins/genom_execution/engine.h"

namespace runnel::genom_execution {

using Phase = ActivitySlot::Phase;

ExecutionTask::ExecutionTask(Engine& engine, std::size_t number)
    : engine_(engine),
      table_(engine.component().tasks[number]),
      runner_(engine, number + 1, engine.component().largest_detail) {
  for (std::size_t i = 0; i < engine.options().activities + 1; ++i) {
    slots_.emplace_back(i == 0 ? engine.component().largest_detail : 0);
  }
  ActivitySlot& permanent = slots_.front();
  permanent.machine = &table_.machine;
  permanent.throws = table_.throws;
  if (table_.machine.states.empty()) return;
  // One that can only stop has ended until then.
  permanent.phase = table_.machine.start != kNowhere ? Phase::kStarting : Phase::kEnded;
}

bool ExecutionTask::IsTick(Time now, bool is_forced) noexcept {
  if (!is_periodic()) {
    const std::uint64_t events = engine_.events();
    const bool has_happened = events != seen_ || is_forced;
    seen_ = events;
    return has_happened;
  }
  if (is_forced) return true;
  // No tick lies farther ahead, unless the clock has been set back.
  if (!has_begun_ || next_tick_ - now > table_.period) {
    has_begun_ = true;
    next_tick_ = now + table_.delay;
  }
  if (now < next_tick_) return false;
  // Ticks that nobody has run are gone.
  next_tick_ += table_.period * ((now - next_tick_) / table_.period + 1);
  return true;
}

Pass ExecutionTask::Run(Time now, bool is_forced) {
  if (!is_suspended_) {
    const bool is_tick = IsTick(now, is_forced);
    const bool may_begin = is_tick || !is_periodic();
    if (!goes_on_ && !may_begin) return Pass::kIdle;
    if (is_tick) {
      cycles_.store(cycles_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      if (engine_.clock() != nullptr)
        measured_.store(measured_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    }
    if (!Begin(is_tick)) {
      goes_on_ = false;
      if (is_first_ && may_begin) has_passed_.store(true, std::memory_order_release);
      return Pass::kIdle;
    }
    position_ = 0;
  }
  const Clock* const clock = engine_.clock();
  const Time before = clock != nullptr ? clock->Now() : Time();
  is_suspended_ = true;  // also if a codel throws
  const bool is_over = RunCodels();
  if (clock != nullptr) {
    const std::int64_t took = (clock->Now() - before).count();
    last_.store(took, std::memory_order_relaxed);
    if (took > longest_.load(std::memory_order_relaxed)) longest_.store(took, std::memory_order_relaxed);
    total_.store(total_.load(std::memory_order_relaxed) + took, std::memory_order_relaxed);
  }
  if (!is_over) return Pass::kWaiting;
  is_suspended_ = false;
  // release: the ids are as the `start` codel has left them.
  if (is_first_) has_passed_.store(true, std::memory_order_release);
  is_first_ = false;
  return goes_on_ ? Pass::kAgain : Pass::kIdle;
}

// What others have asked for since the last pass. Whether there is anything to run.
bool ExecutionTask::Begin(bool is_tick) noexcept {
  const bool looks = is_tick || !is_periodic();
  bool is_any_ready = false;
  const std::size_t used = this->used();
  for (std::size_t i = 0; i < used; ++i) {
    ActivitySlot& slot = slots_[i];
    const Phase phase = slot.phase.load(std::memory_order_acquire);
    if (looks && (phase == Phase::kStarting || phase == Phase::kRunning)) {
      const char* const by = slot.stopped_by.load(std::memory_order_acquire);
      if (phase == Phase::kStarting) {
        slot.is_stopping = false;
        slot.phase.store(Phase::kRunning, std::memory_order_relaxed);
        if (by == nullptr) {
          Enter(slot, slot.machine->start);
        } else if (slot.request != nullptr) {
          slot.request->outcome_.Fail(kInterrupted, by);
          End(slot);
        } else {
          Stop(slot, by);
        }
      } else if (by != nullptr && !slot.is_stopping) {
        Stop(slot, by);
      } else if (is_tick) {
        slot.is_paused = false;
      }
    }
    is_any_ready |= slot.phase.load(std::memory_order_relaxed) == Phase::kRunning && !slot.is_paused;
  }
  return is_any_ready;
}

bool ExecutionTask::RunCodels() {
  const std::size_t used = this->used();
  for (; position_ < used; ++position_) {
    ActivitySlot& slot = slots_[position_];
    // acquire: the control task may just be making it.
    if (slot.phase.load(std::memory_order_acquire) != Phase::kRunning || slot.is_paused) continue;
    Event event = nullptr;
    if (!runner_.Run(slot.machine->states[slot.state].codel, slot.request, event)) return false;
    Follow(slot, event);
  }
  goes_on_ = false;
  for (std::size_t i = 0; i < used && !goes_on_; ++i) {
    goes_on_ = slots_[i].phase.load(std::memory_order_acquire) == Phase::kRunning && !slots_[i].is_paused;
  }
  return true;
}

void ExecutionTask::Follow(ActivitySlot& slot, Event event) noexcept {
  Outcome& outcome = slot.request != nullptr ? slot.request->outcome_ : slot.outcome;
  const StateTable& state = slot.machine->states[slot.state];
  for (const Transition& each : state.transitions) {
    if (each.event != event) continue;
    if (each.state == kEther) {
      outcome.Succeed();
      return End(slot);
    }
    Enter(slot, each.state);
    slot.is_paused = each.pauses;
    if (!each.pauses) engine_.Note();
    return;
  }
  if (!runner_.TakeException(event, slot.throws, outcome)) {
    if (event == kMiddlewareError) {
      outcome.Fail(event, "a codel has thrown");
    } else {
      outcome.Fail(kBadTransition, state.name, event != nullptr ? event : "ok");
    }
  }
  End(slot);
}

void ExecutionTask::Stop(ActivitySlot& slot, const char* by) noexcept {
  slot.is_stopping = true;
  if (slot.machine->stop != kNowhere) return Enter(slot, slot.machine->stop);
  (slot.request != nullptr ? slot.request->outcome_ : slot.outcome).Fail(kInterrupted, by);
  End(slot);
}

void ExecutionTask::Enter(ActivitySlot& slot, std::uint16_t state) noexcept {
  slot.state = state;
  slot.is_paused = false;
  if (slot.request != nullptr) slot.request->doing_.store(slot.machine->states[state].name, std::memory_order_relaxed);
}

void ExecutionTask::End(ActivitySlot& slot) noexcept {
  // A permanent activity that fails is told of; one that is told to end and cannot say how just ends.
  const Event exception = slot.outcome.exception();
  if (slot.request == nullptr && exception != nullptr && exception != kInterrupted) engine_.NoteFailure(slot.outcome);
  slot.phase.store(Phase::kEnded, std::memory_order_release);
  engine_.Note();
}

TaskFigures ExecutionTask::figures() const noexcept {
  return {cycles_.load(std::memory_order_relaxed), measured_.load(std::memory_order_relaxed),
          Duration(last_.load(std::memory_order_relaxed)), Duration(longest_.load(std::memory_order_relaxed)),
          Duration(total_.load(std::memory_order_relaxed))};
}

}  // namespace runnel::genom_execution
