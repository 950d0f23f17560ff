#include "plugins/wire_cyclone/cyclone_security.h"

#include <filesystem>

#include <dlfcn.h>

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
