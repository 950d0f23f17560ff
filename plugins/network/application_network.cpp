// Attaches the network to an application that has a <network>.

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/element/element_path.h"
#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/plugin/plugin_entry.h"
#include "plugins/application/application.h"
#include "plugins/application/application_extension.h"
#include "plugins/command_service/command_service.h"
#include "plugins/command_service/extension_texts.h"
#include "plugins/control/element_listing.h"
#include "plugins/network/application_commands.h"
#include "plugins/network/application_health.h"
#include "plugins/network/network_engines.h"
#include "plugins/network/network_link.h"
#include "plugins/network/xml_network_words.h"
#include "plugins/wire_shared_memory/shared_memory_wire.h"

namespace runnel {

namespace {

class ApplicationNetwork final : public ApplicationExtension {
 public:
  Result<void> Prepare(FrameworkElement& application, SchedulerOptions& options) override {
    is_simulated_ = options.clock == SchedulerOptions::ClockKind::kSimulated;
    NetworkElement* const element = NetworkElement::FindIn(application);
    if (element == nullptr) return {};
    const bool follows_clock = element->options().ros && element->options().ros->follows_clock;
    if (follows_clock && (!options.follows_outside_clock || !options.clock_port.empty())) {
      return Error{.message = "the time of /clock is that of nobody here",
                   .position = element->options().position,
                   .hint = "say <clock type=\"outside\"/>, or leave clock=\"follow\" out"};
    }
    if (!is_simulated_ || follows_clock) return {};  // whoever follows others has no runs that can be repeated
    element->set_simulated();
    const auto refuse = [](const std::string& path, const SourcePosition& position) {
      return Error{.message = "with simulated time, values that come when they like make runs that cannot be repeated",
                   .path = path,
                   .position = position,
                   .hint = "say live=\"true\" if that is meant"};
    };
    for (const auto& each : element->takes()) {
      if (!each.options.is_live) return refuse(each.output->path(), each.options.position);
    }
    const LateConnections* const late = LateConnections::FindIn(application.runtime());
    const auto is_distant = [&](const LateConnection& each) {
      return IsDistantPath(each.from) && IsAtOrBelow(each.to, application.path());
    };
    if (!element->options().is_live && late != nullptr && std::ranges::any_of(late->all(), is_distant)) {
      return refuse(element->path(), element->options().position);
    }
    for (const auto& each : element->service_takes()) {
      if (!each.options.is_live) return refuse(each.output->path(), each.options.position);
    }
    return {};
  }

  Result<void> Begin(Application& application, Diagnostics&) override {
    NetworkElement* const element = NetworkElement::FindIn(application.element());
    if (element == nullptr) return {};
    if (std::ranges::any_of(application.extensions(), [](const auto& each) { return each->Replays(); })) {
      LeaveOut(application);
      if (!element->options().ros || !element->options().ros->follows_clock) return {};
      return Error{.message = "the time of /clock is not told in a replay, which leaves the network out",
                   .position = element->options().position,
                   .hint = "replay it with <clock type=\"simulated\" speed=\"1\"/>, and without clock=\"follow\""};
    }
    engine_ = FindEngine(application, *element);
    if (engine_ == nullptr)
      return Error{.message = "the network has no engine", .position = element->options().position};
    FrameworkElement& group = application.element();
    RosHooks hooks{
        .set_parameters = [&application](const auto& changes) { return SetParameters(application, changes); },
        .health = ApplicationHealth(group, application.scheduler(), application.supervisor(), application.log()),
        .set_time = [&application](Time time) { return application.SetTime(time); },
        .clock_lead = [&application] { return application.scheduler().pace().outside_lead(); },
        .is_stop_kept = application.service().application().hooks.is_stop_kept,
        .check_stop = [&application] { return CheckThatAllStops(application.runtime(), &application.scheduler()); }};
    auto link = NetworkLink::Start(
        group, *element, *engine_, is_simulated_, [&group] { return ListElements(group, {}); }, std::move(hooks));
    if (!link) return link.error();
    link_ = std::move(*link);
    commands_ = ApplicationCommands::Start(*link_, *element, application.service());
    application_ = &application;
    const std::lock_guard lock(application.runtime().structure_mutex());
    auto texts = std::make_unique<ExtensionTexts>();
    texts->texts["network"] = [this](const std::string&, auto&) -> Result<std::optional<std::string>> {
      return std::optional(link_->Text());
    };
    texts->texts["network_picture"] = [this](const std::string&, auto&) -> Result<std::optional<std::string>> {
      return std::optional(link_->Picture());
    };
    texts->texts["command"] = [this](const std::string& change, auto& asking) {
      return commands_->Ask(change, asking);
    };
    texts->texts["structure"] = [this](const std::string& path, auto&) { return link_->StructureOf(path); };
    group.Annotate(std::move(texts));
    return {};
  }

  [[nodiscard]] std::string StartText() const override {
    return is_left_out_ ? std::string("the network is left out: ") + kLeftOut + "\n" : "";
  }

  void End() noexcept override {
    if (application_ == nullptr) return;
    {
      const std::lock_guard lock(application_->runtime().structure_mutex());
      if (auto* const texts = application_->element().FindAnnotation<ExtensionTexts>()) texts->texts.clear();
    }
    commands_.reset();
    link_.reset();
  }

 private:
  // Commands would drive who is there now, and what it sends would come between what is played.
  void LeaveOut(Application& application) {
    is_left_out_ = true;
    application_ = &application;
    const std::lock_guard lock(application.runtime().structure_mutex());
    auto texts = std::make_unique<ExtensionTexts>();
    for (const char* const name : {"network", "command", "structure"}) {
      texts->texts[name] = [](const std::string&, auto&) -> Result<std::optional<std::string>> {
        return Error{.message = "the network is left out", .hint = kLeftOut};
      };
    }
    application.element().Annotate(std::move(texts));
  }
  // Between two cycles, as any change: it can be undone.
  static Result<void> SetParameters(Application& application, const std::vector<ParameterChange>& wanted) {
    ChangeSet changes;
    for (const ParameterChange& each : wanted) changes.push_back(SetParameter{.path = each.path, .value = each.value});
    return application.Apply(changes).ToResult();
  }
  static std::shared_ptr<WireEngine> FindEngine(Application& application, const NetworkElement& element) {
    const std::lock_guard lock(application.runtime().structure_mutex());  // as for all plugins
    auto found = FindWireEngine(element.options().engine, application.plugins());
    return found ? MakeSharedMemoryWire(std::move(*found)) : nullptr;
  }

  static constexpr const char* kLeftOut = "values come from a recording";
  bool is_simulated_ = false;
  bool is_left_out_ = false;
  Application* application_ = nullptr;
  std::shared_ptr<WireEngine> engine_;
  std::unique_ptr<NetworkLink> link_;
  std::unique_ptr<ApplicationCommands> commands_;
};

}  // namespace

}  // namespace runnel

RUNNEL_PLUGIN(network, registry) {
  if (auto* const tags = registry.Find<runnel::XmlTagRegistry>()) {
    runnel::AddNetworkTags(*tags);
    runnel::AddSecurityTag(*tags);
  }
  if (auto* const extensions = registry.Find<runnel::ExtensionRegistry>()) {
    extensions->Add([](const runnel::ExtensionArguments&) -> runnel::Result<runnel::Extensions> {
      return runnel::Extensions{std::make_shared<runnel::ApplicationNetwork>()};
    });
  }
}
