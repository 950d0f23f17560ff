#pragma once

// What modules exchange: the types of Runnel's own modules, described. Library: runnel::runnel.

#include "modules/types/contact.h"
#include "modules/types/drawing.h"
#include "modules/types/hit_and_leave_points.h"
#include "modules/types/image.h"
#include "modules/types/infrared_ranges.h"
#include "modules/types/path.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"
#include "modules/types/range_scan.h"
#include "modules/types/surroundings.h"
#include "modules/types/wheel_speeds.h"
#include "modules/types/world_map.h"
