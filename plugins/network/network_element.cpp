#include "plugins/network/network_element.h"

#include <algorithm>
#include <utility>

#include "core/element/element_path.h"
#include "core/element/file_notes.h"
#include "core/element/runtime.h"
#include "core/paths/distant_ports.h"
#include "core/port/typed_ports.h"
#include "core/types/type_info.h"
#include "plugins/network/network_ports.h"
#include "plugins/ros_messages/message_library.h"

namespace runnel {

namespace {

/// A word of a topic that is not the last.
class TopicGroup final : public FrameworkElement {
 public:
  explicit TopicGroup(const Placement& placement) : FrameworkElement(placement, ElementKind::kGroup) {
    Annotate(std::make_unique<NotSaved>());
  }
};

// Of what is said about a topic a second time.
std::string HintFor(const TakeOptions& known, const TakeOptions& take, std::string otherwise) {
  if (known.field == take.field) return otherwise;
  return "of one topic one field is taken, or all of the message: 'runnel ros2 import' makes a type for that";
}

// Of the client itself, or of the first that an interface port passes on to.
std::shared_ptr<const CallForm> FormOf(const Port& to) {
  if (const auto* const form = to.FindAnnotation<ClientForm>()) return form->form;
  for (const Port* const each : to.Sinks()) {
    if (const auto* const form = each->FindAnnotation<ClientForm>()) return form->form;
  }
  return nullptr;
}

}  // namespace

NetworkElement::NetworkElement(const Placement& placement, NetworkOptions options)
    : FrameworkElement(placement, ElementKind::kGroup), options_(std::move(options)) {
  Annotate(std::make_unique<NotSaved>());  // the tags of the file make it again
  // A button elsewhere sends these, and no module here may have a port of them.
  internal::MakeTypedPortsKnown<bool>();
  internal::MakeTypedPortsKnown<double>();
  runtime().root().Annotate<DistantPorts>(std::make_unique<NetworkPorts>(*this));
}

NetworkElement::~NetworkElement() {
  if (NetworkPorts* const ports = NetworkPorts::Of(*this)) ports->End();
}

NetworkElement* NetworkElement::FindIn(const FrameworkElement& application) {
  for (FrameworkElement* const each : application.children()) {
    if (auto* const network = dynamic_cast<NetworkElement*>(each)) return network;
  }
  return nullptr;
}

void NetworkElement::AddOffer(OfferOptions offer) {
  options_.offers.push_back(std::move(offer));
  if (on_change_) on_change_();
}

void NetworkElement::set_offers(std::vector<OfferOptions> offers) {
  options_.offers = std::move(offers);
  if (on_change_) on_change_();
}

Result<void> NetworkElement::CheckIsOwn(const Port& port) const {
  if (!port.IsAtOrBelow(*this)) return {};
  const std::string& distant = DistantPathOf(port);
  return Error{.message = "comes from the network itself, where others take it, too",
               .path = distant.empty() ? port.path() : distant,
               .hint = "to pass it on, offer an output of a module or an interface port of a group that it goes to"};
}

Result<std::shared_ptr<const ValueForm>> NetworkElement::ValueFormOf(const TakeOptions& take,
                                                                     const TypeInfo& type) const {
  auto form = ValueForm::Make(type, take.as, {}, {}, options_.messages.get(), take.field);
  if (!form) return form.error();
  if (const std::string why = (*form)->codec->why_no_decoding(); !why.empty()) return Error{.message = why};
  return form;
}

Result<void> NetworkElement::TakeOtherwise(Take& known, const TakeOptions& take) {
  TakeOptions before = known.options;
  before.position = take.position;
  before.is_distant = take.is_distant;
  if (before == take) return {};
  if (!known.output->outgoing().empty()) {
    return Error{.message = "'" + take.topic + "' is taken already, in another way",
                 .path = known.output->path(),
                 .hint = HintFor(known.options, take, "say the same of it, or connect " + known.output->path())};
  }
  auto form = ValueFormOf(take, known.output->type());
  if (!form) return form.error();
  TakeOptions now = take;  // all that needs memory comes before something is another one
  known.output->Annotate(std::make_unique<DistantPort>(""));
  known.options = std::move(now);
  known.form = std::move(*form);
  if (on_change_) on_change_();
  return {};
}

Result<void> NetworkElement::CheckLiveness(const TakeOptions& take) const {
  if (!is_simulated_ || take.is_live) return {};
  return Error{.message = "with simulated time, values that come when they like make runs that cannot be repeated",
               .path = path(),
               .hint = "say live=\"true\" of what is taken, or of <network>, if that is meant"};
}

Result<Port*> NetworkElement::AddTake(const TakeOptions& take, const TypeInfo& type, const std::string& unit) {
  if (const auto live = CheckLiveness(take); !live) return live.error();
  const auto known = std::ranges::find(takes_, take.topic, [](const Take& each) { return each.options.topic; });
  if (known != takes_.end()) {
    if (&known->output->type() == &type) {
      known->is_over = false;
      const auto taken = TakeOtherwise(*known, take);
      return taken ? Result<Port*>(known->output) : taken.error();
    }
    return Error{.message = "'" + take.topic + "' is taken as " + known->output->type().name() +
                            " already, and cannot be " + type.name() + " as well",
                 .path = known->output->path(),
                 .hint = HintFor(known->options, take, "")};
  }
  auto form = ValueFormOf(take, type);
  if (!form) return form.error();
  Take taken{take, nullptr, std::move(*form)};
  takes_.reserve(takes_.size() + 1);
  const auto made = MakeOutput(take.topic, type, unit);
  if (!made) return made.error();
  taken.output = *made;
  takes_.push_back(std::move(taken));
  if (on_change_) on_change_();
  return *made;
}

// A topic may begin with all of another one, as "/image/compressed" with "/image": what were below the port of that would go
// with it.
Result<Port*> NetworkElement::MakeOutput(const std::string& name, const TypeInfo& type, const std::string& unit,
                                         const std::function<void(Port&)>& finish) {
  const TypedPorts* const typed = FindTypedPorts(type);
  FrameworkElement* group = this;
  const auto words = SplitPath(name);
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    std::string word(words[i]);
    while (dynamic_cast<const Port*>(group->FindChild(word)) != nullptr) word += '_';
    FrameworkElement* const inner = group->FindChild(word);
    group = inner != nullptr ? inner : &runtime().Create<TopicGroup>(*group, word);
  }
  std::string last(words.back());
  while (group->FindChild(last) != nullptr) last += '_';
  auto output = typed == nullptr
                    ? nullptr
                    : typed->MakeOutput(*group, last, {.description = "from the network: " + name, .unit = unit});
  if (output == nullptr) return Error{.message = "values of type " + type.name() + " can be made by a module only"};
  Port* const made = output.get();
  finish(*made);
  if (life_cycle() == LifeCycle::kReady) {
    if (const auto ready = runtime().MakeReady(*this); !ready) return ready.error();
  }
  runtime().Adopt(std::move(output));  // last: what fails before leaves no output behind
  return made;
}

