#pragma once

#include "core/port/port.h"

namespace runnel::signal {

/// Fills a value by hand.
template <typename T>
Port::Fill Filled(const T& wanted) {
  return [wanted](void* value) -> Result<void> { return *static_cast<T*>(value) = wanted, Result<void>(); };
}

}  // namespace runnel::signal
