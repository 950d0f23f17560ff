#pragma once

// What a plugin says which modules it has with. Library: runnel::runnel.

#include "core/plugin/plugin_entry.h"  // RUNNEL_PLUGIN
