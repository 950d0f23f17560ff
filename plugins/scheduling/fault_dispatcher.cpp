#include "plugins/scheduling/fault_dispatcher.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <new>

#include "core/base/error.h"
#include "core/base/retry.h"
#include "core/element/element_path.h"

namespace runnel {

namespace {

constexpr const char* kRuleFailed = "the fault rule failed: ";
constexpr const char* kHandlerFailed = "the fault handler failed: ";

}  // namespace

FaultRecord::FaultRecord(std::string path) {
  fault_.path = std::move(path);
  fault_.message.reserve(kLongestFaultMessage);
}

void FaultRecord::Fill(std::string_view message, Time time, std::uint64_t cycle) noexcept {
  fault_.message.assign(message.substr(0, kLongestFaultMessage));
  fault_.time = time;
  fault_.cycle = cycle;
}

void FaultRecord::NoteDue() noexcept {
  if (due_since_ == Time{}) due_since_ = SteadyClock().Now();
}

bool FaultRecord::IsOverdue() noexcept {
  NoteDue();
  if (SteadyClock().Now() - due_since_ <= std::chrono::seconds(1)) return false;
  due_since_ = {};
  return true;
}

FaultDispatcher::~FaultDispatcher() {
  SetActsBeside(false);  // whose threads raise again what they have no memory for
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
  while (raised_.load(std::memory_order_relaxed) != nullptr || unanswered_.load(std::memory_order_relaxed) != nullptr) {
    // acq_rel: what the thread before has done is seen; and what who has come meanwhile, and gone, has raised.
    if (is_dispatching_.exchange(true, std::memory_order_acq_rel)) return true;
    const bool are_all = DispatchAlone();
    (void)is_dispatching_.exchange(false, std::memory_order_acq_rel);
    if (!are_all) return false;
  }
  return true;
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
    FaultRecord* const next = oldest->next_;
    try {
      if (Answer(*oldest)) delete oldest;
    } catch (...) {  // what is not answered now is answered the next time, in order
      for (FaultRecord* each = oldest; each != nullptr; each = each->next_) {
        if (each->fault_.kind == Fault::Kind::kThrown && !each->is_for_rules_) each->NoteDue();
        EndIfRuled(*each);
      }
      unanswered_.store(oldest, std::memory_order_relaxed);
      return false;
    }
    oldest = next;
  }
  return true;
}

// The end of the run waits for no memory, but for a handler that may mend the fault.
void FaultDispatcher::EndIfRuled(const FaultRecord& record) noexcept {
  const std::lock_guard lock(mutex_);
  const bool is_thrown = record.fault_.kind == Fault::Kind::kThrown;
  if (is_thrown && handler_ && !record.is_for_rules_) return;
  const auto ends = [&](const FaultRule& rule) {
    return (!rule.call || rule.ends_run) && IsAtOrBelow(record.fault_.path, rule.of);
  };
  if (record.ends_run_ || (is_thrown && std::ranges::any_of(rules_, ends))) EndForFault();
}

// Whether it has been; else a thread has the record. What has its own answer is told first, for that may take a while.
bool FaultDispatcher::Answer(FaultRecord& record) {
  const Fault& fault = record.fault_;
  if (fault.kind != Fault::Kind::kThrown) {
    if (!record.is_logged_) Log(fault), record.is_logged_ = true;
    const bool has_failed = record.call_ && !Try(record, fault.path, kRuleFailed, [&] { record.call_(fault); });
    if (has_failed && record.ends_run_) EndForFault();
    return true;
  }
  if (record.is_for_rules_) return ApplyRules(record), true;
  Action action;
  std::unique_lock lock(mutex_);
  const Handler handler = handler_;
  lock.unlock();
  if (handler) Try(record, fault.path, kHandlerFailed, [&] { action = handler(fault); });
  if (!action) return ApplyRules(record), true;
  lock.lock();
  if (!beside_) {
    lock.unlock();
    return Act(record, action), true;
  }
  const auto before = std::make_shared<std::jthread>(std::move(*beside_));
  try {
    *beside_ = std::jthread([=, this, &record] {
      try {
        Act(record, action);
        delete &record;
      } catch (...) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EndIfRuled(record);
        Raise(std::unique_ptr<FaultRecord>(&record));
      }
      *before = {};  // waits for it
    });
  } catch (...) {  // no thread can be had; whoever waits for the one before does so without the lock
    *beside_ = std::move(*before);
    if (!record.IsOverdue()) throw;
    lock.unlock();
    return ApplyRules(record), true;
  }
  return false;
}

void FaultDispatcher::Report(Fault fault) {
  Raise(std::make_unique<FaultRecord>(std::move(fault), nullptr));
  (void)Dispatch();
}

void FaultDispatcher::SetActsBeside(bool acts_beside) {
  std::optional<std::jthread> ended;
  const std::lock_guard lock(mutex_);
  ended.swap(beside_);
  if (acts_beside) beside_.emplace();
}

void FaultDispatcher::Act(FaultRecord& record, const Action& action) {
  const Fault& fault = record.fault_;
  if (!std::exchange(record.is_acted_on_, true)) record.due_since_ = {};
  std::string done;
  if (!Try(record, fault.path, kHandlerFailed, [&] { done = action(); })) return ApplyRules(record);
  Retry([&] { Log({fault.path, fault.message + "; " + done, fault.time, fault.cycle, true}); });
}

void FaultDispatcher::ApplyRules(FaultRecord& record) {
  const Fault& fault = record.fault_;
  if (!std::exchange(record.is_for_rules_, true)) record.due_since_ = {};
  if (!record.is_logged_) Log(fault), record.is_logged_ = true;
  for (;; ++record.rule_, record.due_since_ = {}) {
    FaultRule rule;
    {
      const std::lock_guard lock(mutex_);
      if (record.rule_ >= rules_.size()) return;
      rule = rules_[record.rule_];
    }
    if (!IsAtOrBelow(fault.path, rule.of)) continue;
    const bool is_done = rule.call && Try(record, rule.of, kRuleFailed, [&] { rule.call(fault); });
    if (!rule.call || (!is_done && rule.ends_run)) EndForFault();
  }
}

void FaultDispatcher::SetHandler(Handler handler) {
  const std::lock_guard lock(mutex_);
  handler_ = std::move(handler);
}

// What has no memory has done nothing yet, and is asked again, but not without end.
template <typename Call>
bool FaultDispatcher::Try(FaultRecord& record, const std::string& of, const char* failed, const Call& call) {
  std::exception_ptr failure;
  try {
    call();
    return true;
  } catch (const std::bad_alloc&) {
    if (!record.IsOverdue()) throw;
    failure = std::current_exception();
  } catch (...) {
    failure = std::current_exception();
  }
  try {
    Log({of, failed + DescribeException(failure), record.fault_.time});
  } catch (...) {
  }
  return false;
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

void FaultDispatcher::Take(std::vector<Fault>& to) {
  const std::lock_guard lock(mutex_);
  to.insert(to.end(), std::make_move_iterator(log_.begin()), std::make_move_iterator(log_.end()));
  log_.clear();
}

}  // namespace runnel
