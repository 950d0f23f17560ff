#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/result.h"
#include "core/port/output.h"
#include "core/port/port_owner.h"
#include "plugins/services/any_call.h"
#include "plugins/services/call_record.h"
#include "plugins/services/service_base.h"
#include "plugins/services/service_signature.h"

namespace runnel {

/// Something that a module does when it is asked, for one caller, with an answer: "save the map", "is the arm homed".
///
///     Service<MapFacts(std::string)> save{this, "save", &Mapper::Save, {.arguments = {"file"}}};
///
/// Arguments and reply are described types. What the handler is decides who serves:
///
///     Reply Save(const std::string& file)                      in the module's cycle, before Update()
///     Result<Reply> Save(const std::string& file)              … and may say an error
///     Result<Reply> Save(Activity&, const std::string& file)   a thread of the service's own, for what takes long:
///                                                              one call at a time, with progress and abort
///
/// Connected like an output: from the service to clients of the same type, however many. What comes of each call is
/// published at a second output, NAME_calls, if anybody looks: recordings have request and answer.
///
/// Threads:     handlers that get an Activity run beside Update() and share nothing with it by themselves.
/// Allocation:  none by serving in the cycle, but for what values and handlers allocate themselves.
/// Errors:      what a handler throws in the cycle ends the call, and is the module's fault; in the service's own
///              thread it ends the call.
/// Life:        calls that wait survive a swap of the module, and are served by the one that comes. Else each ends
///              with a reason.
template <typename Signature>
class Service;

template <typename Reply, typename... Arguments>
class Service<Reply(Arguments...)> final : public ServiceBase {
 public:
  using Signature = Reply(Arguments...);

  template <typename Owner, typename Handler>
  Service(Owner* owner, std::string name, Handler handler, ServiceOptions options = {})
      : Service(static_cast<PortOwner*>(owner)->OutputGroup(), *owner, std::move(name), std::move(handler),
                std::move(options)) {}
  /// Into a certain group. `owner` is what the handler is called on.
  template <typename Owner, typename Handler>
  Service(FrameworkElement& group, Owner& owner, std::string name, Handler handler, ServiceOptions options = {})
      : handler_(Bind(owner, std::move(handler))),
        endpoint_(std::make_unique<ServiceEndpoint>(options.queue)),
        port_(group, name, {.description = options.description}),
        records_(group, name) {
    // First, as it may refuse the options, and nothing is to be left of a service then.
    const ServiceSignature& signature = internal::MakeServiceSignatureKnown<Signature, true>();
    auto callable =
        std::make_unique<CallableService>(*this, signature, signature.MakeForm(options.arguments), options.description,
                                          CallableOptions{.is_activity = kIsActivity<Owner, Handler>});
    port_.Publish(ServiceLink<Signature>{endpoint_.get()});
    port_.template Annotate<Callable>(std::move(callable));
    Open(port_, kIsActivity<Owner, Handler>);
    (void)endpoint_.release();  // the channel's from here on
  }
  ~Service() { Close(); }

 private:
  template <typename Owner, typename Handler>
  static constexpr bool kIsActivity =
      std::is_invocable_v<Handler&, Owner&, Activity&, const std::remove_cvref_t<Arguments>&...>;

  template <typename Owner, typename Handler>
  static auto Bind(Owner& owner, Handler handler) {
    return [&owner, handler](Call<Signature>& call, Activity* activity) -> CallStatus {
      return WithArguments<Arguments...>(call.arguments, [&](auto&... argument) {
        if constexpr (kIsActivity<Owner, Handler>) {
          return Take(call, [&]() -> decltype(auto) {
            return std::invoke(handler, owner, *activity, std::as_const(argument)...);
          });
        } else {
          static_assert(std::is_invocable_v<Handler&, Owner&, const std::remove_cvref_t<Arguments>&...>,
                        "the handler does not take the service's arguments");
          return Take(call,
                      [&]() -> decltype(auto) { return std::invoke(handler, owner, std::as_const(argument)...); });
        }
      });
    };
  }

  // What the handler has returned: a reply, or a Result of one.
  template <typename Handler>
  static CallStatus Take(Call<Signature>& call, const Handler& handler) {
    using Returned = std::invoke_result_t<const Handler&>;
    if constexpr (std::is_void_v<Returned>) {
      handler();
    } else if constexpr (requires(Returned & returned) { returned.error(); }) {
      auto returned = handler();
      if (!returned) {
        call.error = returned.error().ToString();
        return CallStatus::kFailed;
      }
      if constexpr (!std::is_void_v<Reply>) call.reply = std::move(*returned);
    } else {
      call.reply = handler();
    }
    return CallStatus::kAnswered;
  }

  CallStatus Invoke(CallBase& base, Activity* activity) override {
    const CallStatus status = handler_(static_cast<Call<Signature>&>(base), activity);
    records_.Record(base, status);
    return status;
  }

  const std::function<CallStatus(Call<Signature>&, Activity*)> handler_;
  std::unique_ptr<ServiceEndpoint> endpoint_;
  Output<ServiceLink<Signature>> port_;
  internal::CallRecorderOf<Signature> records_;
};

}  // namespace runnel
