#pragma once

#include <span>

#include "plugins/web_server/web_resource.h"

namespace runnel {

/// The files of the page that browsers show, "/" among them: bundled by npm when this was built, or, if
/// there was no npm, one that says so.
[[nodiscard]] std::span<const WebResource> InspectorPage();

}  // namespace runnel
