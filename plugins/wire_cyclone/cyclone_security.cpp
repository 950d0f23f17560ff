#include "plugins/wire_cyclone/cyclone_security.h"

#include <filesystem>
#include <memory>

#include <dlfcn.h>
#include <openssl/bio.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

namespace runnel {

namespace {

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
  const auto open = [](const std::string& file) { return std::unique_ptr<BIO, decltype(&BIO_free)>(BIO_new_file(file.c_str(), "r"), BIO_free); };
  const auto certificate_file = open(security.certificate);
  const auto key_file = open(security.key);
  if (certificate_file == nullptr || key_file == nullptr) return {};
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(PEM_read_bio_X509(certificate_file.get(), nullptr, TellNoPassword, nullptr), X509_free);
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(PEM_read_bio_PrivateKey(key_file.get(), nullptr, TellNoPassword, nullptr), EVP_PKEY_free);
  if (certificate == nullptr || key == nullptr || X509_check_private_key(certificate.get(), key.get()) == 1) return {};
  return Error{.message = "the key " + security.key + " is not that of the certificate " + security.certificate, .hint = "'runnel keys' makes both"};
}

}  // namespace

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
