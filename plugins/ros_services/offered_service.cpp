#include "plugins/ros_services/offered_service.h"

#include <mutex>
#include <utility>

#include "core/base/erase_where.h"
#include "core/lockfree/wake_event.h"
#include "core/paths/path_search.h"
#include "plugins/ros_messages/message_library.h"

namespace runnel {

namespace {

// Longer than anybody waits: callers give up by themselves, and go.
constexpr Duration kForEver = std::chrono::hours(24 * 365);

}  // namespace

OfferedService::OfferedService(Runtime& runtime, ServiceOfferOptions options, const MessageLibrary& library,
                               ServiceDialect dialect, std::uint32_t identity, std::shared_ptr<WakeEvent> wake,
                               const DiscoveryTable* table, std::function<const std::string&()> path)
    : runtime_(runtime),
      options_(std::move(options)),
      library_(library),
      dialect_(dialect),
      identity_(identity),
      wake_(std::move(wake)),
      table_(table),
      path_(std::move(path)) {
  pending_.reserve(kMostCalls);
}

Result<Callable*> OfferedService::Find() {
  if (callable_ != nullptr) return callable_;
  if (path_) options_.port = path_();
  const auto port = PathSearch(runtime_).FindPort(options_.port, PathKind::kOutput);
  if (!port) return port.error();
  auto* const callable = (*port)->FindAnnotation<Callable>();
  if (callable == nullptr || (*port)->life_cycle() == LifeCycle::kDeleted) {
    return Error{.message = "is no service", .path = options_.port};
  }
  auto form = ServiceForm::Make(callable->arguments(), callable->reply(), options_.as, library_);
  if (!form) return form.error();
  port_ = *port;
  form_ = std::move(*form);
  return callable_ = callable;
}

void OfferedService::Forget(const FrameworkElement& element) noexcept {
  if (port_ == nullptr || !port_->IsAtOrBelow(element)) return;
  port_ = nullptr;
  callable_ = nullptr;  // whose types go with it
  form_ = nullptr;
}

Result<void> OfferedService::Follow(WireParticipant& participant, const std::function<bool(std::uint64_t)>& is_there) {
  EraseWhere(pending_, [&](const Pending& each) { return !is_there(each.id.writer); });
  ServiceTopics topics{.service = options_.service, .dialect = dialect_, .table = table_};
  Result<void> found;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    if (const auto callable = Find(); !callable) {
      found = callable.error();
    } else {
      topics.request = form_->request_type();
      topics.response = form_->response_type();
    }
  }
  if (!found || (endpoints_ != nullptr && endpoints_->topics() != topics)) {
    pending_.clear();
    SetEndpoints(nullptr);
  }
  if (!found || endpoints_ != nullptr) return found;
  auto begun = ServiceEndpoints::Start(ServiceEndpoints::Side::kServer, topics, participant, identity_,
                                       [wake = wake_] { wake->Notify(); });
  if (!begun) return begun.error();
  SetEndpoints(std::move(*begun));
  return {};
}

// Who has the lock may be looking at those of before (Text()), which go after it.
void OfferedService::SetEndpoints(std::unique_ptr<ServiceEndpoints> next) {
  const std::lock_guard lock(runtime_.structure_mutex());
  endpoints_.swap(next);
}

Result<std::unique_ptr<AnyCall>> OfferedService::Begin(const ServiceMessage& request) {
  const auto callable = Find();
  if (!callable) return callable.error();
  const ServiceTopics& topics = endpoints_->topics();
  if (form_->request_type() != topics.request || form_->response_type() != topics.response)
    return Error{.message = "it is about to be another service"};
  if (pending_.size() >= kMostCalls) return Error{.message = "too many calls are under way"};
  auto call = (*callable)->NewCall();
  if (const auto read = form_->ReadRequest(request.message, call->arguments()); !read) return read.error();
  (void)call->Begin(runtime_.clock().Now(), kForEver, {.asked = request.sent, .requests = {}});
  return call;
}

void OfferedService::Serve(const ServiceMessage& request) {
  std::shared_ptr<const ServiceForm> form;
  Result<std::unique_ptr<AnyCall>> begun = std::unique_ptr<AnyCall>();
  {
    const std::lock_guard lock(runtime_.structure_mutex());  // which may take its time
    begun = Begin(request);
    form = form_;
  }
  if (begun) {
    pending_.push_back({request.id, std::move(form), std::move(*begun)});
  } else if (form != nullptr) {
    Answer(request.id, *form, {.success = false, .message = begun.error().ToString()}, nullptr);
  }
}

bool OfferedService::Work() {
  if (endpoints_ == nullptr) return false;
  endpoints_->TakeWaiting([this](const ServiceMessage& request) {
    try {
      Serve(request);
    } catch (...) {  // for want of memory, of an answer, too
      ++failed_;
      throw;
    }
  });
  const Time now = runtime_.clock().Now();
  EraseWhere(pending_, [&](Pending& each) {
    const CallStatus status = each.call->Poll(now);
    if (status == CallStatus::kPending) return false;
    const bool is_answered = status == CallStatus::kAnswered;
    std::string why = is_answered ? "" : each.call->error();
    if (!is_answered && why.empty()) why = CallStatusName(status);
    Answer(each.id, *each.form, {.success = is_answered, .message = std::move(why)}, each.call->reply());
    return true;
  });
  return !pending_.empty();
}

void OfferedService::Answer(const CallId& id, const ServiceForm& form, const ServiceForm::Outcome& outcome,
                            const void* reply) {
  std::atomic<std::uint64_t>& count = outcome.success ? answered_ : failed_;
  if (!form.WriteResponse(outcome, reply, octets_)) {
    error_ = Error{.message = "a call has failed, which a " + form.ros_type() + " cannot say: " + outcome.message,
                   .path = options_.port,
                   .hint = "take a service type with success and message in its response"};
  } else if (const auto sent = endpoints_->Reply(id, octets_); !sent) {
    error_ = sent.error();
  }
  ++count;
}

std::string OfferedService::Text() const {
  std::string text = "offers the service " + options_.port + " as " + options_.service + "  ";
  if (endpoints_ == nullptr) return text + "(it is not there)\n";
  text += endpoints_->topics().request.name + ", " + std::to_string(answered_) + " answered, " +
          std::to_string(failed_) + " failed";
  if (endpoints_->lost() > 0) text += ", " + std::to_string(endpoints_->lost()) + " lost";
  return text + "\n";
}

}  // namespace runnel
