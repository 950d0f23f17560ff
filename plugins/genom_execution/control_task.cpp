#include <algorithm>

#include "plugins/genom_execution/engine.h"

namespace runnel::genom_execution {

using Phase = ActivitySlot::Phase;

namespace {
bool Contains(std::span<const std::uint16_t> numbers, std::uint16_t number) {
  return std::ranges::find(numbers, number) != numbers.end();
}
}  // namespace

ControlTask::ControlTask(Engine& engine)
    : engine_(engine),
      queue_(engine.options().requests),
      runner_(engine, 0, engine.component().largest_detail),
      has_succeeded_(engine.component().services.size()) {
  pending_.reserve(engine.component().tasks.size() * engine.options().activities);
}

template <typename Use>
void ControlTask::ForEachActivity(Use use) {
  for (ExecutionTask& task : engine_.tasks()) {
    const std::size_t used = task.used();
    for (std::size_t i = 1; i < used; ++i) use(task.slots()[i]);
  }
}

bool ControlTask::Send(Request& request) noexcept {
  request.id_.store(0, std::memory_order_relaxed);
  request.doing_.store("", std::memory_order_relaxed);
  request.Set(Request::State::kSent);
  if (queue_.TryPush(&request)) return true;
  request.state_.store(Request::State::kIdle, std::memory_order_relaxed);
  return false;
}

Pass ControlTask::Run() {
  bool has_done = Reap();
  for (;;) {
    if (request_ == nullptr) {
      has_done |= StartPending();
      Request* next = nullptr;
      if (!queue_.TryPop(next)) break;
      has_done = true;
      Begin(*next);
    }
    if (request_ != nullptr && !GoOn()) {
      if (has_done) engine_.Note();
      return Pass::kWaiting;
    }
  }
  if (has_done) engine_.Note();
  return Pass::kIdle;
}

// Answers those whose activities have ended.
bool ControlTask::Reap() {
  bool has_done = false;
  ForEachActivity([&](ActivitySlot& slot) {
    if (slot.phase.load(std::memory_order_acquire) != Phase::kEnded) return;
    Request& request = *slot.request;
    Free(slot);
    Finish(request);
    has_done = true;
  });
  return has_done;
}

void ControlTask::Finish(Request& request) {
  const ServiceTable& service = request.service();
  const bool is_own = service.kind <= ServiceKind::kActivity;
  if (is_own && request.outcome().is_success()) has_succeeded_[service.number] = true;
  request.doing_.store("", std::memory_order_relaxed);
  request.Set(Request::State::kDone);
}

void ControlTask::Free(ActivitySlot& slot) {
  slot.request = nullptr;
  slot.stopped_by.store(nullptr, std::memory_order_relaxed);
  slot.phase.store(Phase::kFree, std::memory_order_release);
}

bool ControlTask::IsAllowed(const ServiceTable& service) const {
  const auto has_succeeded = [&](std::uint16_t other) -> bool { return has_succeeded_[other]; };
  return std::ranges::all_of(service.after, has_succeeded) && std::ranges::none_of(service.before, has_succeeded);
}

ActivitySlot* ControlTask::FindFree(const ServiceTable& service) {
  ExecutionTask& task = engine_.tasks()[service.task];
  for (std::size_t i = 1; i < task.slots().size(); ++i) {
    ActivitySlot& slot = task.slots()[i];
    if (slot.phase.load(std::memory_order_relaxed) != Phase::kFree) continue;
    slot.machine = &service.machine;
    slot.throws = service.throws;
    slot.stopped_by.store(nullptr, std::memory_order_relaxed);
    slot.phase.store(Phase::kPending, std::memory_order_relaxed);
    if (i >= task.used()) task.set_used(i + 1);
    return &slot;
  }
  return nullptr;
}

void ControlTask::Begin(Request& request) {
  const ServiceTable& service = request.service();
  request.outcome_.Succeed();
  if (engine_.is_stopping()) {
    request.outcome_.Fail(kInterrupted, "kill");
    return Finish(request);
  }
  if (service.kind == ServiceKind::kAbort) return Abort(request);
  if (service.kind == ServiceKind::kKill) {
    engine_.Stop();
    return Finish(request);
  }
  slot_ = nullptr;
  if (service.kind == ServiceKind::kActivity) {
    slot_ = FindFree(service);
    if (slot_ == nullptr) {
      request.outcome_.Fail(kTooManyActivities);
      return Finish(request);
    }
    slot_->request = &request;
    request.id_.store(next_id_++, std::memory_order_relaxed);
  }
  if (service.begin != nullptr) service.begin(request.data());
  request_ = &request;
  step_ = Step::kValidate;
  position_ = 0;
  if (!IsAllowed(service)) request.outcome_.Fail(kDisallowed);
}

bool ControlTask::GoOn() {
  Request& request = *request_;
  const ServiceTable& service = request.service();
  if (step_ == Step::kValidate) {
    if (!RunCodels(service.validates)) return false;
    step_ = Step::kAssign;
    position_ = 0;
  }
  if (step_ == Step::kAssign) {
    if (request.outcome().is_success() && !runner_.Assign(service, request.data())) return false;
    step_ = Step::kCodels;
  }
  if (!RunCodels(service.codels)) return false;
  request_ = nullptr;
  if (!request.outcome().is_success()) {
    if (slot_ != nullptr) Free(*slot_);
    Finish(request);
    return true;
  }
  InterruptAll(service);
  if (slot_ == nullptr) {
    Finish(request);
  } else {
    pending_.push_back(slot_);
    request.Set(Request::State::kAccepted);
  }
  return true;
}

// In order, until one raises an exception.
bool ControlTask::RunCodels(std::span<const std::uint16_t> codels) {
  Request& request = *request_;
  while (request.outcome().is_success() && position_ < codels.size()) {
    Event event = nullptr;
    if (!runner_.Run(codels[position_], &request, event)) return false;
    ++position_;
    if (event == nullptr) continue;
    if (!runner_.TakeException(event, request.service().throws, request.outcome_)) {
      request.outcome_.Fail(kUnknownException, event);
    }
  }
  return true;
}

void ControlTask::InterruptAll(const ServiceTable& service) {
  ForEachActivity([&](ActivitySlot& slot) {
    const Phase phase = slot.phase.load(std::memory_order_acquire);
    if (phase == Phase::kFree || &slot == slot_) return;
    if (Contains(service.interrupts, slot.request->service().number)) Interrupt(slot, service.name);
  });
}

void ControlTask::Interrupt(ActivitySlot& slot, const char* by) {
  const Phase phase = slot.phase.load(std::memory_order_acquire);
  if (phase == Phase::kPending) {
    Request& request = *slot.request;
    std::erase(pending_, &slot);
    request.outcome_.Fail(kInterrupted, by);
    Free(slot);
    return Finish(request);
  }
  if (slot.stopped_by.load(std::memory_order_relaxed) != nullptr) return;
  // release: pairs with the acquire in ExecutionTask::Begin().
  slot.stopped_by.store(by, std::memory_order_release);
}

void ControlTask::Abort(Request& request) {
  ActivitySlot* found = nullptr;
  ForEachActivity([&](ActivitySlot& slot) {
    const Phase phase = slot.phase.load(std::memory_order_acquire);
    if (phase != Phase::kFree && phase != Phase::kEnded && slot.request->id() == request.abort_id) found = &slot;
  });
  if (found == nullptr) {
    request.outcome_.Fail(kNoSuchActivity);
  } else {
    Interrupt(*found, request.service().name);
  }
  Finish(request);
}

// Those whose interrupted activities have all ended.
bool ControlTask::StartPending() {
  bool has_done = false;
  for (std::size_t i = 0; i < pending_.size();) {
    ActivitySlot& slot = *pending_[i];
    if (!MayStart(slot)) {
      ++i;
      continue;
    }
    pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(i));
    slot.phase.store(Phase::kStarting, std::memory_order_release);
    has_done = true;
  }
  return has_done;
}

