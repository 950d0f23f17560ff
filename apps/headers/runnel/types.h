#pragma once

// What modules exchange: the types of Runnel's own modules, described. Library: runnel::runnel.

#include "modules/types/drawing.h"
#include "modules/types/measurements.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
