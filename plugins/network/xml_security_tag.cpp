#include "plugins/network/xml_network_tags.h"

#include <array>
#include <fstream>

#include "plugins/application_files/build_context.h"
#include "plugins/network/network_element.h"

namespace runnel {

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
     {"permissions_ca", "permissions_ca.cert.pem", &WireSecurity::permissions_ca, "certificate of who signs the two files below"},
     {"governance", "governance.p7s", &WireSecurity::governance, "what is encrypted, signed"},
     {"permissions", "permissions.p7s", &WireSecurity::permissions, "what the application may write and read, signed"}}};

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
      use.Report({.message = std::string("<security> does not say where the ") + each.attribute + " is",
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
      {.name = "keys", .summary = "folder with identity_ca.cert.pem, cert.pem, key.pem, permissions_ca.cert.pem, "
                                  "governance.p7s and permissions.p7s, as runnel keys and SROS 2 make it"}};
  for (const KeyFile& each : kFiles) attributes.push_back({.name = each.attribute, .summary = each.summary});
  tags.AddTag({.name = "security",
               .summary = "lets in those only whose keys are trusted, and encrypts what is sent",
               .parents = {"network"},
               .attributes = std::move(attributes),
               .handle = HandleSecurity});
}

}  // namespace runnel
