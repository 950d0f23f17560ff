#include "plugins/services/services_at_run_time.h"

#include <map>
#include <mutex>
#include <utility>

#include "core/channel/channel.h"
#include "core/channel/distribution.h"
#include "core/element/framework_element.h"
#include "core/port/bound_input.h"
#include "core/port/output_base.h"
#include "core/port/typed_ports.h"
#include "core/types/text_format.h"
#include "core/types/type_builder.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

/// The arguments of one call, each made by its type.
struct ArgumentBlock {
  std::vector<std::shared_ptr<void>> values;
};
/// Which of them, in the place of a pointer to a member.
struct ArgumentNumber {
  std::ptrdiff_t number;
};
std::byte& operator->*(ArgumentBlock* block, ArgumentNumber which) {
  return *static_cast<std::byte*>(block->values[static_cast<std::size_t>(which.number)].get());
}

}  // namespace

/// Describes them as a structure.
template <>
class TypeBuilder<ArgumentBlock> {
 public:
  static void Describe(TypeInfo& type, const std::vector<std::string>& names,
                       const std::vector<const TypeInfo*>& types) {
    type.name_ = "arguments";
    for (std::size_t i = 0; i < types.size(); ++i) {
      type.AddField(names.empty() ? "argument" + std::to_string(i + 1) : std::string(names[i]), *types[i], {},
                    FieldAddress(std::type_identity<ArgumentBlock>(), ArgumentNumber{static_cast<std::ptrdiff_t>(i)}));
    }
  }
};

/// The type of ports of such a signature: a name.
template <>
class TypeBuilder<FoundSignature> {
 public:
  static void Describe(TypeInfo& type, std::string name) { type.name_ = std::move(name); }
};

namespace {

struct CallAtRunTime final : CallBase {
  ArgumentBlock arguments;
  std::shared_ptr<void> reply;
};

class SlotsAtRunTime final : public CallSlots {
 public:
  SlotsAtRunTime(const SignatureTypes& types, std::size_t count) : slots_(std::make_unique<CallAtRunTime[]>(count)) {
    for (std::size_t i = 0; i < count; ++i) {
      for (const TypeInfo* each : types.arguments) slots_[i].arguments.values.push_back(each->Make());
      if (types.reply != nullptr) slots_[i].reply = types.reply->Make();
      calls_.push_back(&slots_[i]);
    }
  }

 private:
  const std::unique_ptr<CallAtRunTime[]> slots_;
};

class FormAtRunTime final : public CallForm {
 public:
  FormAtRunTime(const SignatureTypes& types, const std::vector<std::string>& names)
      : types_(types), is_named_(!(names.empty() && types.arguments.size() == 1)) {
    TypeBuilder<ArgumentBlock>::Describe(type_, names, types.arguments);
  }
  [[nodiscard]] const TypeInfo* arguments() const override {
    if (types_.arguments.empty()) return nullptr;
    return is_named_ ? &type_ : types_.arguments.front();
  }
  [[nodiscard]] const TypeInfo* reply() const override { return types_.reply; }
  [[nodiscard]] bool is_named() const override { return is_named_; }
  [[nodiscard]] const void* ArgumentsOf(const CallBase& call) const override {
    const auto& of = static_cast<const CallAtRunTime&>(call);
    return is_named_ ? static_cast<const void*>(&of.arguments) : of.arguments.values.front().get();
  }
  [[nodiscard]] void* ReplyOf(CallBase& call) const override { return static_cast<CallAtRunTime&>(call).reply.get(); }

 private:
  const SignatureTypes types_;
  const bool is_named_;
  TypeInfo type_{typeid(ArgumentBlock)};
};

// Such calls are not recorded, as records have types that are compiled.
class RunTimeSignature final : public ServiceSignature {
 public:
  explicit RunTimeSignature(SignatureTypes types) : types_(std::move(types)) {
    TypeBuilder<FoundSignature>::Describe(link, LinkName(types_));
  }
  [[nodiscard]] std::shared_ptr<const CallForm> MakeForm(const std::vector<std::string>& names) const override {
    return std::make_shared<FormAtRunTime>(types_, names);
  }
  [[nodiscard]] std::unique_ptr<CallSlots> MakeSlots(std::size_t count) const override {
    return std::make_unique<SlotsAtRunTime>(types_, count);
  }
  [[nodiscard]] std::unique_ptr<CallRecorder> MakeRecorder(FrameworkElement& /*group*/,
                                                           const std::string& /*service*/) const override {
    return nullptr;
  }
  void TakeArguments(const CallRecordBase& /*record*/, CallBase& /*call*/) const override {}

  TypeInfo link{typeid(FoundSignature)};

 private:
  const SignatureTypes types_;
};

struct Known {
  std::mutex mutex;
  std::map<const TypeInfo*, const ServiceSignature*> compiled;
  std::map<std::string, RunTimeSignature> made;
};
Known& All() {
  static auto* const all = new Known;  // ports look at types to the end
  return *all;
}

}  // namespace

void internal::AddServiceSignature(const TypeInfo& link, const ServiceSignature& signature, bool has_records) {
  Known& all = All();
  const std::lock_guard lock(all.mutex);
  const auto known = all.compiled.emplace(&link, &signature);
  if (has_records) known.first->second = &signature;
}

std::string LinkName(const SignatureTypes& types) { return "service " + SignatureName(types.reply, types.arguments); }

