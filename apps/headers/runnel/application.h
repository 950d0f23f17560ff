#pragma once

// A running application as an object of a program. Library: runnel::application.

#include "plugins/application/application.h"  // Application
#include "plugins/application/run_report.h"   // RunReport: how a run has ended
