// The outputs that stand for services elsewhere.

#include <algorithm>
#include <utility>

#include "core/types/type_info.h"
#include "plugins/network/network_element.h"
#include "plugins/ros_messages/message_library.h"

namespace runnel {

namespace {

// Of the client itself, or of the first that an interface port passes on to.
std::shared_ptr<const CallForm> FormOf(const Port& to) {
  if (const auto* const form = to.FindAnnotation<ClientForm>()) return form->form;
  for (const Port* const each : to.Sinks()) {
    if (const auto* const form = each->FindAnnotation<ClientForm>()) return form->form;
  }
  return nullptr;
}

}  // namespace

void NetworkElement::AddServiceOffer(ServiceOfferOptions offer) {
  options_.services.push_back(std::move(offer));
  if (on_change_) on_change_();
}

Result<Port*> NetworkElement::AddServiceTake(const ServiceTakeOptions& take, const Port& client) {
  const auto known =
      std::ranges::find(service_takes_, take.service, [](const ServiceTake& each) { return each.options.service; });
  if (known != service_takes_.end()) {
    if (&known->output->type() == &client.type()) return known->output;
    return Error{.message = "'" + take.service + "' is taken as " + known->output->type().name() + " already, and cannot be " +
                            client.type().name() + " as well",
                 .path = known->path};
  }
  auto calls = FormOf(client);
  if (calls == nullptr) {
    return Error{.message = "calls no service", .path = client.path(), .hint = "values of a topic: <take topic=\"…\" to=\"…\"/>"};
  }
  const MessageLibrary& messages = options_.messages != nullptr ? *options_.messages : MessageLibrary::Standard();
  auto form = ServiceForm::Make(calls->arguments(), calls->reply(), take.as, messages);
  if (!form) return form.error();
  const auto output = MakeOutput(take.service, client.type());
  if (!output) return output.error();
  const auto service = std::make_shared<DistantService>(std::move(calls), std::move(*form));
  DistantService::PublishBy(**output, service);
  service_takes_.push_back({take, *output, (*output)->path(), service});
  if (on_change_) on_change_();
  return *output;
}

}  // namespace runnel
