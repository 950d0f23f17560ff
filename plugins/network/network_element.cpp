#include "plugins/network/network_element.h"

#include <algorithm>
#include <utility>

#include "core/element/element_path.h"
#include "core/element/not_saved.h"
#include "core/element/runtime.h"
#include "core/paths/distant_ports.h"
#include "core/port/typed_ports.h"
#include "core/types/type_info.h"
#include "plugins/network/topic_names.h"

namespace runnel {

namespace {

/// A word of a topic that is not the last.
class TopicGroup final : public FrameworkElement {
 public:
  explicit TopicGroup(const Placement& placement) : FrameworkElement(placement, ElementKind::kGroup) {}
};

/// "//camera_box/camera/image" is what is taken of the topic "/camera_box/camera/image".
class NetworkPorts final : public DistantPorts {
 public:
  explicit NetworkPorts(NetworkElement& network) : network_(&network) {}
  void Forget(const NetworkElement& gone) noexcept {
    if (network_ == &gone) network_ = nullptr;
  }

  [[nodiscard]] Port* Find(std::string_view path) const override {
    if (network_ == nullptr) return nullptr;
    if (path.find_first_of(".[") != std::string_view::npos) return nullptr;  // a part of its values
    const auto& takes = network_->takes();
    const auto found =
        std::ranges::find(takes, TopicOfDistantPath(path), [](const auto& each) { return each.options.topic; });
    return found == takes.end() ? nullptr : found->output;
  }
  Result<Port*> Make(std::string_view path, const Port& to) override {
    if (Port* const known = Find(path)) return known;
    if (const std::size_t part = path.find_first_of(".["); part != std::string_view::npos) {
      if (Port* const whole = Find(path.substr(0, part))) return whole;
      return Error{.message = "what '" + std::string(path) + "' is a part of has a type that is not known here",
                   .hint = "connect all of it to an interface port of a group, and the part from there"};
    }
    if (network_ == nullptr) return Error{.message = "the application with the network has gone"};
    const auto made = network_->AddTake({.topic = TopicOfDistantPath(path),
                                         .keeps_stamps = true,
                                         .is_distant = true,
                                         .is_live = network_->options().is_live,
                                         .position = network_->options().position},
                                        to.type());
    if (made) (*made)->Annotate(std::make_unique<DistantPort>(std::string(path)));
    return made;
  }

 private:
  NetworkElement* network_;
};

}  // namespace

NetworkElement::NetworkElement(const Placement& placement, NetworkOptions options)
    : FrameworkElement(placement, ElementKind::kGroup), options_(std::move(options)) {
  Annotate(std::make_unique<NotSaved>());  // the tags of the file make it again
  runtime().root().Annotate<DistantPorts>(std::make_unique<NetworkPorts>(*this));
}

NetworkElement::~NetworkElement() {
  if (auto* const ports = static_cast<NetworkPorts*>(DistantPorts::FindIn(*this))) ports->Forget(*this);
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

Result<std::shared_ptr<const ValueForm>> NetworkElement::ValueFormOf(const TakeOptions& take, const TypeInfo& type) const {
  auto form = ValueForm::Make(type, take.as, {}, {}, options_.messages.get());
  if (!form) return form.error();
  if (const std::string why = (*form)->WhyNoReading(); !why.empty()) return Error{.message = why};
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
                 .hint = "say the same of it, or connect " + known.output->path()};
  }
  auto form = ValueFormOf(take, known.output->type());
  if (!form) return form.error();
  known.options = take;
  known.form = std::move(*form);
  known.output->Annotate(std::make_unique<DistantPort>(""));
  if (on_change_) on_change_();
  return {};
}

Result<Port*> NetworkElement::AddTake(const TakeOptions& take, const TypeInfo& type) {
  if (is_simulated_ && !take.is_live) {
    return Error{.message = "with simulated time, values that come when they like make runs that cannot be repeated",
                 .path = path(),
                 .hint = "say live=\"true\" of what is taken, or of <network>, if that is meant"};
  }
  const auto known = std::ranges::find(takes_, take.topic, [](const Take& each) { return each.options.topic; });
  if (known != takes_.end()) {
    if (&known->output->type() == &type) {
      const auto taken = TakeOtherwise(*known, take);
      return taken ? Result<Port*>(known->output) : taken.error();
    }
    return Error{.message = "'" + take.topic + "' is taken as " + known->output->type().name() +
                            " already, and cannot be " + type.name() + " as well",
                 .path = known->output->path()};
  }
  auto form = ValueFormOf(take, type);
  if (!form) return form.error();
  const auto made = MakeOutput(take.topic, type);
  if (!made) return made.error();
  takes_.push_back({take, *made, std::move(*form)});
  if (on_change_) on_change_();
  return *made;
}

Result<Port*> NetworkElement::MakeOutput(const std::string& name, const TypeInfo& type) {
  const TypedPorts* const typed = FindTypedPorts(type);
  FrameworkElement* group = this;
  const auto words = SplitPath(name);
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    FrameworkElement* const inner = group->FindChild(words[i]);
    group = inner != nullptr ? inner : &runtime().Create<TopicGroup>(*group, std::string(words[i]));
  }
  if (group->FindChild(words.back()) != nullptr) {
    return Error{.message = "'" + name + "' is the name of something else that is taken"};
  }
  auto output = typed == nullptr ? nullptr
                                 : typed->MakeOutput(*group, std::string(words.back()), {.description = "from the network: " + name});
  if (output == nullptr) return Error{.message = "values of type " + type.name() + " can be made by a module only"};
  Port* const made = output.get();
  runtime().Adopt(std::move(output));
  if (life_cycle() == LifeCycle::kReady) {
    if (const auto ready = runtime().MakeReady(*this); !ready) return ready.error();
  }
  return made;
}

}  // namespace runnel
