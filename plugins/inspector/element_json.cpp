#include <algorithm>

#include "core/element/attempt.h"
#include "core/element/configurable.h"
#include "core/element/element_path.h"
#include "core/element/tags.h"
#include "core/paths/late_connections.h"
#include "core/plugin/module_type_name.h"
#include "core/port/converted_flow.h"
#include "core/port/port_stop.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/inspector/structure_mirror.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/services/callable.h"
#include "plugins/structure/value_by_hand.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

std::string_view ThreadName(const FrameworkElement& element, const ElementSurroundings& around) {
  std::uint64_t id = AssignedThread(element);
  if (id == 0) id = around.default_thread;
  const auto found = around.thread_names.find(id);
  return found == around.thread_names.end() ? std::string_view() : found->second;
}

std::string_view FailureOf(const FrameworkElement& element, const ElementSurroundings& around) {
  const auto found = around.failed.find(element.id());
  return found == around.failed.end() ? std::string_view() : found->second;
}

bool IsPaused(const FrameworkElement& element, const ElementSurroundings& around) {
  if (around.paused.empty()) return false;
  const std::string path = element.path();
  return std::ranges::any_of(around.paused, [&](const std::string& each) { return IsAtOrBelow(path, each); });
}

void AddThread(const ThreadContainer& thread, const ElementSurroundings& around, JsonObject& json) {
  const ThreadOptions& options = thread.options();
  const bool has_period = options.activation == ThreadOptions::Activation::kPeriod;
  json.Add("kind", "thread").Add("name", thread.name());
  json.AddOrNull("period", has_period ? std::optional(ToSeconds(options.period)) : std::nullopt);
  json.Add("activation", ActivationNames()[static_cast<std::size_t>(options.activation)]);
  json.Add("priority", options.priority).Add("order", thread.id());
  if (IsPaused(thread, around)) json.Add("paused", true);
}

void AddAwaited(const std::vector<const LateConnection*>& awaited, JsonObject& json) {
  AppendList(awaited, json.Key("awaits"), [](const LateConnection* each, std::string& text) {
    JsonObject object(text);
    object.Add("from", each->SourceText()).Add("to", each->to).Add("why", *each->waits_for);
  });
}

void AddArgument(const FieldInfo& field, const void* all, std::string& text) {
  const void* const value = field.address(ForLooking(all));
  JsonObject argument(text);
  argument.Add("name", field.name).Add("data_type", field.type->name()).Add("unit", field.unit);
  argument.Add("description", field.description);
  argument.Add("value", field.type->is_transparent() ? ToText(*field.type, value) : "");
}

// What a form is made from: its fields, or one for the only argument.
void AddService(Callable& callable, JsonObject& json) {
  JsonObject service(json.Key("service"));
  const TypeInfo* const type = callable.arguments();
  service.Add("description", callable.description()).Add("activity", callable.is_activity());
  service.Add("arguments", type != nullptr ? type->name() : "");
  service.Add("reply", callable.reply() != nullptr ? callable.reply()->name() : "");
  if (type == nullptr) return;
  const auto call = callable.NewCall();
  if (type->kind() == TypeKind::kStructure) {
    AppendList(type->fields(), service.Key("fields"),
               [&](const FieldInfo& field, std::string& text) { AddArgument(field, call->arguments(), text); });
  } else {
    service.Add("value", ToText(*type, call->arguments()));
  }
}

void AddPort(const Port& port, JsonObject& json) {
  const FrameworkElement* const owner = FindOwner(port);
  json.Add("kind", "port").Add("name", port.name());
  json.Add("direction", port.direction() == Port::Direction::kInput ? "input" : "output");
  json.Add("data_type", port.type().name()).Add("interface", port.is_proxy());
  json.Add("required", port.is_required()).Add("pullable", port.is_pullable());
  json.Add("description", port.description()).Add("unit", port.unit());
  json.Add("by_hand", port.is_set_by_hand() || port.is_set_by_hand(Port::Setter::kRule));
  json.Add("driving", port.is_driving()).Add("blocked", port.is_blocked());
  const AnyValue behind = SafeValueBehind(port);
  json.Add("moves", port.is_driving() || MovesSomething(port));
  const AnyValue safe = port.stop() ? port.stop()->safe_value() : behind;
  if (safe && &safe.type() == &port.type()) json.Add("safe", ToText(safe.type(), safe.get()));
  const InputLimits& limits = port.limits();
  json.Add("bounds", BoundsText(limits));
  json.AddTextOrNull("default", limits.default_value ? ToText(limits.default_value.type(), limits.default_value.get())
                                                     : std::string());
  AddAwaited(AwaitedBy(port), json);
  if (auto* const callable = port.FindAnnotation<Callable>()) AddService(*callable, json);
  json.Add("owner", owner != nullptr ? owner->path() : "");
}

