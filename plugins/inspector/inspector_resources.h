#pragma once

#include <vector>

#include "plugins/web_server/web_resource.h"

namespace runnel {

/// The files for browsers, "/" among them: the page, or, where it could not be bundled when this was
/// built, one that says so and how to cure it. The bytes live as long as the program.
[[nodiscard]] std::vector<WebResource> InspectorResources();

}  // namespace runnel
