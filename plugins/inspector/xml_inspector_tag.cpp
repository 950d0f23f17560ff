#include "plugins/inspector/xml_inspector_tag.h"

#include <memory>
#include <string>
#include <vector>

#include "core/element/annotation.h"
#include "plugins/application_files/build_context.h"
#include "plugins/web_server/access_rules.h"

namespace runnel {

namespace {

struct InspectorChoice final : Annotation {
  InspectorPlace place;
  int line = 0;
};

template <typename T>
void Check(const Result<T>& read, const TagUse& use, const XmlAttribute& attribute) {
  if (read) return;
  use.context.Report({.message = read.error().message, .hint = read.error().hint},
                     attribute.value_position, use.parent);
}

void ReadPlace(const TagUse& use, InspectorPlace& place) {
  if (const XmlAttribute* const port = use.Find("port")) {
    const auto number = ParseNetworkPort(port->value);
    if (number) place.port = *number;
    Check(number, use, *port);
  }
  if (const XmlAttribute* const address = use.Find("address")) {
    place.address = address->value;
    Check(IsLoopback(place.address), use, *address);
  }
  if (const XmlAttribute* const token = use.Find("token")) {
    place.token = token->value;
    Check(CheckToken(place.token), use, *token);
  }
  const XmlAttribute* const read_only = use.Find("read_only");
  place.is_read_only = read_only != nullptr && read_only->value == "true";
}

FrameworkElement* ChooseInspector(const TagUse& use) {
  if (const auto* first = use.parent.FindAnnotation<InspectorChoice>()) {
    use.context.Report({.message = "there is an inspector already",
                        .hint = "the first is in line " + std::to_string(first->line)},
                       use.xml.position(), use.parent);
    return &use.parent;
  }
  auto& choice = use.parent.Annotate(std::make_unique<InspectorChoice>());
  choice.line = use.xml.position().line;
  ReadPlace(use, choice.place);
  return &use.parent;
}

std::vector<SavedTag> SavedInspector(const FrameworkElement& application) {
  const auto* const choice = application.FindAnnotation<InspectorChoice>();
  if (choice == nullptr) return {};
  const InspectorPlace& place = choice->place;
  const InspectorPlace normal;
  return {SavedTag{{{"port", std::to_string(place.port), place.port == normal.port},
                    {"address", place.address, place.address == normal.address},
                    {"read_only", place.is_read_only ? "true" : "false", !place.is_read_only},
                    {"token", place.token, place.token.empty()}}}};
}

}  // namespace

std::optional<InspectorPlace> InspectorPlaceOf(const FrameworkElement& application) {
  const auto* const choice = application.FindAnnotation<InspectorChoice>();
  return choice != nullptr ? std::optional(choice->place) : std::nullopt;
}

void AddInspectorTag(XmlTagRegistry& tags) {
  tags.AddTag({.name = "inspector",
               .summary = "shows the running application in a browser",
               .parents = {"application"},
               .attributes = {{.name = "port",
                               .kind = AttributeKind::kCount,
                               .summary = "8765 by default; 0 for any that is free"},
                              {.name = "address",
                               .summary = "of this machine; 127.0.0.1 by default, which only it "
                                          "reaches; others need a token"},
                              {.name = "read_only",
                               .kind = AttributeKind::kChoice,
                               .summary = "true: viewers look, and change nothing",
                               .choices = {"true", "false"}},
                              {.name = "token",
                               .summary = "what viewers must show; without, one is made if the "
                                          "address is reached by others"}},
               .handle = ChooseInspector,
               .saved = SavedInspector});
}

}  // namespace runnel
