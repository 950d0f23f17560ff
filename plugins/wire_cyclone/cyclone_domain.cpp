#include "plugins/wire_cyclone/cyclone_domain.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <openssl/bio.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include "core/base/characters.h"
#include "plugins/wire/reach_filter.h"

namespace runnel {

namespace {

// A process has one domain of a number: those of several applications find it here.
struct Domains {
  std::mutex mutex;
  std::map<std::uint32_t, std::weak_ptr<CycloneDomain>> all;
  std::string said;  // by Cyclone, the last
  using Hearing = std::function<void(const std::string&)>;
  std::vector<const Hearing*> hearings;
};

Domains& AllDomains() {
  static Domains domains;
  return domains;
}

std::string TextOf(const dds_log_data_t& data) {
  std::string text(data.message, data.size);
  if (const auto code = text.rfind("(code: "); code != std::string::npos) text.erase(code);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

// Warnings are of many things; these are of somebody's keys.
bool IsRefusal(const dds_log_data_t& data, const std::string& text) {
  return (data.priority & (DDS_LC_WARNING | DDS_LC_ERROR)) != 0 &&
         (text.find("handshake") != std::string::npos || text.find("ermission") != std::string::npos);
}

// What it says goes to nobody's terminal; the last is told with an error.
void Hear(void*, const dds_log_data_t* data) {
  CallBack([&] {
    const std::string text = TextOf(*data);
    const std::lock_guard lock(AllDomains().mutex);
    if (IsRefusal(*data, text)) {
      for (const auto* const each : AllDomains().hearings) (*each)(text);
    }
    if ((data->priority & (DDS_LC_FATAL | DDS_LC_ERROR | DDS_LC_CONFIG)) != 0) AllDomains().said = text;
  });
}

std::string PeersText(const WireMemberOptions& options) {
  std::string text;
  const auto add = [&](const std::string& address) { text += "<Peer Address=\"" + EscapedMarkup(address) + "\"/>"; };
  // Each of its ports is asked, again and again: only where not all can be asked at once.
  if (options.reach == WireReach::kMachine || !options.has_multicast) add("127.0.0.1");
  for (const std::string& peer : options.peers) add(peer);
  return text.empty() ? "" : "<Peers>" + text + "</Peers>";
}

std::string InterfacesText(const WireMemberOptions& options) {
  if (options.reach == WireReach::kLoopback) {
    return std::string("<Interfaces><NetworkInterface name=\"lo\" multicast=\"") +
           (options.has_multicast ? "true" : "false") + "\"/></Interfaces>";
  }
  if (options.interface.empty()) return {};
  const bool is_address = options.interface.find_first_not_of("0123456789.") == std::string::npos;
  return std::string("<Interfaces><NetworkInterface ") + (is_address ? "address" : "name") + "=\"" +
         EscapedMarkup(options.interface) + "\"/></Interfaces>";
}

// Where the plugins of the library are that is loaded: beside it, or in a folder of their own there, as in Debian.
Result<std::filesystem::path> FindPlugin(const std::string& name) {
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_participant), &library) == 0) {
    return Error{.message = "Cyclone DDS cannot be found"};
  }
  std::error_code failed;
  const auto folder = std::filesystem::canonical(library.dli_fname, failed).parent_path();
  const std::string file = "libdds_security_" + name + ".so";
  if (auto here = folder / file; std::filesystem::exists(here, failed)) return here;
  for (const auto& each : std::filesystem::directory_iterator(folder, failed)) {
    if (!each.path().filename().string().starts_with("libddsc")) continue;
    if (auto there = each.path() / file; std::filesystem::exists(there, failed)) return there;
  }
  return Error{.message = "this Cyclone DDS knows no keys, as it has come without " + file,
               .hint = "choose the other engine: <network engine=\"fast\">"};
}

int TellNoPassword(char*, int, int, void*) { return 0; }  // instead of asking at the terminal

// Cyclone DDS takes a key of somebody else's and meets nobody then. What cannot be read it tells itself.
Result<void> CheckKey(const WireSecurity& security) {
  const auto open = [](const std::string& file) {
    return std::unique_ptr<BIO, decltype(&BIO_free)>(BIO_new_file(file.c_str(), "r"), BIO_free);
  };
  const auto certificate_file = open(security.certificate);
  const auto key_file = open(security.key);
  if (certificate_file == nullptr || key_file == nullptr) return {};
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(
      PEM_read_bio_X509(certificate_file.get(), nullptr, TellNoPassword, nullptr), X509_free);
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(
      PEM_read_bio_PrivateKey(key_file.get(), nullptr, TellNoPassword, nullptr), EVP_PKEY_free);
  if (certificate == nullptr || key == nullptr || X509_check_private_key(certificate.get(), key.get()) == 1) return {};
  return Error{.message = "the key " + security.key + " is not that of the certificate " + security.certificate,
               .hint = "'runnel keys' makes both"};
}

}  // namespace