void AddParameter(const FrameworkElement& element, const Configurable& parameter, JsonObject& json) {
  const ConfigurableInfo& info = parameter.info();
  const FrameworkElement* const owner = FindOwner(element);
  json.Add("kind", "parameter").Add("name", element.name());
  json.Add("data_type", parameter.type().name()).Add("unit", info.unit);
  json.AddOrNull("minimum", info.minimum).AddOrNull("maximum", info.maximum);
  json.Add("description", info.description).Add("value", ParameterText(parameter));
  json.Add("default", info.default_value).Add("settable", !info.is_static);
  // One that is static is set by making its module anew.
  const bool has_type = owner != nullptr && !FindModuleType(*owner).empty();
  json.Add("remakes", info.is_static && has_type);
  json.Add("owner", owner != nullptr ? owner->path() : "");
}

void AddOther(const FrameworkElement& element, const ElementSurroundings& around, JsonObject& json) {
  if (IsModule(element)) {
    json.Add("kind", "module").Add("name", element.name());
    const std::string name = FindModuleType(element);
    const ModuleType* const type = around.modules->Find(name);
    json.Add("type", name).Add("summary", type != nullptr ? type->summary : "");
    json.AddTextOrNull("thread", ThreadName(element, around));
    const std::string_view failure = FailureOf(element, around);
    json.AddTextOrNull("failure", failure);
    std::vector<StuckModule> stuck;
    if (!failure.empty() && around.scheduler != nullptr) stuck = around.scheduler->StuckModules();
    if (std::ranges::find(stuck, element.path(), &StuckModule::path) != stuck.end()) json.Add("stuck", true);
    if (IsPaused(element, around)) json.Add("paused", true);
    return;
  }
  const bool is_group = element.kind() == ElementKind::kGroup;
  const bool is_top = element.parent() != nullptr && element.parent()->parent() == nullptr;
  json.Add("kind", is_group && is_top ? "application" : "group");
  json.Add("name", element.name());
  if (IsPaused(element, around)) json.Add("paused", true);
  if (!is_group) json.Add("is_plain", true);
  if (is_group && is_top) AddAwaited(AwaitedBelow(element), json);
  const ThreadContainer* const thread = OwnThread(element);
  if (thread != nullptr) json.Add("thread", thread->name());
}

}  // namespace

std::string ElementJson(const FrameworkElement& element, const ElementSurroundings& around) {
  return JsonObjectText([&](JsonObject& json) {
    json.Add("path", element.path());
    const std::string tags = TagsText(element);
    if (!tags.empty()) json.Add("tags", tags);
    if (const auto* const port = dynamic_cast<const Port*>(&element)) {
      AddPort(*port, json);
    } else if (const auto* const parameter = dynamic_cast<const Configurable*>(&element)) {
      AddParameter(element, *parameter, json);
    } else if (const auto* const thread = dynamic_cast<const ThreadContainer*>(&element)) {
      AddThread(*thread, around, json);
    } else {
      AddOther(element, around, json);
    }
  });
}

std::string ConnectionJson(const Connection& connection) {
  return JsonObjectText([&](JsonObject& json) {
    const ConnectOptions& options = connection.options;
    json.Add("from", connection.from->path()).Add("to", connection.to->path());
    json.Add("part", options.part).Add("convert", options.convert);
    const std::string conversion = connection.converted ? connection.converted->conversion().text() : "";
    json.AddTextOrNull("conversion", connection.converted && conversion.empty() ? "converted" : conversion);
    json.Add("when_present", options.when_present).Add("late", options.late);
    json.Add("queue", connection.options.queue);
    json.Add("on_full", OnFullNames()[static_cast<std::size_t>(connection.options.on_full)]);
    json.Add("pull", connection.options.pull);
  });
}

}  // namespace runnel::internal
