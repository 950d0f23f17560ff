#pragma once

#include <functional>
#include <memory>
#include <string>

#include <dds/dds.h>

#include "core/base/result.h"
#include "plugins/wire/wire.h"

namespace runnel {

/// A domain of this process, as it has been configured; those who join it alike share it.
///
/// Threads: any.
class CycloneDomain {
 public:
  /// Errors: what Cyclone says; another reach than that of somebody else in this process.
  static Result<std::shared_ptr<CycloneDomain>> Join(const WireMemberOptions& options);
  ~CycloneDomain() { (void)dds_delete(domain_); }
  CycloneDomain(const CycloneDomain&) = delete;
  CycloneDomain& operator=(const CycloneDomain&) = delete;

 private:
  CycloneDomain(dds_entity_t domain, std::string configuration)
      : domain_(domain), configuration_(std::move(configuration)) {}

  const dds_entity_t domain_;
  const std::string configuration_;
};

/// Has `hear` told why others are not let into a domain of this process, by threads of Cyclone's, until what this returns is destroyed;
/// `hear` may call none of these functions.
[[nodiscard]] std::shared_ptr<void> HearRefusals(std::function<void(const std::string&)> hear);

/// The settings that the options come to, in Cyclone's XML.
[[nodiscard]] std::string CycloneConfiguration(const WireMemberOptions& options);

/// What Cyclone calls the mistake.
[[nodiscard]] Error CycloneError(const std::string& what, dds_return_t code);

/// Has a participant of these policies know others by their certificates, and encrypt. Errors: the library has come without
/// its plugins for that.
Result<void> SetSecurity(dds_qos_t& qos, const WireSecurity& security);

}  // namespace runnel
