#pragma once

#include "plugins/genom_description/component.h"

namespace runnel::genom {

/// The constant as a value of the type; nullopt if it is none, which has then been told.
[[nodiscard]] std::optional<Constant> Cast(const Constant& value, const Type* type, Place place, Problems& problems);

/// Whether the default fits the type, at all depths; tells what does not. Fills in the constants as the type has them, and
/// the member or index that each part stands for.
bool CheckInitializer(Initializer& initial, Type* type, Problems& problems);

}  // namespace runnel::genom
