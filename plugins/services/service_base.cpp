#include "plugins/services/service_base.h"

#include <utility>

#include "core/base/error.h"
#include "core/element/file_notes.h"
#include "core/element/own_thread.h"
#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/cycle.h"

namespace runnel {

ServiceWorker::ServiceWorker(const Placement& placement, std::function<void(CallBase&, Activity&)> serve,
                             std::function<void()> tell_free)
    : FrameworkElement(placement), serve_(std::move(serve)), tell_free_(std::move(tell_free)) {
  Annotate(std::make_unique<NotSaved>());
  Annotate(std::make_unique<OwnThread>([this] { return !is_free(); }, [this] { AskToEnd(); }));
}

ServiceWorker::~ServiceWorker() {
  Stop();
  if (known_by_ != nullptr) *known_by_ = nullptr;
}

Result<void> ServiceWorker::Prepare() {
  if (!thread_.joinable()) thread_ = std::thread([this] { Work(); });
  return {};
}

void ServiceWorker::Begin(CallBase& call) noexcept {
  activity_.Begin(call);
  // release: pairs with the acquire in Work().
  current_.store(&call, std::memory_order_release);
  event_.Notify();
}

void ServiceWorker::Work() noexcept {
  for (;;) {
    event_.Wait();
    // acquire: pairs with the release in Begin().
    if (CallBase* const call = current_.load(std::memory_order_acquire)) {
      serve_(*call, activity_);
      current_.store(nullptr, std::memory_order_release);
      tell_free_();
    }
    if (is_stopping_.load(std::memory_order_acquire)) return;
  }
}

void ServiceWorker::AskToEnd() noexcept {
  activity_.Abort();
  is_stopping_.store(true, std::memory_order_release);
  event_.Notify();
}

void ServiceWorker::Stop() noexcept {
  if (!thread_.joinable()) return;
  AskToEnd();
  thread_.join();
}

void ServiceBase::Open(Port& port, bool is_activity) {
  port_ = &port;
  work_ = CycleWork::Add(port, *this);
  if (!is_activity) return;
  FrameworkElement& owner = work_ != nullptr ? work_->module() : *port.parent();
  auto worker = std::make_unique<ServiceWorker>(
      Placement{owner, port.name() + "_worker"},
      [this](CallBase& call, Activity& activity) { AnswerByWorker(call, activity); },
      [this] {
        const EpochGuard guard;
        ServiceEndpoint* const at = endpoint();
        if (at != nullptr && at->queue.size() > 0) at->Wake();
      });
  worker_ = worker.get();
  worker_->set_known_by(&worker_);
  if (work_ == nullptr) {
    own_worker_ = std::move(worker);
  } else {
    // What a module owns is destroyed before its members are.
    port.runtime().Adopt(std::move(worker));
  }
}

void ServiceBase::Leave() noexcept {
  if (work_ != nullptr) work_->Remove(*this);
  if (worker_ == nullptr) return;
  worker_->Stop();
  worker_->set_known_by(nullptr);
}

void ServiceBase::Close() noexcept {
  Leave();
  // Nobody looks at it any more: who has found it before has left its cycle (Runtime::Delete()).
  if (const std::unique_ptr<ServiceEndpoint> own{endpoint()})
    own->EndAll(CallStatus::kDisconnected, "the service has been deleted");
  RetireCalls(nullptr);
}

void ServiceBase::BeforeUpdate() {
  ServiceEndpoint* const at = endpoint();
  if (at->is_faulted.load(std::memory_order_relaxed)) at->is_faulted.store(false, std::memory_order_relaxed);
  Runtime& runtime = port_->runtime();
  const Cycle* const cycle = CurrentCycle();
  // What is called meanwhile has its turn in the next cycle.
  for (std::size_t left = at->queue.size(); left > 0; --left) {
    if (worker_ != nullptr && !worker_->is_free()) return;
    const Time now = cycle != nullptr ? cycle->now : runtime.clock().Now();
    CallBase* const call = at->Take(now, runtime.robot_stop());
    if (call == nullptr) return;
    call->begun_at = now;
    if (worker_ != nullptr) {
      worker_->Begin(*call);
    } else {
      Answer(*at, *call);
    }
  }
}

void ServiceBase::SetWaker(Waker* waker) {
  if (ServiceEndpoint* const at = endpoint()) at->SetWaker(waker);
}

void ServiceBase::Answer(ServiceEndpoint& at, CallBase& call) {
  try {
    const CallStatus status = Invoke(call, nullptr);
    auto& count = status == CallStatus::kAnswered ? at.answered : at.failed;
    count.fetch_add(1, std::memory_order_relaxed);
    call.Answer(status);
  } catch (...) {
    at.End(call, CallStatus::kFaulted, DescribeException());
    throw;  // the module's fault, as if Update() had thrown
  }
}

void ServiceBase::AnswerByWorker(CallBase& call, Activity& activity) noexcept {
  CallStatus status = CallStatus::kFailed;
  try {
    status = Invoke(call, &activity);
  } catch (...) {
    call.error = DescribeException();
  }
  if (status == CallStatus::kFailed && activity.is_abort_asked()) status = CallStatus::kAborted;
  {
    const EpochGuard guard;
    if (ServiceEndpoint* const at = endpoint()) {
      auto& count = status == CallStatus::kAnswered ? at->answered : at->failed;
      count.fetch_add(1, std::memory_order_relaxed);
    }
  }
  call.Answer(status);
}

void ServiceBase::AfterFault(std::string_view what) noexcept {
  ServiceEndpoint* const at = endpoint();
  // relaxed: who does not see it yet waits until its time-out.
  at->is_faulted.store(true, std::memory_order_relaxed);
  at->EndAll(CallStatus::kFaulted, what);
}

ServiceState ServiceBase::state() const {
  ServiceState state;
  if (const ServiceEndpoint* const at = endpoint()) {
    state.waiting = at->queue.size();
    state.answered = at->answered.load(std::memory_order_relaxed);
    state.failed = at->failed.load(std::memory_order_relaxed);
  }
  if (worker_ != nullptr && !worker_->is_free()) {
    const Activity& activity = worker_->activity();
    state.running.push_back({activity.number(), activity.progress(), activity.doing(), activity.has_abort()});
  }
  return state;
}

bool ServiceBase::Abort() {
  if (worker_ == nullptr || worker_->is_free()) return false;
  worker_->Abort();
  return true;
}

}  // namespace runnel
