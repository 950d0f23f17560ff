#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugins/application/application_extension.h"
#include "plugins/inspector/inspector.h"
#include "plugins/web_server/web_server.h"

namespace runnel {

struct ViewerOptions {
  bool is_wanted = false;   ///< also if the application file does not say so
  bool is_refused = false;  ///< whatever the file says
  /// "[ADDRESS:]PORT"; "": what the file says, or else port 8765 of this machine, or any that is free.
  std::string place = {};
  std::string token = {};                 ///< "": the file's, or see WebServerOptions
  std::vector<std::string> origins = {};  ///< of pages of other places that may connect
  bool is_read_only = false;
};

/// Shows an application to browsers (the inspector) and to whatever speaks Foxglove's protocol, if options or file
/// (`<inspector>`) ask for it.
///
///     .extensions = {std::make_shared<Viewers>(ViewerOptions{.is_wanted = true})}
///
/// Errors: of loading: a place that is none, or that cannot be had.
class Viewers final : public ApplicationExtension {
 public:
  explicit Viewers(ViewerOptions options = {}) : options_(std::move(options)) {}

  /// What to open in a browser; "" if nobody asked for it.
  [[nodiscard]] std::string url() const { return web_ != nullptr ? web_->url() : ""; }

  void AddWords(XmlTagRegistry& tags) override;
  Result<void> Begin(Application& application, Diagnostics& diagnostics) override;
  void OnEnd(const std::string& verdict) override;
  void End() noexcept override;

 private:
  const ViewerOptions options_;
  std::unique_ptr<Inspector> inspector_;
  std::unique_ptr<WebServer> web_;  // uses the inspector
};

}  // namespace runnel
