#pragma once

#include <vector>

#include "plugins/genom_description/component.h"

namespace runnel::genom {

/// The codels of its component that must not run while this one does: those that use what it uses, where one of the
/// two writes, and that can run at the same time.
[[nodiscard]] std::vector<const Codel*> ConflictingCodels(const Codel& codel);
/// The attributes that must not be set or read meanwhile.
[[nodiscard]] std::vector<const Service*> ConflictingServices(const Codel& codel);
/// The codels that must not run while a service's parameters are set or read.
[[nodiscard]] std::vector<const Codel*> ConflictingCodels(const Service& service);

/// Whether a service interrupts another of its component.
[[nodiscard]] bool Interrupts(const Service& service, const Service& other);

}  // namespace runnel::genom
