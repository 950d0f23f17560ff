#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/port/output.h"
#include "core/types/text_format.h"
#include "plugins/genom_execution/engine.h"
#include "plugins/services/any_call.h"
#include "plugins/services/call_record.h"
#include "plugins/services/callable.h"
#include "plugins/services/service_base.h"

namespace runnel::genom_modules {

/// What a module has beside its engine, and looks after the engine's requests: a service, a parameter.
class ModulePart {
 public:
  /// Before the first cycle: makes room.
  virtual void PrepareFor(genom_execution::Engine& engine) = 0;
  /// In each cycle, before the passes of the tasks.
  virtual void BeforePasses(genom_execution::Engine& engine, Time now) = 0;
  /// And after them: what has been done is answered.
  virtual void AfterPasses() = 0;
  /// A call of a service has been successful.
  virtual void AfterCall(genom_execution::Request& /*request*/) {}

 protected:
  ~ModulePart() = default;
};

class ComponentModule;

/// The part of a component's service that does not depend on its types: calls become requests of the engine, as many at
/// once as there is room for, and are answered when those are done.
///
/// Threads: as ServiceBase.
class ComponentServiceBase : public ServiceBase, public ModulePart {
 public:
  static constexpr std::size_t kMostUnderWay = 8;

  [[nodiscard]] ServiceState state() const override;
  bool Abort() override;

  void PrepareFor(genom_execution::Engine& engine) override;
  void BeforePasses(genom_execution::Engine& engine, Time now) override;
  void AfterPasses() override;

 protected:
  explicit ComponentServiceBase(const genom_execution::ServiceTable& service) : service_(service) {}
  ~ComponentServiceBase() = default;

  [[nodiscard]] bool is_activity() const noexcept { return service_.kind == genom_execution::ServiceKind::kActivity; }
  /// The call's arguments are written into the request.
  virtual void Fill(genom_execution::Request& request, CallBase& call) = 0;
  /// What has come of the request is written into the call's reply.
  virtual void Take(genom_execution::Request& request, CallBase& call) = 0;
  virtual void Record(CallBase& call, CallStatus status) = 0;
  /// By the destructor, while the port is still there.
  void EndCalls(CallStatus status, std::string_view why) noexcept;

 private:
  struct UnderWay {
    UnderWay(const genom_execution::ComponentTable& component, const genom_execution::ServiceTable& service)
        : request(component, service), abort(component, genom_execution::Engine::AbortService()) {}
    genom_execution::Request request;
    genom_execution::Request abort;
    CallBase* call = nullptr;
    bool is_interrupted = false;
    // Looked at by others. relaxed: they inform.
    std::atomic<std::uint32_t> id{0};  // of the activity that is under way; 0: none
    std::atomic<bool> is_abort_asked{false};
  };

  void BeforeUpdate() override {}  // BeforePasses() serves
  void AfterFault(std::string_view what) noexcept override;
  CallStatus Invoke(CallBase& /*call*/, Activity* /*activity*/) override { return CallStatus::kFailed; }
  [[nodiscard]] static bool IsFree(const UnderWay& each);
  void Begin(genom_execution::Engine& engine, UnderWay& each, Time now);
  static void Interrupt(genom_execution::Engine& engine, UnderWay& each, Time now);
  void Deliver(UnderWay& each);

  const genom_execution::ServiceTable& service_;
  ComponentModule* module_ = nullptr;
  std::deque<UnderWay> all_;
  std::size_t count_ = 0;  // of those under way
};

template <typename Signature>
class ComponentService;

/// A service of a component as one of its module: a call becomes a request of the engine, and is answered when that is
/// done, in whichever cycle. An activity tells the state that it is in, and can be aborted; a call that is given up
/// interrupts it, too. What comes of each is published at NAME_calls, if anybody looks.
///
/// Threads, allocation, life: as Service. Calls that are under way when the module goes end with `interrupted`.
template <typename Reply, typename... Arguments>
class ComponentService<Reply(Arguments...)> final : public ComponentServiceBase {
 public:
  using Signature = Reply(Arguments...);
  using Pack = ArgumentPack<Arguments...>;
  using Answered = typename runnel::internal::ReplyOf<Reply>::Type;
  struct Options {
    ServiceOptions service = {};
    const char* defaults = "";               ///< of its arguments, in the text format
    std::vector<std::string> required = {};  ///< names of those that have none
    void (*fill)(genom_execution::Request& request, Pack& arguments) = nullptr;
    void (*take)(genom_execution::Request& request, Answered& reply) = nullptr;
  };

  template <typename Owner>
  ComponentService(Owner& owner, const std::string& name, const genom_execution::ServiceTable& service, Options options)
      : ComponentServiceBase(service),
        fill_(options.fill),
        take_(options.take),
        endpoint_(std::make_unique<ServiceEndpoint>(options.service.queue)),
        port_(owner.OutputGroup(), name, {.description = options.service.description}),
        records_(owner.OutputGroup(), name) {
    const ServiceSignature& signature = runnel::internal::MakeServiceSignatureKnown<Signature, true>();
    auto callable = std::make_unique<CallableService>(
        *this, signature, signature.MakeForm(options.service.arguments), options.service.description,
        CallableOptions{is_activity(), options.defaults, options.required.empty(), options.required});
    port_.Publish(ServiceLink<Signature>{endpoint_.get()});
    port_.template Annotate<Callable>(std::move(callable));
    owner.AddPart(*this);
    Open(port_, false);
    (void)endpoint_.release();  // the channel's from here on
  }
  ~ComponentService() {
    EndCalls(CallStatus::kDisconnected, "the component has gone");
    Close();
  }

 private:
  void Fill(genom_execution::Request& request, CallBase& call) override {
    if (fill_ != nullptr) fill_(request, static_cast<Call<Signature>&>(call).arguments);
  }
  void Take(genom_execution::Request& request, CallBase& call) override {
    if (take_ != nullptr) take_(request, static_cast<Call<Signature>&>(call).reply);
  }
  void Record(CallBase& base, CallStatus status) override { records_.Record(base, status); }

  void (*const fill_)(genom_execution::Request& request, Pack& arguments);
  void (*const take_)(genom_execution::Request& request, Answered& reply);
  std::unique_ptr<ServiceEndpoint> endpoint_;
  Output<ServiceLink<Signature>> port_;
  runnel::internal::CallRecorderOf<Signature> records_;
};

}  // namespace runnel::genom_modules
