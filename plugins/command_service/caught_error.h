#pragma once

#include "core/base/error.h"

namespace runnel {

/// The exception that is being handled as an error: that of an ElementError, else what
/// DescribeException() says. Precondition: within a catch block. Without memory it says that.
[[nodiscard]] Error CaughtError() noexcept;

}  // namespace runnel
