#include "plugins/behaviours/xml_behaviour_words.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "core/base/files.h"
#include "core/element/file_notes.h"
#include "core/element/runtime.h"
#include "plugins/application/application_checks.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/behaviours/behaviour_group.h"
#include "plugins/behaviours/promela.h"

namespace runnel {

namespace {

/// A property as the file has it, kept with the element that its tag stands in.
struct WantedProperty {
  NetworkProperty::Kind kind;
  std::vector<std::string> active;
  std::vector<std::string> others;
  SourcePosition position;
};
struct WantedProperties final : Annotation {
  std::vector<WantedProperty> all;
};

// The paths of the behaviours that the attribute names; what is none is reported.
std::vector<std::string> BehavioursIn(const TagUse& use, std::string_view name) {
  std::vector<std::string> paths;
  const XmlAttribute* const attribute = use.Find(name);
  if (attribute == nullptr) return paths;
  for (const PathUse& path : PathsIn(*attribute, use.parent)) {
    const FrameworkElement* const element = SearchElement(path, use.context);
    if (element == nullptr) continue;
    const Behaviour* behaviour = dynamic_cast<const Behaviour*>(element);
    if (behaviour == nullptr) behaviour = CharacteristicOf(*element);
    if (behaviour != nullptr) {
      paths.push_back(behaviour->path());
    } else {
      use.Report({.message = element->path() + " is no behaviour"}, attribute->value_position);
    }
  }
  return paths;
}

template <NetworkProperty::Kind kKind>
FrameworkElement* NoteProperty(const TagUse& use) {
  use.context.Defer(BuildStage::kChecks, [use] {
    constexpr const char* kOthers = kKind == NetworkProperty::Kind::kNever ? "inactive" : "after";
    WantedProperty wanted{kKind, BehavioursIn(use, "active"), BehavioursIn(use, kOthers), use.xml.position()};
    use.parent.FindOrAnnotate<WantedProperties>().all.push_back(std::move(wanted));
  });
  return &use.parent;
}

void AddTags(XmlTagRegistry& tags) {
  const AttributeRule active{.name = "active",
                             .kind = AttributeKind::kPathList,
                             .required = true,
                             .summary = "behaviours, all at once",
                             .names_element = true};
  tags.AddTag({.name = "never",
               .summary = "which behaviours are never active at once; runnel check has Spin look whether it can be",
               .parents = {"application", "group"},
               .attributes = {active,
                              {.name = "inactive",
                               .kind = AttributeKind::kPathList,
                               .summary = "only counts while none of these is active",
                               .names_element = true}},
               .handle = NoteProperty<NetworkProperty::Kind::kNever>});
  tags.AddTag({.name = "eventually",
               .summary = "which behaviours are active some time, if each lets go again and is waited for",
               .parents = {"application", "group"},
               .attributes = {active,
                              {.name = "after",
                               .kind = AttributeKind::kPathList,
                               .summary = "each time after these were active; without, once",
                               .names_element = true}},
               .handle = NoteProperty<NetworkProperty::Kind::kEventually>});
  tags.AddAttribute({.tag = "group",
                     .rule = KindRule("characteristic", AttributeKind::kName,
                                      "the behaviour within that speaks for the group: to others the group is one"),
                     .handle =
                         [](const XmlAttribute& attribute, FrameworkElement& element, BuildContext& context) {
                           element.Annotate(std::make_unique<CharacteristicBehaviour>(attribute.value));
                           context.Defer(BuildStage::kChecks, [&element, &context, attribute] {
                             if (!context.IsWhole(element)) return;
                             auto checked = CheckBehaviourGroup(element, attribute.value);
                             if (!checked) context.Report(checked.error(), attribute.value_position, element);
                           });
                         },
                     .saved = [](FrameworkElement& element) -> std::string {
                       if (const Behaviour* const behaviour = CharacteristicOf(element)) return behaviour->name();
                       const auto* const said = element.FindAnnotation<CharacteristicBehaviour>();
                       return said != nullptr ? said->name : "";
                     }});
}

std::optional<std::vector<std::size_t>> PlacesOf(const BehaviourNetwork& network,
                                                 const std::vector<std::string>& paths) {
  std::vector<std::size_t> places;
  for (const std::string& path : paths) {
    const auto found = std::ranges::find(
        network.nodes, path, [](const NetworkNode& node) -> const std::string& { return node.behaviour->path(); });
    if (found == network.nodes.end()) return std::nullopt;
    places.push_back(static_cast<std::size_t>(found - network.nodes.begin()));
  }
  return places;
}

void CheckProperty(const BehaviourNetwork& network, const WantedProperty& wanted, const ApplicationCheckUse& use) {
  const auto active = PlacesOf(network, wanted.active), others = PlacesOf(network, wanted.others);
  if (!active || !others) return;  // told when it was read
  const NetworkProperty property{wanted.kind, *active, *others};
  const bool is_never = wanted.kind == NetworkProperty::Kind::kNever;
  const std::string tag = is_never ? "<never>" : "<eventually>";
  const auto verdict = CheckBySpin(network, property);
  if (!verdict) {
    use.diagnostics.AddWarning(
        {.message = tag + " " + verdict.error().message, .position = wanted.position, .hint = verdict.error().hint});
  } else if (!verdict->holds) {
    use.diagnostics.Add({.message = tag + (is_never ? " can be: " : " need not be: ") +
                                    TellCounterexample(network, verdict->counterexample),
                         .path = use.application.path(),
                         .position = wanted.position});
  }
}

void CheckNetwork(const ApplicationCheckUse& use) {
  const BehaviourNetwork network = ReadNetwork(use.application);
  if (network.nodes.empty()) return;
  for (auto* const find : {FindUnreachable, FindOscillations, FindConflicts}) {
    for (NetworkFlaw& flaw : find(network)) {
      const auto element = use.application.runtime().root().Find(flaw.path);
      use.diagnostics.Add({.message = std::move(flaw.message),
                           .path = std::move(flaw.path),
                           .position = element ? FindSourcePlace(**element) : SourcePosition{},
                           .hint = std::move(flaw.hint)});
    }
  }
  if (!use.model_file.empty()) {
    auto written = ReplaceFile(use.model_file, PromelaText(network, nullptr));
    if (!written) use.diagnostics.Add(written.error());
  }
  use.application.Visit([&](FrameworkElement& element) {
    const auto* const properties = element.FindAnnotation<WantedProperties>();
    if (properties == nullptr) return;
    for (const WantedProperty& each : properties->all) CheckProperty(network, each, use);
  });
}

}  // namespace

void AddBehaviourWords(PluginRegistry& registry) {
  if (auto* const tags = registry.Find<XmlTagRegistry>()) AddTags(*tags);
  if (auto* const checks = registry.Find<ApplicationChecks>()) checks->Add(CheckNetwork);
}

}  // namespace runnel