std::shared_ptr<void> HearRefusals(std::function<void(const std::string&)> hear) {
  std::shared_ptr<const Domains::Hearing> hearing(new Domains::Hearing(std::move(hear)),
                                                  [](const Domains::Hearing* ends) {
                                                    {
                                                      const std::lock_guard lock(AllDomains().mutex);
                                                      std::erase(AllDomains().hearings, ends);
                                                    }
                                                    delete ends;
                                                  });
  const std::lock_guard lock(AllDomains().mutex);
  AllDomains().hearings.push_back(hearing.get());
  return std::const_pointer_cast<Domains::Hearing>(hearing);
}

Error CycloneError(const std::string& what, dds_return_t code) {
  const std::lock_guard lock(AllDomains().mutex);
  const std::string said = std::exchange(AllDomains().said, {});
  return {.message = what + ": " + dds_strretcode(code) + (said.empty() ? "" : " (" + said + ")")};
}

// Buffers of 4 MB, and large datagrams where none gets lost: with its defaults half of all images are lost. Participants have
// indices, so that those who cannot be asked all at once are asked one by one.
std::string CycloneConfiguration(const WireMemberOptions& options) {
  const char* const multicast = !options.has_multicast                 ? "false"
                                : options.reach == WireReach::kMachine ? "false"
                                                                       : "true";
  constexpr std::uint32_t kHeaders = 200;  // of a fragment, with those of keys
  const std::uint32_t datagram = LargestDatagram(options);
  return "<Domain Id=\"any\"><General>" + InterfacesText(options) + "<AllowMulticast>" + multicast +
         "</AllowMulticast><MaxMessageSize>" + std::to_string(datagram) + "B</MaxMessageSize><FragmentSize>" +
         std::to_string(datagram - kHeaders) +
         "B</FragmentSize></General>"
         "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>119</MaxAutoParticipantIndex>"
         "<SPDPInterval>500ms</SPDPInterval><LeaseDuration>" +
         std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(options.lease).count()) +
         "ms</LeaseDuration>" + PeersText(options) +
         "</Discovery><Internal><GenerateKeyhash>true</GenerateKeyhash><SocketReceiveBufferSize "
         "max=\"4MB\"/><SocketSendBufferSize max=\"4MB\"/>" +
         (HasBoundedReach(options) ? "<ControlTopic><Deaf>true</Deaf></ControlTopic>" : "") + "</Internal></Domain>";
}

Result<std::shared_ptr<CycloneDomain>> CycloneDomain::Join(const WireMemberOptions& options) {
  static std::mutex joining;
  const std::lock_guard one(joining);
  if (!options.interface.empty()) {
    if (const auto is_there = AddressOfInterface(options.interface); !is_there) return is_there.error();
  }
  std::string configuration = CycloneConfiguration(options);
  if (options.security) configuration += "<!-- with keys -->";
  {
    const std::lock_guard lock(AllDomains().mutex);
    AllDomains().said.clear();
    if (const auto known = AllDomains().all[options.domain].lock()) {
      if (known->configuration_ == configuration) return known;
      return Error{
          .message = "domain " + std::to_string(options.domain) +
                     " is used in this process already, with another reach, other peers, or with keys and without",
          .hint = "choose another domain, or say the same"};
    }
  }
  dds_set_log_sink(Hear, nullptr);
  dds_entity_t domain = 0;
  const auto kept =
      KeepWithinReach(options, [&] { domain = dds_create_domain(options.domain, configuration.c_str()); });
  if (domain < 0) return CycloneError("domain " + std::to_string(options.domain) + " cannot be joined", domain);
  const std::shared_ptr<CycloneDomain> made(new CycloneDomain(domain, std::move(configuration)));
  if (!kept) return kept.error();
  // Until now it has been deaf.
  if (HasBoundedReach(options)) (void)dds_domain_set_deafmute(domain, false, false, DDS_INFINITY);
  const std::lock_guard lock(AllDomains().mutex);
  AllDomains().all[options.domain] = made;
  return made;
}

Result<void> SetSecurity(dds_qos_t& qos, const WireSecurity& security) {
  const auto set = [&](const std::string& name, const std::string& value) {
    dds_qset_prop(&qos, ("dds.sec." + name).c_str(), value.c_str());
  };
  const auto set_plugin = [&](const std::string& of, const std::string& name, const std::string& file) -> Result<void> {
    const auto plugin = FindPlugin(file);
    if (!plugin) return plugin.error();
    set(of + ".library.path", plugin->string());
    set(of + ".library.init", "init_" + name);
    set(of + ".library.finalize", "finalize_" + name);
    return {};
  };
  if (const auto right = CheckKey(security); !right) return right;
  if (const auto there = set_plugin("auth", "authentication", "auth"); !there) return there;
  if (const auto there = set_plugin("access", "access_control", "ac"); !there) return there;
  if (const auto there = set_plugin("crypto", "crypto", "crypto"); !there) return there;
  const auto set_file = [&](const std::string& name, const std::string& file) { set(name, "file:" + file); };
  set_file("auth.identity_ca", security.identity_ca);
  set_file("auth.identity_certificate", security.certificate);
  set_file("auth.private_key", security.key);
  set_file("access.permissions_ca", security.permissions_ca);
  set_file("access.governance", security.governance);
  set_file("access.permissions", security.permissions);
  return {};
}

}  // namespace runnel
