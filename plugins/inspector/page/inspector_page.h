#pragma once

#include <vector>

#include "plugins/web_server/web_session.h"

namespace runnel {

/// The files of the page, for WebServer::Start(), "/" among them. If Runnel was built without npm, or
/// without a network to get npm's packages from, a page that says so and how to cure it. Any thread; the
/// bytes live as long as the program.
[[nodiscard]] const std::vector<WebResource>& InspectorPage();

}  // namespace runnel
