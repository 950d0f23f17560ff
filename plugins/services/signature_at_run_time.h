#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/port/port.h"
#include "plugins/services/service_signature.h"

namespace runnel {

/// What a service takes and gives, by descriptions.
struct SignatureTypes {
  const TypeInfo* reply = nullptr;  ///< nullptr: nothing but that it has been done
  std::vector<const TypeInfo*> arguments = {};
};

/// "service bool(double)": what the type of the ports by which such services are connected is called.
[[nodiscard]] std::string LinkName(const SignatureTypes& types);

/// Such a signature, and the type of its ports.
struct FoundSignature {
  const TypeInfo* link;
  const ServiceSignature* signature;
};
/// That of modules in C++ which have been made, so that they can be connected; else one is made, always the same for the
/// same types. Errors: a type whose values only a module can make. Any thread; locks.
[[nodiscard]] Result<FoundSignature> SignatureAtRunTime(const SignatureTypes& types);

/// The two ends of such connections.
[[nodiscard]] std::unique_ptr<Port> MakeLinkOutput(const TypeInfo& link, FrameworkElement& group, std::string name,
                                                   OutputOptions options);
[[nodiscard]] std::unique_ptr<Port> MakeLinkInput(const TypeInfo& link, FrameworkElement& group, std::string name,
                                                  InputOptions options);

/// Whose address the port publishes, or reads; nullptr: none. Inside an epoch guard.
[[nodiscard]] ServiceEndpoint* EndpointAt(const Port& port);

}  // namespace runnel
