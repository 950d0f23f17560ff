#include "tests/core/plugin/plugins/idle.h"

void RunnelTestFunctionThatIsNowhere();

RUNNEL_PLUGIN(missing_symbol, registry) { RunnelTestFunctionThatIsNowhere(); }
