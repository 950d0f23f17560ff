#pragma once

// One module on its own, in a test, with GoogleTest. Library: runnel::testing, which runnel_test() brings.

#include "plugins/testing/fault_injection.h"  // the n-th allocation or call fails
#include "plugins/testing/guards.h"           // AllocationGuard: in a test of anything
#include "plugins/testing/matchers.h"         // HasPublished, PublishesWithin, FaultSays, KeepsRealTime
#include "plugins/testing/module_rig.h"       // ModuleRig
