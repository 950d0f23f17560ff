#pragma once

#include <string>

#include "core/base/result.h"
#include "plugins/control/control_client.h"
#include "plugins/control/request.h"

namespace runnel::program {

/// Has a running application record, shows on a terminal how it goes, and says what there is when
/// it has ended, also by Ctrl-C. Returns the exit code. Errors: the connection is lost.
Result<int> AskToRecord(ControlClient& client, const Request& request);

}  // namespace runnel::program
