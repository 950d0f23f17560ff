#include "plugins/network/xml_network_words.h"

#include <string>
#include <utility>

#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

// Whether what is said of topics is not said of this service; else that is reported.
bool SaysNothingElse(const TagUse& use, std::initializer_list<const char*> others) {
  for (const char* const other : others) {
    const XmlAttribute* const said = use.Find(other);
    if (said == nullptr) continue;
    use.Report({.message = std::string(other) + " is said of topics, and this is a service"}, said->position);
    return false;
  }
  return true;
}

bool CheckName(const TagUse& use) {
  const XmlAttribute* const name = use.Find("service");
  if (name == nullptr) return true;
  const auto checked = CheckRosName(name->value);
  if (!checked) use.Report(checked.error(), name->value_position);
  return checked.has_value();
}

const SourcePosition& PlaceOfType(const TagUse& use, const char* otherwise) {
  const XmlAttribute* const as = use.Find("as");
  return (as != nullptr ? *as : use.Get(otherwise)).value_position;
}

}  // namespace

bool OfferService(const TagUse& use, const Port& port) {
  const XmlAttribute* const name = use.Find("service");
  const auto* const callable = port.FindAnnotation<Callable>();
  if (callable == nullptr) {
    if (name == nullptr) return false;
    use.Report({.message = port.path() + " is no service", .hint = "values of a port: <offer port=\"…\" topic=\"…\"/>"},
               name->position);
    return true;
  }
  if (!CheckName(use) || !SaysNothingElse(use, {"topic", "frame", "child_frame", "qos", "sending", "rate", "strength"})) return true;
  NetworkElement& network = *NetworkElement::FindIn(use.parent);
  const NetworkOptions& options = network.options();
  const MessageLibrary& messages = options.messages != nullptr ? *options.messages : MessageLibrary::Standard();
  const auto form = ServiceForm::Make(callable->arguments(), callable->reply(), use.xml.TextOr("as"), messages);
  if (!form) {
    use.Report(form.error(), PlaceOfType(use, "port"));
    return true;
  }
  network.AddServiceOffer({.port = port.path(),
                           .service = name != nullptr ? name->value : TopicOfPort(options.member.name, port.path()),
                           .as = use.xml.TextOr("as"),
                           .position = use.xml.position()});
  return true;
}

FrameworkElement* TakeService(const TagUse& use) {
  const bool is_right = CheckName(use) && SaysNothingElse(use, {"topic", "field", "qos", "stamp", "exclusive"});
  NetworkElement& network = *NetworkElement::FindIn(use.parent);
  ServiceTakeOptions take{.service = use.Get("service").value,
                          .as = use.xml.TextOr("as"),
                          .is_live = use.xml.TextOr("live") == "true" || network.options().is_live,
                          .position = use.xml.position()};
  use.context.Defer(BuildStage::kConnections, [use, is_right, &network, take = std::move(take)] {
    for (const PathUse& to_use : PathsIn(use.Get("to"), use.parent)) {
      Port* const to = is_right ? SearchPort(to_use, PathKind::kInput, use.context) : FindPort(to_use, PathKind::kInput);
      if (to == nullptr) continue;
      Error error;
      if (is_right) {
        const auto output = network.AddServiceTake(take, *to);
        const auto connected = output ? Port::Connect(**output, *to) : Result<void>(output.error());
        if (connected) continue;
        error = connected.error();
        use.Report(error, output ? to_use.position : PlaceOfType(use, "service"));
      }
      use.context.MarkUnfed(*to);
    }
  });
  return &use.parent;
}

}  // namespace runnel
