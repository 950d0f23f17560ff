#pragma once

// What modules are made of. Library: runnel::runnel.

#include "core/element/runtime.h"              // Runtime: the clock, for threads of one's own
#include "core/module/group.h"                 // Group: composites in C++
#include "core/module/kept_state.h"            // KeepState(): what a module leaves to the one in its place
#include "core/module/module.h"                // Module
#include "core/module/sense_control_module.h"  // SenseControlModule: for hardware
#include "core/port/cycle.h"                   // OwnCycle: publishing from a thread of one's own
#include "core/port/input.h"                   // Input
#include "core/port/output.h"                  // Output
#include "core/types/type_of.h"                // Describe(): types of one's own in ports
#include "plugins/parameters/file_path.h"      // FilePath: parameters that name files
#include "plugins/parameters/parameter.h"      // Parameter
