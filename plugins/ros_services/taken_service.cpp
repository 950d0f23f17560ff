#include "plugins/ros_services/taken_service.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/base/characters.h"
#include "core/base/erase_where.h"
#include "core/base/error.h"
#include "core/lockfree/thread_epoch.h"
#include "core/lockfree/wake_event.h"
#include "core/port/cycle.h"

namespace runnel {

namespace {

/// So that it lives as long as the output that publishes its address.
struct HeldService final : Annotation {
  explicit HeldService(std::shared_ptr<DistantService> of) : service(std::move(of)) {}
  const std::shared_ptr<DistantService> service;
};

}  // namespace

void DistantService::PublishBy(Port& output, const std::shared_ptr<DistantService>& service) {
  // The links of all signatures are alike.
  static_assert(sizeof(ServiceLink<void()>) == sizeof(ServiceEndpoint*));
  const OwnCycle cycle(output.runtime().clock().Now());
  (void)output.PublishFilled([&](void* link) -> Result<void> {
    *static_cast<ServiceEndpoint**>(link) = &service->endpoint;
    return {};
  });
  output.Annotate(std::make_unique<HeldService>(service));
}

/// Rung by clients that have put a call into the queue.
class TakenService::Ring final : public Waker {
 public:
  explicit Ring(std::shared_ptr<WakeEvent> wake) : wake_(std::move(wake)) {}
  void Wake() noexcept override { wake_->Notify(); }

 private:
  const std::shared_ptr<WakeEvent> wake_;
};

TakenService::TakenService(Runtime& runtime, std::string path, ServiceTakeOptions options,
                           std::shared_ptr<DistantService> service, ServiceDialect dialect, std::uint32_t identity,
                           std::shared_ptr<WakeEvent> wake)
    : runtime_(runtime),
      path_(std::move(path)),
      options_(std::move(options)),
      service_(std::move(service)),
      dialect_(dialect),
      identity_(identity),
      wake_(std::move(wake)),
      ring_(std::make_shared<Ring>(wake_)) {
  const std::lock_guard lock(runtime_.structure_mutex());
  service_->endpoint.SetWaker(ring_.get());
}

TakenService::~TakenService() {
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    service_->endpoint.SetWaker(nullptr);
  }
  // Clients that have found it may still be about to ring.
  Retire([ring = ring_] {});
  for (const Pending& each : pending_) End(*each.call, CallStatus::kDisconnected, "the network has gone");
}

Result<void> TakenService::Follow(WireParticipant& participant) {
  if (endpoints_ != nullptr) return {};
  const ServiceForm& form = *service_->form;
  auto begun = ServiceEndpoints::Start(ServiceEndpoints::Side::kClient,
                                       {.service = options_.service,
                                        .request = form.request_type(),
                                        .response = form.response_type(),
                                        .dialect = dialect_},
                                       participant, identity_, [wake = wake_] { wake->Notify(); });
  if (!begun) return begun.error();
  const std::lock_guard lock(runtime_.structure_mutex());  // by which others look at them (Text())
  endpoints_ = std::move(*begun);
  return {};
}

bool TakenService::Work() {
  if (endpoints_ == nullptr) return false;
  TakeCalls();
  TakeReplies();
  const bool is_matched = endpoints_->is_matched();
  const Time now = runtime_.clock().Now();
  EraseWhere(pending_, [&](Pending& each) {
    if (each.call->is_given_up.load(std::memory_order_relaxed) || now >= each.call->deadline) {
      End(*each.call, CallStatus::kTimedOut,
          (is_matched ? "no answer from " : "there is no service ") + options_.service +
              (is_matched ? "" : " in the network"));
      return true;
    }
    if (!is_matched || each.request.empty()) return false;
    if (each.call->IsFromBefore(runtime_.robot_stop())) {
      End(*each.call, CallStatus::kFailed, kCalledBeforeStop);
      return true;
    }
    const auto sent = endpoints_->Request(each.request);
    each.request.clear();
    if (!sent) End(*each.call, CallStatus::kFailed, sent.error().message);
    if (sent) each.number = *sent;
    return !sent;
  });
  return !pending_.empty();
}

void TakenService::TakeCalls() {
  for (CallBase* call = nullptr; service_->endpoint.queue.TryPop(call);) {
    try {
      Pending pending{0, call, {}};
      service_->form->WriteRequest(service_->calls->ArgumentsOf(*call), pending.request);
      pending_.push_back(std::move(pending));
    } catch (...) {
      End(*call, CallStatus::kFailed, DescribeException());
    }
  }
}

void TakenService::TakeReplies() {
  endpoints_->TakeWaiting([this](const ServiceMessage& reply) {
    const auto of = std::ranges::find(pending_, reply.id.number, &Pending::number);
    if (of == pending_.end()) return;  // it came too late
    CallBase& call = *of->call;
    pending_.erase(of);  // first: once it has ended, its client uses it again
    try {
      const auto outcome = service_->form->ReadResponse(reply.message, service_->calls->ReplyOf(call));
      if (!outcome) {
        error_ = outcome.error();
        End(call, CallStatus::kFailed, "the answer cannot be read: " + error_->message);
      } else if (outcome->success) {
        End(call, CallStatus::kAnswered, "");
      } else {
        End(call, CallStatus::kFailed,
            outcome->message.empty() ? options_.service + " says no reason" : Printable(outcome->message));
      }
    } catch (...) {
      End(call, CallStatus::kFailed, DescribeException());
    }
  });
}

void TakenService::End(CallBase& call, CallStatus status, std::string_view why) noexcept {
  if (status != CallStatus::kAnswered) return service_->endpoint.End(call, status, why);
  service_->endpoint.answered.fetch_add(1, std::memory_order_relaxed);
  call.Answer(status);
}

std::string TakenService::Text() const {
  std::string text = "takes the service " + options_.service + " as " + path_ + "  " + service_->form->ros_type();
  text += ", " + std::to_string(service_->endpoint.answered.load()) + " answered, " +
          std::to_string(service_->endpoint.failed.load()) + " failed";
  return text + (endpoints_ != nullptr && endpoints_->is_matched() ? "\n" : ": NOBODY OFFERS IT\n");
}

}  // namespace runnel
