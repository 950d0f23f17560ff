#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/port/input.h"
#include "core/port/port_owner.h"
#include "plugins/services/client_base.h"
#include "plugins/services/service_signature.h"

namespace runnel {

/// What has come of a call. The reply lies where the service has put it: copy what is to be kept.
template <typename Reply>
class CallOutcome {
 public:
  CallOutcome(CallStatus status, const CallBase* call, const typename internal::ReplyOf<Reply>::Type* reply) noexcept
      : status_(status), call_(call), reply_(reply) {}

  [[nodiscard]] CallStatus status() const noexcept { return status_; }
  /// Whether there is a reply.
  [[nodiscard]] explicit operator bool() const noexcept { return status_ == CallStatus::kAnswered; }
  /// Precondition: there is one.
  [[nodiscard]] const auto& operator*() const noexcept { return *reply_; }
  [[nodiscard]] const auto* operator->() const noexcept { return reply_; }
  /// What the service says went wrong; else the name of the status.
  [[nodiscard]] std::string_view error() const noexcept {
    const bool is_told = call_ != nullptr && call_->is_answered() && !call_->error.empty();
    return is_told ? std::string_view(call_->error) : CallStatusName(status_);
  }

 private:
  CallStatus status_;
  const CallBase* call_;
  const typename internal::ReplyOf<Reply>::Type* reply_;
};

template <typename Signature>
class Client;

/// The answer to a call, once it is there. Destroyed before, the call is given up, and an activity asked to end.
///
/// Threads: one at a time. Life: no longer than the client.
template <typename Signature>
class CallFuture;
template <typename Reply, typename... Arguments>
class CallFuture<Reply(Arguments...)> {
 public:
  CallFuture() = default;
  ~CallFuture() { Drop(); }
  CallFuture(CallFuture&& other) noexcept { *this = std::move(other); }
  CallFuture& operator=(CallFuture&& other) noexcept {
    if (this == &other) return *this;
    Drop();
    client_ = other.client_;
    call_ = std::exchange(other.call_, nullptr);
    status_ = other.status_;
    return *this;
  }

  /// Does not wait; good in a cycle.
  [[nodiscard]] bool is_done() noexcept {
    if (status_ == CallStatus::kPending) status_ = client_->Poll(*call_);
    return status_ != CallStatus::kPending;
  }
  /// kPending: none yet.
  [[nodiscard]] CallOutcome<Reply> outcome() noexcept {
    (void)is_done();
    return {status_, call_, call_ != nullptr ? &call_->reply : nullptr};
  }
  /// Sleeps until it is there, or the time-out has passed. Errors: in a cycle throws ProgrammingError.
  CallOutcome<Reply> Wait() {
    if (status_ == CallStatus::kPending) status_ = client_->Wait(*call_);
    return outcome();
  }
  /// Of an activity: 0 to 1.
  [[nodiscard]] double progress() const noexcept {
    return call_ != nullptr ? call_->progress.load(std::memory_order_relaxed) : 0;
  }
  /// Asks an activity to come to its end, which is still awaited; a call that has not begun is not begun.
  void Abort() noexcept {
    if (call_ != nullptr) call_->is_given_up.store(true, std::memory_order_relaxed);
  }

 private:
  friend class Client<Reply(Arguments...)>;
  using Slot = Call<Reply(Arguments...)>;
  CallFuture(const ClientBase& client, Slot* call, CallStatus status) noexcept
      : client_(&client), call_(call), status_(status) {}
  void Drop() noexcept {
    if (call_ == nullptr) return;
    Abort();
    CallSlots::Release(*std::exchange(call_, nullptr));
  }

