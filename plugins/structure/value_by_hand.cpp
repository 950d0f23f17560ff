#include "plugins/structure/value_by_hand.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/port/port_stop.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

Error At(const Port& port, std::string message) { return {.message = std::move(message), .path = port.path()}; }

bool IsInOtherUnit(const Port& a, const Port& b) {
  return !a.unit().empty() && !b.unit().empty() && a.unit() != b.unit();
}

// Of what something moves by if a value comes to the port; none of what is in another unit.
std::vector<AnyValue> SafeValuesBehind(const Port& port) {
  std::vector<AnyValue> all;
  for (const Port* sink : port.Sinks()) {
    for (const internal::PassedStop& each : internal::PassedStops(*sink)) {
      if (each.stop->robot() != nullptr) all.push_back(IsInOtherUnit(*sink, port) ? AnyValue() : each.safe_value);
    }
  }
  return all;
}

// It drives, or what comes to it has come by a port that does.
bool IsHeldByStop(const Port& port) {
  const std::vector<Port*>& before = port.incoming();
  return port.is_driving() || std::ranges::any_of(before, [](const Port* each) { return IsHeldByStop(*each); });
}

}  // namespace

Result<AnyValue> ValueOf(const Port& port, const std::string& text) {
  const TypeInfo& type = port.type();
  if (!type.is_transparent()) {
    return At(port, "values of type " + type.name() + " have no text format");
  }
  const std::shared_ptr<void> value = type.Make();
  if (!value) return At(port, "only a module can make values of type " + type.name());
  if (auto set = SetFromText(type, text, value.get()); !set) return set.error().WithPath(port.path());
  return AnyValue(type, value);
}

Result<void> PublishByHand(Port& port, const void* value, Port::Setter setter) {
  const auto fill = [&](void* to) -> Result<void> {
    if (CopyValue(port.type(), value, to)) return {};
    return At(port, "the value does not fit into a buffer of the port");
  };
  return port.PublishByHand(fill, setter);
}

bool MovesSomething(const Port& port) {
  return std::ranges::any_of(port.Sinks(), [](const Port* sink) { return IsHeldByStop(*sink); });
}

AnyValue SafeValueBehind(const Port& port) {
  const std::vector<AnyValue> all = SafeValuesBehind(port);
  const auto first = std::ranges::find_if(all, [](const AnyValue& each) { return bool(each); });
  return first != all.end() ? *first : AnyValue();
}

Result<AnyValue> SafeValueOf(const Port& port) {
  if (const auto stop = port.stop()) return stop->safe_value();
  if (const AnyValue& value = port.limits().default_value; value && !IsVelocity(port.type(), port.unit())) return value;
  std::optional<std::string> text;
  for (const AnyValue& each : SafeValuesBehind(port)) {
    const bool is_zero = IsVelocity(port.type(), port.unit());
    const bool is_another = !each || &each.type() != &port.type();
    if (is_another && !is_zero) return At(port, "moves something behind a conversion; only that has a safe value");
    if (is_another) continue;
    std::string other = ToText(each.type(), each.get());
    if (text && *text != other) return At(port, "moves several things, and their safe values differ");
    text = std::move(other);
  }
  if (text) return ValueOf(port, *text);
  const std::shared_ptr<const void> value = port.type().Make();
  if (!value) return At(port, "only a module can make values of type " + port.type().name());
  return AnyValue(port.type(), value);
}

}  // namespace runnel
