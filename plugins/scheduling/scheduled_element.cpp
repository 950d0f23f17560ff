#include "plugins/scheduling/scheduled_element.h"

#include <mutex>
#include <unordered_set>
#include <utility>

#include "plugins/scheduling/cycle_runner.h"
#include "plugins/timing/latency_chain.h"
#include "plugins/timing/trace_track.h"

namespace runnel {

namespace {

// All that there are, so that whoever has the address of one learns whether it is still there. Never destroyed, as
// elements may be retired until the end of the process.
struct LivingElements {
  std::mutex mutex;
  std::unordered_set<const ScheduledElement*> all;
  static LivingElements& OfProcess() {
    static auto& elements = *new LivingElements;
    return elements;
  }
};

}  // namespace

ScheduledElement::ScheduledElement(std::string path, std::unique_ptr<TracedElement> traced)
    : path_(std::move(path)), traced_(std::move(traced)), record_(std::make_unique<FaultRecord>(path_)) {
  LivingElements& living = LivingElements::OfProcess();
  const std::lock_guard lock(living.mutex);
  living.all.insert(this);
}

ScheduledElement::~ScheduledElement() {
  delete chains();
  LivingElements& living = LivingElements::OfProcess();
  const std::lock_guard lock(living.mutex);
  living.all.erase(this);
}

void ScheduledElement::WithPath(const ScheduledElement* element, const std::function<void(const std::string&)>& use) {
  LivingElements& living = LivingElements::OfProcess();
  const std::lock_guard lock(living.mutex);
  if (living.all.contains(element)) use(element->path());
}

BoundCall ScheduledElement::Watched(const Task& task, TaskWatch& watch) {
  watched_.push_back(watch.Watch(task));
  return BoundCall::To<&WatchedTask::Run>(*watched_.back());
}

void ScheduledElement::Fail(std::string_view message, CycleMoment now, FaultDispatcher& faults) noexcept {
  End();
  if (!record_) return;
  if (traced_ && traced_->track != nullptr) traced_->track->NoteFault(traced_->number, message);
  record_->Fill(message, now.time, now.number);
  faults.Raise(std::move(record_));
}

void ScheduledElement::Wake() noexcept {
  // seq_cst, as in BindTriggers(): either the runner is the new one, or who sets it sees the activation.
  activated_.store(true, std::memory_order_seq_cst);
  // The caller is inside an EpochGuard, and runners are retired: it cannot go away meanwhile.
  if (CycleRunner* const waiting = runner()) waiting->Activate();
}

}  // namespace runnel
