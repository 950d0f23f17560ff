// Shows an application to browsers (the inspector) and to whatever speaks Foxglove's protocol, if options or file
// (`<inspector>`) ask for it.

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "core/base/file_descriptor.h"
#include "core/base/result.h"
#include "core/plugin/plugin_entry.h"
#include "plugins/application/application.h"
#include "plugins/control/control_folder.h"
#include "plugins/foxglove/foxglove.h"
#include "plugins/inspector/inspector.h"
#include "plugins/inspector/page/inspector_page.h"
#include "plugins/inspector/xml_inspector_tag.h"
#include "plugins/web_server/access_tokens.h"
#include "plugins/web_server/web_server.h"

namespace runnel {

namespace {

/// A token in a file that only this user can read, for as long as this lives.
class KeptToken {
 public:
  explicit KeptToken(std::filesystem::path file) : file_(std::move(file)) {}
  ~KeptToken() { unlink(file_.c_str()); }
  KeptToken(const KeptToken&) = delete;
  KeptToken& operator=(const KeptToken&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

 private:
  const std::filesystem::path file_;
};

// In the folder of the sockets by which this user's applications are reached (plugins/control). Errors: it cannot be
// written there.
Result<std::unique_ptr<KeptToken>> KeepToken(const std::string& token, std::uint16_t port) {
  const std::filesystem::path folder = ControlFolder();
  if (const auto made = MakeControlFolder(folder); !made) return made.error();
  const std::filesystem::path file = folder / ("inspector-" + std::to_string(port) + ".token");
  unlink(file.c_str());  // of a process that has not ended in order
  const FileDescriptor made(open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  const std::string text = token + "\n";
  const bool is_written =
      made.is_open() && write(made.number(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (is_written) return std::make_unique<KeptToken>(file);
  return Error{.message = std::string("the token cannot be written: ") + std::strerror(errno),
               .position = {file.string()},
               .hint = "give one, in a file: --inspect-token-file=FILE"};
}

constexpr const char* kTokenVariable = "RUNNEL_INSPECT_TOKEN";

struct ViewerOptions {
  bool is_wanted = false;   // also if the application file does not say so
  bool is_refused = false;  // whatever the file says
  bool is_held = false;     // after the run, until Ctrl-C
  // "[ADDRESS:]PORT"; "": what the file says, or else port 8765 of this machine, or any that is free.
  std::string place = {};
  std::vector<std::string> origins = {};  // of pages of other places that may connect
  std::vector<std::string> names = {};    // by which browsers may call it
  // All but where it is; what is not said there is as the file, or for tokens the environment, says.
  InspectorPlace said = {};
};

struct ViewerRequest {
  InspectorPlace place;
  bool is_exact = false;  // no other port will do
};

// Where the viewers shall be; nothing if none are wanted. Errors: the place is none.
Result<std::optional<ViewerRequest>> RequestOf(const ViewerOptions& options, const FrameworkElement& application) {
  const auto in_file = InspectorPlaceOf(application);
  if (options.is_refused || (!in_file && !options.is_wanted)) return std::optional<ViewerRequest>();
  ViewerRequest request{in_file.value_or(InspectorPlace{})};
  if (!options.place.empty()) {
    const auto place = ParseInspectorPlace(options.place);
    if (!place) return place.error();
    request.place.address = place->address;
    request.place.port = place->port;
    request.is_exact = true;
  }
  // What is said last counts: the command line, or else the environment, or else the file.
  const InspectorPlace& said = options.said;
  InspectorPlace& place = request.place;
  const char* const environment = std::getenv(kTokenVariable);
  if (!said.token.empty() || !said.token_file.empty()) {
    place.token = said.token;
    place.token_file = said.token_file;
  } else if (environment != nullptr && *environment != '\0') {
    place.token = environment;
    place.token_file.clear();
  }
  if (!said.certificate.empty()) {
    place.certificate = said.certificate;
    place.key.clear();  // the file's belongs to the file's
  }
  if (!said.key.empty()) place.key = said.key;
  place.is_for_all_users |= said.is_for_all_users;
  place.is_insecure |= said.is_insecure;
  place.is_read_only |= said.is_read_only;
  return std::optional(request);
}

Result<std::unique_ptr<WebServer>> StartServer(const ViewerRequest& request, const ViewerOptions& asked,
                                               const std::vector<WebProtocol>& protocols, Diagnostics& diagnostics) {
  const auto& resources = InspectorPage();
  auto tokens = TokensOf(request.place);
  if (!tokens) return tokens.error();
  WebServerOptions options{.address = request.place.address,
                           .port = request.place.port,
                           .certificate_file = request.place.certificate,
                           .key_file = request.place.key,
                           .is_insecure = request.place.is_insecure,
                           .tokens = std::move(*tokens),
                           .is_for_all_users = request.place.is_for_all_users,
                           .origins = asked.origins,
                           .host_names = asked.names};
  auto server = WebServer::Start(options, resources, protocols);
  if (server || request.is_exact || options.port == 0) return server;
  Error notice = server.error();
  options.port = 0;
  server = WebServer::Start(options, resources, protocols);
  if (!server) return server;
  notice.hint = "the inspector takes " + std::to_string((*server)->port());
  diagnostics.AddWarning(notice);
  return server;
}

class Viewers final : public ApplicationExtension {
 public:
  explicit Viewers(ViewerOptions options) : options_(std::move(options)) {}

  Result<void> Begin(Application& application, Diagnostics& diagnostics) override {
    const auto request = RequestOf(options_, application.element());
    if (!request) return request.error();
    if (!*request) return {};
    const bool is_read_only = (*request)->place.is_read_only;
    inspector_ = std::make_unique<Inspector>(application.service(), application.scheduler(),
                                             InspectorOptions{.application = application.name(),
                                                              .file = application.file(),
                                                              .version = Application::Version(),
                                                              .is_read_only = is_read_only});
    auto web = StartServer(**request, options_,
                           {inspector_->Protocol(), FoxgloveProtocol({.service = application.service(),
                                                                      .name = application.name(),
                                                                      .version = Application::Version(),
                                                                      .is_read_only = is_read_only})},
                           diagnostics);
    if (!web) return web.error().WithContext("the inspector cannot be started");
    web_ = std::move(*web);
    return TellToken((*request)->place.token.size() + (*request)->place.token_file.size() > 0);
  }

  std::string StartText() const override {
    return web_ == nullptr ? "" : "inspector: " + web_->url() + token_text_ + "\n";
  }
  void OnEnd(const std::string& verdict) override {
    if (inspector_ != nullptr) inspector_->NoteEnd(verdict);
  }
  bool IsHeld() const override { return options_.is_held; }
  void End() noexcept override {
    web_.reset();
    inspector_.reset();
    kept_token_.reset();
  }

 private:
  // A token that was made is shown to who sits at the terminal. What is written elsewhere is a log, which others read.
  Result<void> TellToken(bool is_given) {
    const std::string& made = web_->made_token();
    if (is_given) token_text_ = "  (and #token=…)";
    if (made.empty()) return {};
    if (isatty(STDOUT_FILENO) != 0) {
      token_text_ = "#token=" + made;
      return {};
    }
    auto kept = KeepToken(made, web_->port());
    if (!kept) return kept.error();
    kept_token_ = std::move(*kept);
    token_text_ = "  (and #token=…, which is in " + kept_token_->file().string() + ")";
    return {};
  }

  const ViewerOptions options_;
  std::string token_text_;  // what follows the address where people read it
  std::unique_ptr<KeptToken> kept_token_;
  std::unique_ptr<Inspector> inspector_;
  std::unique_ptr<WebServer> web_;  // uses the inspector
};

Result<Extensions> MakeViewers(const ExtensionArguments& arguments) {
  ViewerOptions options{.is_wanted = !arguments.values.empty(),
                        .is_refused = arguments.Has("no-inspect"),
                        .is_held = arguments.Has("hold"),
                        .place = arguments.Find("inspect"),
                        .origins = arguments.All("inspect-origin"),
                        .names = arguments.All("inspect-name"),
                        .said = {.token = arguments.Find("inspect-token"),
                                 .token_file = arguments.Find("inspect-token-file"),
                                 .is_for_all_users = arguments.Has("inspect-all-users"),
                                 .certificate = arguments.Find("inspect-certificate"),
                                 .key = arguments.Find("inspect-key"),
                                 .is_insecure = arguments.Has("inspect-insecure"),
                                 .is_read_only = arguments.Has("inspect-read-only")}};
  if (options.is_held && options.is_refused) {
    return Error{.message = "--hold is for viewers, and --no-inspect refuses them"};
  }
  if (!options.place.empty()) {
    if (const auto place = ParseInspectorPlace(options.place); !place) return place.error();
  }
  if (arguments.Has("inspect-token")) {
    if (const auto good = ParseAccessTokens(options.said.token); !good) return good.error();
  }
  return Extensions{std::make_shared<Viewers>(std::move(options))};
}

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(viewers, registry) {
  if (auto* const tags = registry.Find<runnel::XmlTagRegistry>()) runnel::AddInspectorTag(*tags);
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add(runnel::MakeViewers);
  }
}
