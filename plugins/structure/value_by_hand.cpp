#include "plugins/structure/value_by_hand.h"

#include <utility>

#include "core/port/port_stop.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "core/types/value_copy.h"

namespace runnel {

namespace {

Error At(const Port& port, std::string message) {
  return {.message = std::move(message), .path = port.path()};
}

}  // namespace

Result<AnyValue> ValueOf(const Port& port, const std::string& text) {
  const TypeInfo& type = port.type();
  if (!type.is_transparent()) {
    return At(port, "values of type " + type.name() + " have no text format");
  }
  const std::shared_ptr<void> value = type.Make();
  if (!value) return At(port, "only a module can make values of type " + type.name());
  if (auto set = SetFromText(type, text, value.get()); !set) {
    Error error = set.error();
    if (error.path.empty()) error.path = port.path();
    return error;
  }
  return AnyValue(type, value);
}

Result<void> PublishByHand(Port& port, const void* value, Port::Setter setter) {
  const auto fill = [&](void* to) -> Result<void> {
    if (CopyValue(port.type(), value, to)) return {};
    return At(port, "the value does not fit into a buffer of the port");
  };
  return port.PublishByHand(fill, setter);
}

AnyValue SafeValueBehind(const Port& port) {
  for (const Port* sink : port.Sinks()) {
    for (const internal::PassedStop& each : internal::PassedStops(*sink)) {
      if (each.stop->robot() != nullptr) return each.safe_value;
    }
  }
  return {};
}

Result<AnyValue> SafeValueOf(const Port& port) {
  if (const auto stop = port.stop()) return stop->safe_value();
  if (const AnyValue& value = port.limits().default_value; value && !IsVelocity(port.type(), port.unit())) return value;
  if (AnyValue behind = SafeValueBehind(port); behind && &behind.type() == &port.type()) return behind;
  const std::shared_ptr<const void> value = port.type().Make();
  if (!value) return At(port, "only a module can make values of type " + port.type().name());
  return AnyValue(port.type(), value);
}

}  // namespace runnel
