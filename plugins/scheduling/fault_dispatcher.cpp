#include "plugins/scheduling/fault_dispatcher.h"

#include <algorithm>
#include <mutex>
#include <new>

#include "core/base/exception_text.h"
#include "core/base/retry.h"
#include "core/element/element_path.h"

namespace runnel {

FaultRecord::FaultRecord(std::string path) {
  fault_.path = std::move(path);
  fault_.message.reserve(kLongestFaultMessage);
}

void FaultRecord::Fill(std::string_view message, Time time, std::uint64_t cycle) noexcept {
  fault_.message.assign(message.substr(0, kLongestFaultMessage));
  fault_.time = time;
  fault_.cycle = cycle;
}

FaultDispatcher::~FaultDispatcher() {
  for (FaultRecord* record : {raised_.load(std::memory_order_acquire), unanswered_.load(std::memory_order_acquire)}) {
    while (record != nullptr) delete std::exchange(record, record->next_);
  }
}

void FaultDispatcher::Raise(std::unique_ptr<FaultRecord> record) noexcept {
  FaultRecord* const added = record.release();
  FaultRecord* head = raised_.load(std::memory_order_relaxed);
  do {
    added->next_ = head;
    // release: pairs with the acquire in Dispatch(): the record is filled.
  } while (!raised_.compare_exchange_weak(head, added, std::memory_order_release, std::memory_order_relaxed));
  event_.Notify();
}

bool FaultDispatcher::Dispatch() noexcept {
  // relaxed: only whether there is something; simulated time asks in each step.
  if (raised_.load(std::memory_order_relaxed) == nullptr && unanswered_.load(std::memory_order_relaxed) == nullptr)
    return true;
  // acquire, release: what the thread before has done is seen.
  if (is_dispatching_.exchange(true, std::memory_order_acquire)) return true;
  const bool are_all = DispatchAlone();
  is_dispatching_.store(false, std::memory_order_release);
  return are_all;
}

bool FaultDispatcher::DispatchAlone() noexcept {
  // acquire: pairs with the release in Raise().
  FaultRecord* newest = raised_.exchange(nullptr, std::memory_order_acquire);
  FaultRecord* oldest = nullptr;
  while (newest != nullptr) {
    FaultRecord* const before = std::exchange(newest->next_, oldest);
    oldest = std::exchange(newest, before);
  }
  // relaxed: of who dispatches; see Dispatch().
  if (FaultRecord* const first = unanswered_.exchange(nullptr, std::memory_order_relaxed)) {
    FaultRecord* last = first;
    while (last->next_ != nullptr) last = last->next_;
    last->next_ = std::exchange(oldest, first);
  }
  while (oldest != nullptr) {
    try {
      Answer(*oldest);
    } catch (...) {  // what is not answered now is answered the next time, in order
      for (const FaultRecord* each = oldest; each != nullptr; each = each->next_) EndIfRuled(*each);
      unanswered_.store(oldest, std::memory_order_relaxed);
      return false;
    }
    delete std::exchange(oldest, oldest->next_);
  }
  return true;
}

// The end of the run waits for no memory.
void FaultDispatcher::EndIfRuled(const FaultRecord& record) noexcept {
  const std::lock_guard lock(mutex_);
  const bool is_thrown = record.fault_.kind == Fault::Kind::kThrown;
  const auto ends = [&](const FaultRule& rule) {
    return (!rule.call || rule.ends_run) && IsAtOrBelow(record.fault_.path, rule.of);
  };
  if (record.ends_run_ || (is_thrown && std::ranges::any_of(rules_, ends))) EndForFault();
}

// What has its own answer is told first, for that may take a while.
void FaultDispatcher::Answer(const FaultRecord& record) {
  if (record.fault().kind == Fault::Kind::kThrown) return Report(record.fault());
  Log(record.fault());
  if (record.call_) Apply({.of = record.fault().path, .call = record.call_}, record.fault());
}

void FaultDispatcher::Report(const Fault& fault) {
  Action action;
  std::unique_lock lock(mutex_);
  const Handler handler = handler_;
  lock.unlock();
  if (handler) (void)Try(fault, [&] { action = handler(fault); });
  if (!action) return ApplyRules(fault);
  lock.lock();
  if (beside_) {
    const auto before = std::make_shared<std::jthread>(std::move(*beside_));
    try {
      *beside_ = std::jthread([=, this] {
        if (!Retry([&] { Act(fault, action); })) Note(fault);
        *before = {};  // waits for it
      });
    } catch (...) {  // no thread can be had; whoever waits for the one before does so without the lock
      *beside_ = std::move(*before);
      throw;
    }
    return;
  }
  lock.unlock();
  Act(fault, action);
}

void FaultDispatcher::SetActsBeside(bool acts_beside) {
  std::optional<std::jthread> ended;
  const std::lock_guard lock(mutex_);
  ended.swap(beside_);
  if (acts_beside) beside_.emplace();
}

void FaultDispatcher::Act(const Fault& fault, const Action& action) {
  std::string done;
  if (!Try(fault, [&] { done = action(); })) return ApplyRules(fault);
  Retry([&] { Log({fault.path, fault.message + "; " + done, fault.time, fault.cycle, true}); });
}

void FaultDispatcher::ApplyRules(const Fault& fault) {
  std::vector<FaultRule> rules;
  {
    const std::lock_guard lock(mutex_);
    rules = rules_;
    log_.push_back(fault);  // when nothing can fail any more
  }
  for (const FaultRule& rule : rules) {
    if (IsAtOrBelow(fault.path, rule.of)) Apply(rule, fault);
  }
}

void FaultDispatcher::SetHandler(Handler handler) {
  const std::lock_guard lock(mutex_);
  handler_ = std::move(handler);
}

bool FaultDispatcher::Try(const Fault& fault, const std::function<void()>& call) {
  try {
    call();
    return true;
  } catch (const std::bad_alloc&) {
    throw;  // it is asked again
  } catch (...) {
    Log({fault.path, "the fault handler failed: " + DescribeException(), fault.time});
  }
  return false;
}

void FaultDispatcher::Apply(const FaultRule& rule, const Fault& fault) {
  // A rule for which there is no memory has done nothing yet.
  const auto call = [&] {
    try {
      rule.call ? rule.call(fault) : EndForFault();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (...) {
      Note({rule.of, "the fault rule failed: " + DescribeException(), fault.time});
    }
  };
  if (!Retry(call)) Note({rule.of, "the fault rule failed: out of memory", fault.time});
}

void FaultDispatcher::AddRule(FaultRule rule) {
  const std::lock_guard lock(mutex_);
  rules_.push_back(std::move(rule));
}

void FaultDispatcher::MovePaths(const std::function<void(std::string& path)>& move) {
  const std::lock_guard lock(mutex_);
  for (FaultRule& rule : rules_) move(rule.of);
}

void FaultDispatcher::Log(Fault fault) {
  const std::lock_guard lock(mutex_);
  log_.push_back(std::move(fault));
}

void FaultDispatcher::Note(Fault fault) noexcept {
  try {
    Log(std::move(fault));
  } catch (...) {
  }
}

std::vector<Fault> FaultDispatcher::Take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(log_, {});
}

}  // namespace runnel