bool ControlTask::MayStart(const ActivitySlot& slot) const {
  const ServiceTable& service = slot.request->service();
  bool may = true;
  const_cast<ControlTask*>(this)->ForEachActivity([&](ActivitySlot& other) {
    const Phase phase = other.phase.load(std::memory_order_acquire);
    if (&other == &slot || (phase != Phase::kStarting && phase != Phase::kRunning)) return;
    // Not for one that has come since, and was not told to end.
    if (other.stopped_by.load(std::memory_order_relaxed) == nullptr) return;
    if (Contains(service.interrupts, other.request->service().number)) may = false;
  });
  return may;
}

bool ControlTask::ShutDown() {
  (void)Reap();
  for (Request* next = nullptr; request_ == nullptr && queue_.TryPop(next);) Begin(*next);
  if (request_ != nullptr && !GoOn()) return false;
  bool is_any_left = false;
  ForEachActivity([&](ActivitySlot& slot) {
    if (slot.phase.load(std::memory_order_acquire) == Phase::kFree) return;
    Interrupt(slot, "kill");
    is_any_left |= slot.phase.load(std::memory_order_relaxed) != Phase::kFree;
  });
  if (is_any_left) return false;
  auto& tasks = engine_.tasks();
  for (;;) {
    if (shut_down_ > 0) {
      const Phase phase = tasks[tasks.size() - shut_down_].slots().front().phase.load(std::memory_order_acquire);
      if (phase == Phase::kStarting || phase == Phase::kRunning) return false;
    }
    if (shut_down_ == tasks.size()) return true;
    ExecutionTask& task = tasks[tasks.size() - ++shut_down_];
    ActivitySlot& permanent = task.slots().front();
    const Phase phase = permanent.phase.load(std::memory_order_acquire);
    // One that never began has nothing to end.
    if (!engine_.HasBegun(task)) {
      permanent.phase.store(Phase::kFree, std::memory_order_relaxed);
    } else if (phase == Phase::kRunning || phase == Phase::kStarting) {
      permanent.stopped_by.store("kill", std::memory_order_release);
    } else if (phase == Phase::kEnded && permanent.machine->stop != kNowhere) {
      permanent.stopped_by.store("kill", std::memory_order_relaxed);
      permanent.phase.store(Phase::kStarting, std::memory_order_release);
    }
    engine_.Wake();
  }
}

}  // namespace runnel::genom_execution
