#pragma once

#include "plugins/genom_description/component.h"

namespace runnel::genom {

/// Of what properties are said.
enum class PropertyOwner { kComponent, kInterface, kPort, kTask, kAttribute, kFunction, kActivity };

[[nodiscard]] std::string_view NameOf(PropertyOwner owner);
[[nodiscard]] PropertyOwner OwnerOf(ServiceKind kind);

/// Adds what is said of the owner to what has been said before: some properties add up, of some the first holds, and
/// some may be said only once. Tells what may not be said.
bool AddProperty(Properties& properties, Property property, PropertyOwner owner, Problems& problems);

}  // namespace runnel::genom