Result<FoundSignature> SignatureAtRunTime(const SignatureTypes& types) {
  internal::MakeServiceSignatureKnown<void(), true>();
  const std::string name = LinkName(types);
  const TypeInfo* const compiled = FindType(name);
  std::vector<const TypeInfo*> all_types = types.arguments;
  if (types.reply != nullptr) all_types.push_back(types.reply);
  for (const TypeInfo* each : all_types) {
    if (each->Make() == nullptr)
      return Error{.message = "only a module in C++ can make values of type " + each->name()};
  }
  Known& all = All();
  const std::lock_guard lock(all.mutex);
  if (const auto found = all.compiled.find(compiled); found != all.compiled.end())
    return FoundSignature{compiled, found->second};
  const RunTimeSignature& made = all.made.try_emplace(name, types).first->second;
  return FoundSignature{&made.link, &made};
}

namespace {

FoundSignature Found(const SignatureTypes& types) {
  const auto found = SignatureAtRunTime(types);
  if (!found) throw ElementError(found.error());
  return *found;
}

}  // namespace

ServiceAtRunTime::ServiceAtRunTime(FrameworkElement& group, const std::string& name, const SignatureTypes& types,
                                   ServiceOptions options, CallableOptions extra, Handler handler)
    : handler_(std::move(handler)) {
  const FoundSignature found = Found(types);
  form_ = found.signature->MakeForm(options.arguments);
  if (!extra.defaults.empty()) {
    // Once, so that NewCall() need not fail.
    const auto slots = found.signature->MakeSlots(1);
    void* const at = const_cast<void*>(form_->ArgumentsOf(*slots->Acquire()));
    if (auto set = SetFromText(*form_->arguments(), extra.defaults, at); !set) throw ElementError(set.error());
  }
  port_ = MakeLinkOutput(*found.link, group, name, {.description = options.description});
  auto endpoint = std::make_unique<ServiceEndpoint>(options.queue);
  const auto published = port_->PublishFilled([&](void* link) -> Result<void> {
    *static_cast<ServiceEndpoint**>(link) = endpoint.get();
    return {};
  });
  if (!published) throw ElementError(published.error());
  records_ = found.signature->MakeRecorder(group, name);
  port_->Annotate<Callable>(
      std::make_unique<CallableService>(*this, *found.signature, form_, options.description, extra));
  Open(*port_, extra.is_activity);
  (void)endpoint.release();  // the channel's from here on
}

CallStatus ServiceAtRunTime::Invoke(CallBase& call, Activity* activity) {
  const auto done = handler_(*form_, call, activity);
  if (!done) call.error = done.error().ToString();
  const CallStatus status = done ? CallStatus::kAnswered : CallStatus::kFailed;
  if (records_ != nullptr) records_->Record(call, status);
  return status;
}

ClientAtRunTime::ClientAtRunTime(FrameworkElement& group, const std::string& name, const SignatureTypes& types,
                                 const ClientOptions& options, CalledBack called_back)
    : ClientAtRunTime(group, name, Found(types), options, std::move(called_back)) {}

ClientAtRunTime::ClientAtRunTime(FrameworkElement& group, const std::string& name, FoundSignature found,
                                 const ClientOptions& options, CalledBack called_back)
    : ClientBase(options, found.signature->MakeSlots(options.calls)),
      called_back_(std::move(called_back)),
      form_(found.signature->MakeForm(options.arguments)),
      port_(
          MakeLinkInput(*found.link, group, name, {.description = options.description, .required = options.required})) {
  port_->Annotate<ClientForm>(std::make_unique<ClientForm>(form_));
  Open(*port_);
}

// Ports of services and clients whose types are known at run time only.

namespace {

// Like any ServiceLink; the port says of which type it is.
struct AnyLink {
  ServiceEndpoint* endpoint = nullptr;
};

class AnyLinkOutput final : public OutputBase {
 public:
  AnyLinkOutput(const TypeInfo& link, FrameworkElement& group, std::string name, OutputOptions options)
      : OutputBase(group, std::move(name), link, std::move(options),
                   std::make_unique<Channel<AnyLink>>(PoolOptions{}, BufferPool<AnyLink>::Factory{})) {}
};

class AnyLinkInput final : public BoundInput {
 public:
  AnyLinkInput(const TypeInfo& link, FrameworkElement& group, std::string name, InputOptions options)
      : BoundInput(group, std::move(name), link, std::move(options)) {}
  ~AnyLinkInput() override { DisconnectForEver(); }

  // A client has one service.
  bool VisitLatest(const Visitor& visit) const override {
    const EpochGuard guard;
    const Binding& bound = *binding();
    return bound.channel != nullptr && bound.channel->VisitLatest(visit);
  }

 private:
  [[nodiscard]] bool HasNew() const override { return false; }
  [[nodiscard]] std::unique_ptr<InputQueueBase> MakeQueue(std::size_t capacity, OnFull on_full,
                                                          Writers writers) const override {
    return internal::DistributionOf<AnyLink>::MakeQueue(capacity, on_full, writers);
  }
};

}  // namespace

std::unique_ptr<Port> MakeLinkOutput(const TypeInfo& link, FrameworkElement& group, std::string name,
                                     OutputOptions options) {
  if (const TypedPorts* const ports = FindTypedPorts(link)) return ports->MakeOutput(group, std::move(name), options);
  return std::make_unique<AnyLinkOutput>(link, group, std::move(name), std::move(options));
}

std::unique_ptr<Port> MakeLinkInput(const TypeInfo& link, FrameworkElement& group, std::string name,
                                    InputOptions options) {
  if (const TypedPorts* const ports = FindTypedPorts(link)) return ports->MakeInput(group, std::move(name), options);
  return std::make_unique<AnyLinkInput>(link, group, std::move(name), std::move(options));
}

}  // namespace runnel
