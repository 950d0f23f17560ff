#pragma once

#include <dds/dds.h>

#include "core/base/result.h"
#include "plugins/wire/wire.h"

namespace runnel {

/// Has a participant of these policies know others by their certificates, and encrypt. Errors: the library has come without
/// its plugins for that.
Result<void> SetSecurity(dds_qos_t& qos, const WireSecurity& security);

}  // namespace runnel
