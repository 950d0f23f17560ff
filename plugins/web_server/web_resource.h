#pragma once

#include <string_view>

namespace runnel {

/// One file of a page, as it lies in memory. All three outlive the server.
struct WebResource {
  std::string_view path;          ///< "/", "/page.js"; only exactly this is found
  std::string_view content_type;  ///< "text/javascript; charset=utf-8"
  std::string_view content;
};

}  // namespace runnel
