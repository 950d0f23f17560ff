#pragma once

#include "core/plugin/module_registry.h"

namespace runnel {

/// Types become known when something uses them first. This makes one module of each kind, away from
/// any application, and throws it away again: afterwards the types of all their ports are known,
/// and the built-in ones.
///
/// Threads: starts one for the time of the call, since the caller holds the lock of its own
/// runtime.
void MakePortTypesKnown(const ModuleRegistry& modules);

}  // namespace runnel
