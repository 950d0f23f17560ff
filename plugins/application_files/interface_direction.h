#pragma once

#include "plugins/application_files/path_use.h"

namespace runnel {

/// Whether `port`, as the `end` of a connection with `other`, is used as its direction says; true for
/// ports that are no interface ports.
[[nodiscard]] bool IsRightWay(const Port& port, PathKind end, const Port& other);

/// Whether an interface port is used as its direction says: an input receives outside of its group
/// and sends inside, an output the other way round. `other` is the far end of the connection.
/// Reports what is wrong, once for each port; nothing if `port` is no interface port.
void CheckInterfaceDirection(const Port& port, const PathUse& use, PathKind end, const Port& other,
                             BuildContext& context);

}  // namespace runnel
