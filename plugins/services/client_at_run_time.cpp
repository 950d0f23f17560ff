#include "plugins/services/client_at_run_time.h"

#include <utility>

#include "core/element/framework_element.h"

namespace runnel {

namespace {

FoundSignature Found(const SignatureTypes& types) {
  const auto found = SignatureAtRunTime(types);
  if (!found) throw ElementError(found.error());
  return *found;
}

}  // namespace

ClientAtRunTime::ClientAtRunTime(FrameworkElement& group, const std::string& name, const SignatureTypes& types,
                                 const ClientOptions& options, CalledBack called_back)
    : ClientAtRunTime(group, name, Found(types), options, std::move(called_back)) {}

ClientAtRunTime::ClientAtRunTime(FrameworkElement& group, const std::string& name, FoundSignature found,
                                 const ClientOptions& options, CalledBack called_back)
    : ClientBase(options, found.signature->MakeSlots(options.calls)),
      called_back_(std::move(called_back)),
      form_(found.signature->MakeForm(options.arguments)),
      port_(MakeLinkInput(*found.link, group, name, {.description = options.description, .required = options.required})) {
  Open(*port_);
  port_->Annotate<ClientForm>(std::make_unique<ClientForm>(form_));
}

ClientAtRunTime::~ClientAtRunTime() { Close(); }

}  // namespace runnel