  const ClientBase* client_ = nullptr;
  Slot* call_ = nullptr;
  CallStatus status_ = CallStatus::kNotConnected;
};

/// What a module asks others to do: the other end of a Service of the same type. Connected like an input.
///
///     Client<MapFacts(std::string)> save{this, "save"};
///     …
///     save.Send("map.pgm");                                        // one way
///     save.Call([this](const auto& outcome) { … }, "map.pgm");     // calls back in a cycle of this module
///     saving = save.Begin("map.pgm");                              // a future: saving.is_done(), or
///     saving.Wait();                                               // outside of cycles
///
/// Each call ends: with a reply, or with a reason (CallStatus), at the latest when the client's time-out has passed on
/// the application's clock. A call that cannot begin says so at once.
///
/// Threads:     any may Send() and Begin(); Call() that of the module's cycle.
/// Progress:    lock-free.
/// Allocation:  none by a call, but for what copying its arguments allocates: the places of calls are made at the
///              start, and used again.
template <typename Reply, typename... Arguments>
class Client<Reply(Arguments...)> final : public ClientBase {
 public:
  using Signature = Reply(Arguments...);
  using Outcome = CallOutcome<Reply>;

  Client(PortOwner* owner, std::string name, ClientOptions options = {})
      : Client(owner->InputGroup(), std::move(name), std::move(options)) {}
  /// Into a certain group.
  Client(FrameworkElement& group, std::string name, ClientOptions options = {})
      : ClientBase(options, std::make_unique<CallSlotsOf<Signature>>(options.calls)),
        port_(group, std::move(name), {.description = options.description, .required = options.required}) {
    const ServiceSignature& signature = internal::MakeServiceSignatureKnown<Signature, false>();
    port_.template Annotate<ClientForm>(std::make_unique<ClientForm>(signature.MakeForm(options.arguments)));
    Open(port_);
  }
  ~Client() { Close(); }

  /// One way: nobody is told what comes of it, but for the service's figures. kPending, or why it is not called.
  CallStatus Send(const std::remove_cvref_t<Arguments>&... arguments) {
    Slot* const call = Fill(arguments...);
    if (call == nullptr) return CallStatus::kBusy;
    const CallStatus status = ClientBase::Begin(*call);
    CallSlots::Release(*call);
    return status;
  }

  /// `callback(const CallOutcome<Reply>&)` is called in a cycle of this module, before its Update(). It captures two
  /// pointers at most: more would have to be allocated. kPending; else it is not called, and so is nobody back.
  template <typename Callback>
  CallStatus Call(const Callback& callback, const std::remove_cvref_t<Arguments>&... arguments) {
    static_assert(sizeof(Callback) <= 2 * sizeof(void*) && std::is_trivially_copyable_v<Callback>,
                  "a callback that captures more than two pointers would have to be allocated");
    Slot* const call = Fill(arguments...);
    if (call == nullptr) return CallStatus::kBusy;
    call->callback = callback;
    const CallStatus status = ClientBase::Begin(*call);
    if (status == CallStatus::kPending) {
      AwaitInCycle(*call);
    } else {
      CallSlots::Release(*call);
    }
    return status;
  }

  /// Its answer is there later.
  [[nodiscard]] CallFuture<Signature> Begin(const std::remove_cvref_t<Arguments>&... arguments) {
    Slot* const call = Fill(arguments...);
    if (call == nullptr) return {*this, nullptr, CallStatus::kBusy};
    return {*this, call, ClientBase::Begin(*call)};
  }

 private:
  using Slot = runnel::Call<Signature>;

  [[nodiscard]] ServiceEndpoint* endpoint() const noexcept override { return port_.Get().endpoint; }
  [[nodiscard]] Slot* Fill(const std::remove_cvref_t<Arguments>&... arguments) {
    Slot* const call = static_cast<Slot*>(Acquire());
    if (call == nullptr) return nullptr;
    try {
      WithArguments<Arguments...>(call->arguments, [&](auto&... place) { ((place = arguments), ...); });
    } catch (...) {
      CallSlots::Release(*call);
      throw;
    }
    return call;
  }
  void CallBack(CallBase& base, CallStatus status) override {
    auto& call = static_cast<Slot&>(base);
    call.callback(Outcome(status, &call, &call.reply));
  }

  Input<ServiceLink<Signature>> port_;
};

}  // namespace runnel
