#pragma once

#include <string>

#include "core/base/result.h"
#include "core/port/port.h"
#include "core/types/any_value.h"

namespace runnel {

/// Values that somebody other than a module has readers of a port find (Port::PublishByHand()): a person, a rule of the
/// file. All under the structure lock.

/// A value of the port's type, from its text format; what the text leaves out keeps the type's defaults.
Result<AnyValue> ValueOf(const Port& port, const std::string& text);
/// The safe value of what something moves by if a value comes here: this port, or one behind an interface port; none: nothing
/// moves by it.
AnyValue SafeValueBehind(const Port& port);
/// Whether there is one: quicker.
bool MovesSomething(const Port& port);
/// What readers shall find when nobody says anything better: the safe value of a port that drives, else the port's
/// default (InputLimits), else that of what it feeds, else what its type begins with, a command of no motion.
Result<AnyValue> SafeValueOf(const Port& port);
/// `value`: an object of the port's type.
Result<void> PublishByHand(Port& port, const void* value, Port::Setter setter = Port::Setter::kPerson);

}  // namespace runnel