void NetworkElement::GiveUp(const Port& output) {
  const auto known =
      std::ranges::find(takes_, &output, [](const Take& each) { return static_cast<const Port*>(each.output); });
  if (known == takes_.end()) return;
  known->is_over = true;
  if (on_change_) on_change_();
}

Result<UnlistedElement> NetworkElement::DropTake(Port& output) {
  output.DisconnectAll();
  auto gone = runtime().Unlist(output);
  if (gone) std::erase_if(takes_, [&](const Take& each) { return each.output == &output; });
  if (on_change_) on_change_();
  return gone;
}

void NetworkElement::AddServiceOffer(ServiceOfferOptions offer) {
  options_.services.push_back(std::move(offer));
  if (on_change_) on_change_();
}

void NetworkElement::set_services(std::vector<ServiceOfferOptions> services) {
  options_.services = std::move(services);
  if (on_change_) on_change_();
}

Result<Port*> NetworkElement::AddServiceTake(const ServiceTakeOptions& take, const Port& client) {
  const auto known =
      std::ranges::find(service_takes_, take.service, [](const ServiceTake& each) { return each.options.service; });
  if (known != service_takes_.end()) {
    if (&known->output->type() == &client.type()) return known->output;
    return Error{.message = "'" + take.service + "' is taken as " + known->output->type().name() +
                            " already, and cannot be " + client.type().name() + " as well",
                 .path = known->path};
  }
  auto calls = FormOf(client);
  if (calls == nullptr) {
    return Error{.message = "calls no service",
                 .path = client.path(),
                 .hint = "values of a topic: <take topic=\"…\" to=\"…\"/>"};
  }
  const MessageLibrary& messages = options_.messages != nullptr ? *options_.messages : MessageLibrary::Standard();
  auto form = ServiceForm::Make(calls->arguments(), calls->reply(), take.as, messages);
  if (!form) return form.error();
  ServiceTake taken{take, nullptr, {}, std::make_shared<DistantService>(std::move(calls), std::move(*form))};
  service_takes_.reserve(service_takes_.size() + 1);
  const auto output = MakeOutput(take.service, client.type(), {}, [&](Port& made) {
    DistantService::PublishBy(made, taken.service);
    taken.path = made.path();
  });
  if (!output) return output.error();
  taken.output = *output;
  service_takes_.push_back(std::move(taken));
  if (on_change_) on_change_();
  return *output;
}

}  // namespace runnel
