#include "plugins/inspector/xml_inspector_tag.h"

#include <memory>

#include "core/base/number_text.h"
#include "core/element/annotation.h"
#include "plugins/application_files/build_context.h"
#include "plugins/web_server/access_rules.h"

namespace runnel {

Result<std::vector<AccessToken>> TokensOf(const InspectorPlace& place) {
  std::vector<AccessToken> tokens;
  if (!place.token.empty()) {
    auto said = ParseAccessTokens(place.token);
    if (!said) return said.error();
    tokens = std::move(*said);
  }
  if (!place.token_file.empty()) {
    auto read = ReadAccessTokens(place.token_file);
    if (!read) return read.error();
    tokens.insert(tokens.end(), read->begin(), read->end());
  }
  return tokens;
}

Result<std::uint16_t> ParseNetworkPort(std::string_view text) {
  if (const auto port = NumberIn<std::uint16_t>(text)) return *port;
  return Error{.message = "'" + std::string(text) + "' is not a port",
               .hint = "write a number from 1 to 65535, or 0 for any that is free"};
}

Result<InspectorPlace> ParseInspectorPlace(std::string_view text) {
  InspectorPlace place;
  // The last one: addresses of IPv6 have colons of their own, and stand in brackets.
  const std::size_t colon = text.rfind(':');
  const auto port = ParseNetworkPort(colon == std::string_view::npos ? text : text.substr(colon + 1));
  if (!port) return port.error();
  place.port = *port;
  if (colon == std::string_view::npos) return place;
  std::string_view address = text.substr(0, colon);
  if (address.starts_with('[') && address.ends_with(']')) {
    address = address.substr(1, address.size() - 2);
  }
  place.address = address == "localhost" ? "127.0.0.1" : std::string(address);
  if (const auto known = IsLoopback(place.address); !known) return known.error();
  return place;
}

namespace {

struct InspectorChoice final : Annotation {
  InspectorPlace place;
  int line = 0;
};

template <typename T>
void Check(const Result<T>& read, const TagUse& use, const XmlAttribute& attribute) {
  if (read) return;
  use.Report({.message = read.error().message, .hint = read.error().hint}, attribute.value_position);
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
    Check(ParseAccessTokens(place.token), use, *token);
  }
  if (const XmlAttribute* const file = use.Find("token_file")) place.token_file = file->value;
  if (const XmlAttribute* const file = use.Find("certificate")) place.certificate = file->value;
  if (const XmlAttribute* const file = use.Find("key")) place.key = file->value;
  place.is_insecure = use.xml.TextOr("insecure") == "true";
  place.is_for_all_users = use.xml.TextOr("all_users") == "true";
  place.is_read_only = use.xml.TextOr("read_only") == "true";
}

FrameworkElement* ChooseInspector(const TagUse& use) {
  if (const auto* first = use.parent.FindAnnotation<InspectorChoice>()) {
    use.Report(
        {.message = "there is an inspector already", .hint = "the first is in line " + std::to_string(first->line)},
        use.xml.position());
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
                    {"token", place.token, place.token.empty()},
                    {"token_file", place.token_file, place.token_file.empty()},
                    {"all_users", place.is_for_all_users ? "true" : "false", !place.is_for_all_users},
                    {"certificate", place.certificate, place.certificate.empty()},
                    {"key", place.key, place.key.empty()},
                    {"insecure", place.is_insecure ? "true" : "false", !place.is_insecure}}}};
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
               .attributes = {KindRule("port", AttributeKind::kCount, "8765 by default; 0 for any that is free"),
                              {.name = "address",
                               .summary = "of this machine; 127.0.0.1 by default, which only it "
                                          "reaches; others need a certificate and a token"},
                              WordRule("read_only", {"true", "false"}, "true: viewers look, and change nothing"),
                              {.name = "token",
                               .summary = "what viewers must show; without, one is made if the address is reached by "
                                          "others; ROLE:TOKEN for more than one: look, drive (publish, pause), change"},
                              {.name = "token_file", .summary = "with more of them, which not everybody may read"},
                              WordRule("all_users", {"true", "false"},
                                       "true: every user of this machine may, without a token, and "
                                       "not only who has started the program"),
                              {.name = "certificate", .summary = "file (PEM) by which it encrypts: https, wss"},
                              {.name = "key", .summary = "file (PEM) with its key, if that is in another one"},
                              WordRule("insecure", {"true", "false"},
                                       "true: other addresses are served without a certificate, "
                                       "where nobody else listens or a proxy encrypts")},
               .handle = ChooseInspector,
               .saved = SavedInspector});
}

}  // namespace runnel
