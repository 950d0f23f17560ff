#include "apps/python/extension/module_services.h"

#include <tuple>
#include <utility>

#include <pybind11/stl.h>

#include "apps/python/extension/errors.h"
#include "apps/python/extension/interpreter.h"
#include "apps/python/extension/value.h"
#include "core/port/cycle.h"
#include "core/types/type_info.h"

namespace py = pybind11;

namespace runnel::python {

namespace {

py::object CopyToPython(const TypeInfo& type, const void* at) {
  const Value made = NewValue(type);
  if (!CopyValue(type, at, made.at)) throw py::value_error("a value of " + type.name() + " cannot be copied");
  return ToPython(type, made.at, made.memory);
}

SignatureTypes TypesOf(const py::dict& said) {
  SignatureTypes types;
  if (const auto reply = said["reply"].cast<std::string>(); !reply.empty()) types.reply = &TypeNamed(reply);
  for (const auto& each : said["types"].cast<std::vector<std::string>>()) types.arguments.push_back(&TypeNamed(each));
  LookForType(LinkName(types));  // so that modules in C++ which offer such services, or use them, come first
  return types;
}

Result<void> TakeReply(const TypeInfo& type, const py::object& reply, void* at) {
  std::string why;
  try {
    FromPython(type, reply, at);
    return {};
  } catch (const py::error_already_set& thrown) {
    why = FaultOf(thrown).first;
  } catch (const py::builtin_exception& thrown) {
    why = thrown.what();
  }
  return Error{.message = "what it has returned is no " + type.name() + ": " + why};
}

// Literals live as long, and so do these: what activities say they are doing.
const char* Kept(const std::string& text) {
  static auto* const all = new std::set<std::string>;  // with the GIL
  constexpr std::size_t kMost = 1000;
  if (all->size() >= kMost && !all->contains(text)) return "";
  return all->insert(text).first->c_str();
}

struct ActivityOfModule {
  Activity* activity;
};

}  // namespace

ModuleService::ModuleService(FrameworkElement& group, const std::string& name, const py::dict& said,
                             std::function<void(const std::string&)> log_error)
    : log_error_(std::move(log_error)) {
  const SignatureTypes types = TypesOf(said);
  const ServiceOptions options{.description = said["description"].cast<std::string>(),
                               .arguments = said["names"].cast<std::vector<std::string>>(),
                               .queue = said["queue"].cast<std::size_t>()};
  const CallableOptions extra{.is_activity = said["activity"].cast<bool>(),
                              .defaults = said["defaults"].cast<std::string>(),
                              .are_arguments_optional = said["are_optional"].cast<bool>()};
  const auto serve = [this](const CallForm& form, CallBase& call, Activity* activity) {
    return Serve(form, call, activity);
  };
  service_ = WithoutGil([&] { return std::make_unique<ServiceAtRunTime>(group, name, types, options, extra, serve); });
}

ModuleService::~ModuleService() {
  service_.reset();
  const GilInCycle gil;
  handler_.dec_ref();
}

Result<void> ModuleService::Serve(const CallForm& form, CallBase& call, Activity* activity) {
  const GilInCycle gil;
  try {
    py::dict named;
    if (form.arguments() != nullptr) {
      const void* const at = form.ArgumentsOf(call);
      for (const FieldInfo& each : form.arguments()->fields())
        named[py::str(each.name)] = CopyToPython(*each.type, each.address(ForLooking(at)));
    }
    const auto told = std::make_shared<ActivityOfModule>(ActivityOfModule{activity});
    // Whatever keeps the object finds a call that is over.
    const std::shared_ptr<void> end(nullptr, [told](void*) { told->activity = nullptr; });
    const py::object reply = activity != nullptr ? handler_(py::cast(told), **named) : handler_(**named);
    return form.reply() != nullptr ? TakeReply(*form.reply(), reply, form.ReplyOf(call)) : Result<void>();
  } catch (const py::error_already_set& thrown) {
    (void)KeepInterrupt(thrown);
    const auto [summary, whole] = FaultOf(thrown);
    log_error_(whole);
    return Error{.message = summary};
  }
}

CallOfModule::CallOfModule(ModuleClient& client, CallBase* call, CallStatus status)
    : client_(&client), call_(call), status_(status) {
  client_->looked_at_.insert(this);
}

CallOfModule::~CallOfModule() {
  if (client_ == nullptr) return;
  client_->looked_at_.erase(this);
  Abort();
  Forget();
}

void CallOfModule::Forget() {
  if (call_ != nullptr) {
    (void)Poll();
    CallSlots::Release(*std::exchange(call_, nullptr));
  }
  if (status_ == CallStatus::kPending) status_ = CallStatus::kDisconnected;
  client_ = nullptr;
}

void CallOfModule::Leave() noexcept {
  if (client_ != nullptr) client_->looked_at_.erase(this);
  call_ = nullptr;
  client_ = nullptr;
}

CallStatus CallOfModule::Poll() {
  if (call_ != nullptr && status_ == CallStatus::kPending) status_ = client_->client_->Poll(*call_);
  return status_;
}

py::object CallOfModule::Reply() {
  if (Poll() != CallStatus::kAnswered || call_ == nullptr) return reply_;
  const CallForm& form = *client_->client_->form();
  return form.reply() == nullptr ? py::none() : CopyToPython(*form.reply(), form.ReplyOf(*call_));
}

std::string CallOfModule::Error() {
  const CallStatus status = Poll();
  if (status == CallStatus::kPending || status == CallStatus::kAnswered) return "";
  if (!error_.empty()) return error_;
  const bool is_told = call_ != nullptr && call_->is_answered() && !call_->error.empty();
  return is_told ? call_->error : CallStatusName(status);
}

double CallOfModule::Progress() const { return call_ == nullptr ? 0 : call_->progress.load(std::memory_order_relaxed); }
std::string CallOfModule::Doing() const { return call_ == nullptr ? "" : call_->doing.load(std::memory_order_relaxed); }

void CallOfModule::Abort() {
  if (call_ != nullptr) call_->is_given_up.store(true, std::memory_order_relaxed);
}

ModuleClient::ModuleClient(FrameworkElement& group, const std::string& name, const py::dict& said,
                           std::function<void(const py::error_already_set&)> as_fault)
    : as_fault_(std::move(as_fault)) {
  const SignatureTypes types = TypesOf(said);
  const ClientOptions options{.description = said["description"].cast<std::string>(),
                              .required = said["required"].cast<bool>(),
                              .calls = said["calls"].cast<std::size_t>(),
                              .timeout = FromSeconds(said["timeout"].cast<double>()),
                              .arguments = said["names"].cast<std::vector<std::string>>()};
  const auto called_back = [this](CallBase& call, CallStatus status) { CalledBack(call, status); };
  client_ = WithoutGil([&] { return std::make_unique<ClientAtRunTime>(group, name, types, options, called_back); });
}

ModuleClient::~ModuleClient() {
  {
    const GilInCycle gil;
    for (CallOfModule* each : looked_at_) each->Forget();
    callbacks_.clear();
  }
  client_.reset();
}

CallBase* ModuleClient::Fill(const py::args& positional, const py::kwargs& named) {
  const CallForm& form = *client_->form();
  const TypeInfo* const type = form.arguments();
  const bool is_single = type != nullptr && !form.is_named();
  const std::size_t count = type == nullptr ? 0 : is_single ? 1 : type->fields().size();
  if (positional.size() + named.size() != count || (is_single && !named.empty())) {
    throw py::type_error("the call takes " + std::to_string(count) + (count == 1 ? " argument" : " arguments"));
  }
  CallBase* const call = client_->Acquire();
  if (call == nullptr || type == nullptr) return call;
  try {
    void* const at = const_cast<void*>(form.ArgumentsOf(*call));
    if (is_single) {
      FromPython(*type, positional[0], at);
      return call;
    }
    py::dict all(named);
    for (std::size_t i = 0; i < positional.size(); ++i) all[py::str(type->fields()[i].name)] = positional[i];
    FromPython(*type, all, at);
    return call;
  } catch (...) {
    CallSlots::Release(*call);
    throw;
  }
}

bool ModuleClient::Send(const py::args& positional, const py::kwargs& named) {
  CallBase* const call = Fill(positional, named);
  if (call == nullptr) return false;
  const bool has_begun = client_->Begin(*call) == CallStatus::kPending;
  CallSlots::Release(*call);
  return has_begun;
}

bool ModuleClient::Call(const py::object& callback, const py::args& positional, const py::kwargs& named) {
  // Who calls back does not take the GIL to look for what has ended.
  if (CurrentCycle() == nullptr)
    throw py::value_error("call() is for the module's own cycle; elsewhere begin() is, and send()");
  CallBase* const call = Fill(positional, named);
  if (call == nullptr) return false;
  if (client_->Begin(*call) != CallStatus::kPending) {
    CallSlots::Release(*call);
    return false;
  }
  callbacks_[call] = callback;
  client_->AwaitInCycle(*call);
  return true;
}

std::unique_ptr<CallOfModule> ModuleClient::Begin(const py::args& positional, const py::kwargs& named) {
  CallBase* const call = Fill(positional, named);
  return std::make_unique<CallOfModule>(*this, call, call == nullptr ? CallStatus::kBusy : client_->Begin(*call));
}

// The client lets go of the call afterwards.
void ModuleClient::CalledBack(CallBase& call, CallStatus status) {
  const GilInCycle gil;
  const auto found = callbacks_.find(&call);
  if (found == callbacks_.end()) return;
  const py::object callback = std::move(found->second);
  callbacks_.erase(found);
  try {
    const py::object outcome = py::cast(std::make_unique<CallOfModule>(*this, &call, status));
    auto& told = outcome.cast<CallOfModule&>();
    const std::shared_ptr<void> end(nullptr, [&](void*) { told.Leave(); });
    callback(outcome);
    if (outcome.ref_count() > 1) std::tie(told.reply_, told.error_) = std::pair(told.Reply(), told.Error());
  } catch (const py::error_already_set& thrown) {
    if (!KeepInterrupt(thrown)) as_fault_(thrown);
  }
}

void BindModuleServices(py::module_& module) {
  py::class_<ActivityOfModule, std::shared_ptr<ActivityOfModule>>(module, "ModuleActivity",
                                                                  "What a service with activity=True is told.")
      .def(
          "report",
          [](const ActivityOfModule& told, double fraction, const std::string& doing) {
            if (told.activity != nullptr) told.activity->Report(fraction, Kept(doing));
          },
          py::arg("fraction"), py::arg("doing") = "", "How far it has come, 0 to 1, and what it is about.")
      .def_property_readonly(
          "is_abort_asked",
          [](const ActivityOfModule& told) { return told.activity == nullptr || told.activity->is_abort_asked(); },
          "The caller wants no answer any more, or the module is about to go: it should end soon.");
  py::class_<CallOfModule>(module, "ModuleCall", "A call that a module in Python has begun. Let go of, it is given up.")
      .def_property_readonly("is_done", [](CallOfModule& call) { return call.Poll() != CallStatus::kPending; })
      .def_property_readonly(
          "status", [](CallOfModule& call) { return CallStatusName(call.Poll()); },
          "pending, answered, failed, timed_out, not_connected, ...")
      .def_property_readonly("reply", &CallOfModule::Reply, "A copy; None without one.")
      .def_property_readonly("error", &CallOfModule::Error, "Why there is none; '' if nothing is wrong.")
      .def_property_readonly("progress", &CallOfModule::Progress, "Of an activity, 0 to 1.")
      .def_property_readonly("doing", &CallOfModule::Doing)
      .def("abort", &CallOfModule::Abort, "Asks an activity to come to its end, which is still awaited.");
}

}  // namespace runnel::python
