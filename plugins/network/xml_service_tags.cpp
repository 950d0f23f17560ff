#include <array>
#include <fstream>
#include <string>
#include <utility>

#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/network/network_element.h"
#include "plugins/network/xml_network_words.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/ros_messages/message_library.h"

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
  const auto others = {"topic", "frame", "child_frame", "qos", "sending", "rate", "strength", "measured"};
  if (!CheckNameIn(use, "service") || !SaysNothingElse(use, others)) return true;
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
  const bool is_right =
      CheckNameIn(use, "service") && SaysNothingElse(use, {"topic", "field", "qos", "stamp", "exclusive"});
  NetworkElement& network = *NetworkElement::FindIn(use.parent);
  ServiceTakeOptions take{.service = use.Get("service").value,
                          .as = use.xml.TextOr("as"),
                          .is_live = use.xml.TextOr("live") == "true" || network.options().is_live,
                          .position = use.xml.position()};
  use.context.Defer(BuildStage::kConnections, [use, is_right, &network, take = std::move(take)] {
    for (const PathUse& to_use : PathsIn(use.Get("to"), use.parent)) {
      Port* const to =
          is_right ? SearchPort(to_use, PathKind::kInput, use.context) : FindPort(to_use, PathKind::kInput);
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

namespace {

struct KeyFile {
  const char* attribute;
  const char* name;  // in a folder of SROS 2
  std::string WireSecurity::*file;
  const char* summary;
};

constexpr std::array<KeyFile, 6> kFiles = {
    {{"identity_ca", "identity_ca.cert.pem", &WireSecurity::identity_ca, "certificate of who signs certificates"},
     {"certificate", "cert.pem", &WireSecurity::certificate, "the application's certificate"},
     {"key", "key.pem", &WireSecurity::key, "its private key, which nobody else has"},
     {"permissions_ca", "permissions_ca.cert.pem", &WireSecurity::permissions_ca,
      "certificate of who signs the two files below"},
     {"governance", "governance.p7s", &WireSecurity::governance, "what is encrypted, signed"},
     {"permissions", "permissions.p7s", &WireSecurity::permissions,
      "what the application may write and read, signed"}}};

FrameworkElement* HandleSecurity(const TagUse& use) {
  NetworkElement& network = *NetworkElement::FindIn(use.parent);
  if (network.options().member.security) {
    use.Report({.message = "<security> stands there already"}, use.xml.position());
    return &use.parent;
  }
  const std::filesystem::path beside = use.context.FolderOf(use.xml.position());
  const XmlAttribute* const folder = use.Find("keys");
  WireSecurity security;
  for (const KeyFile& each : kFiles) {
    const XmlAttribute* const said = use.Find(each.attribute);
    if (said == nullptr && folder == nullptr) {
      use.Report(
          {.message = std::string("<security> does not say where the ") + each.attribute + " is",
           .hint = std::string("keys=\"FOLDER\", which 'runnel keys' makes, or ") + each.attribute + "=\"FILE\""},
          use.xml.position());
      continue;
    }
    const auto file = (said != nullptr ? beside / said->value : beside / folder->value / each.name).lexically_normal();
    if (!std::ifstream(file)) {
      use.Report({.message = std::string("the ") + each.attribute + " cannot be read: " + file.string(),
                  .hint = "'runnel keys FOLDER " + network.options().member.name + "' makes one of each"},
                 (said != nullptr ? said : folder)->value_position);
      continue;
    }
    security.*each.file = std::filesystem::absolute(file).string();
  }
  network.set_security(std::move(security));
  return &use.parent;
}

}  // namespace

void AddSecurityTag(XmlTagRegistry& tags) {
  std::vector<AttributeRule> attributes = {
      {.name = "keys",
       .summary = "folder with identity_ca.cert.pem, cert.pem, key.pem, permissions_ca.cert.pem, "
                  "governance.p7s and permissions.p7s, as runnel keys and SROS 2 make it"}};
  for (const KeyFile& each : kFiles) attributes.push_back({.name = each.attribute, .summary = each.summary});
  tags.AddTag({.name = "security",
               .summary = "lets in those only whose keys are trusted, and encrypts what is sent",
               .parents = {"network"},
               .attributes = std::move(attributes),
               .handle = HandleSecurity});
}

}  // namespace runnel
