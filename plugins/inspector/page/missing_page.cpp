// In the place of the page where it cannot be bundled: says so, and how to cure it.

#include "plugins/inspector/page/inspector_page.h"

namespace runnel {

namespace {

constexpr std::string_view kPage = R"(<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><title>Runnel</title><meta name="color-scheme" content="light dark">
<style>body { font: 16px/1.5 sans-serif; max-width: 40em; margin: 4em auto; padding: 0 1em }</style>
</head>
<body>
<h1>The inspector runs, but its page was left out</h1>
<p>This Runnel was built where there was no <code>npm</code>, which puts the page together.
Install it, then configure and build anew:</p>
<pre>sudo apt-get install --no-install-recommends npm
cmake --preset release &amp;&amp; ninja -C &lt;build folder&gt; runnel_program</pre>
<p>Everything else works: viewers that speak <code>foxglove.websocket.v1</code> or
<code>runnel.inspector.v1</code> can connect here, and <code>runnel ls</code>, <code>echo</code>,
<code>set</code> and the like reach the application from a terminal.</p>
</body>
</html>
)";

}  // namespace

const std::vector<WebResource>& InspectorPage() {
  static const std::vector<WebResource> files = {{"/", "text/html; charset=utf-8", kPage}};
  return files;
}

}  // namespace runnel
