#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/element/runtime.h"
#include "plugins/network/offer_list.h"
#include "plugins/network/xml_network_words.h"
#include "plugins/ros_messages/names.h"
#include "plugins/structure/change.h"

namespace runnel {

namespace {

using Offers = std::vector<OfferOptions>;

// Of a change that takes another one back.
struct OffersBefore {
  Offers now;
  Offers before;
};

NetworkElement* FindNetwork(Runtime& runtime) {
  for (const FrameworkElement* const each : runtime.root().children()) {
    if (NetworkElement* const network = NetworkElement::FindIn(*each)) return network;
  }
  return nullptr;
}

bool Removes(const ExtensionChange& change) {
  return std::ranges::any_of(change.settings,
                             [](const Setting& each) { return each.parameter == "remove" && each.value == "true"; });
}

std::string SaidIn(const ExtensionChange& change, std::string_view name) {
  const auto found = std::ranges::find(change.settings, name, &Setting::parameter);
  return found != change.settings.end() ? found->value : "";
}

// `ports`: the attributes that are no options, but words of the change.
Result<void> CheckWords(const ExtensionChange& change, std::vector<AttributeRule> rules,
                        const std::vector<std::string>& ports) {
  std::erase_if(rules, [&](const AttributeRule& each) { return std::ranges::count(ports, each.name) > 0; });
  rules.push_back({.name = "remove", .kind = AttributeKind::kChoice, .choices = {"false", "true"}});
  for (const Setting& each : change.settings) {
    if (each.parameter == "stop") {  // of before
      return Error{.message = "'" + change.verb + " … stop' is called otherwise now", .hint = "'remove'"};
    }
    const auto rule = std::ranges::find(rules, each.parameter, &AttributeRule::name);
    if (rule == rules.end()) {
      return Error{.message = "'" + change.verb + "' has no option '" + each.parameter + "'",
                   .hint = NearestNameHint(each.parameter, NamesOf(rules, &AttributeRule::name))};
    }
    auto checked = CheckAttributeValue(*rule, each.value);
    if (checked && rule->name == "topic") checked = CheckRosName(each.value);
    if (!checked) return checked.error().WithContext(each.parameter);
  }
  return {};
}

// Sets what is offered to what `next` makes of it.
ExtensionStep StepOf(NetworkElement& network, const ExtensionChange& change,
                     std::function<Result<Offers>(const Offers&)> next) {
  auto before = std::make_shared<std::optional<Offers>>();
  ExtensionStep step;
  step.apply = [&network, next, before]() -> Result<void> {
    auto offers = next(network.options().offers);
    if (!offers) return offers.error();
    *before = network.options().offers;
    network.set_offers(std::move(*offers));
    return {};
  };
  step.undo = [&network, before] {
    if (*before) network.set_offers(std::move(**before));
    before->reset();
  };
  step.inverse = [&network, next, change]() -> ChangeSet {
    const Offers& now = network.options().offers;
    const auto then = next(now);
    if (!then) return {};  // the step is not applied
    ExtensionChange back{change.verb, change.words, change.settings,
                         std::make_shared<OffersBefore>(OffersBefore{*then, now})};
    const bool removes = Removes(change);
    std::erase_if(back.settings, [](const Setting& each) { return each.parameter == "remove"; });
    if (!removes) back.settings.push_back({"remove", "true"});
    return {std::move(back)};
  };
  return step;
}

Result<ExtensionStep> Back(NetworkElement& network, const ExtensionChange& change) {
  const auto state = std::static_pointer_cast<const OffersBefore>(change.state);
  return StepOf(network, change, [state, path = network.path()](const Offers& offers) -> Result<Offers> {
    if (offers == state->now) return state->before;
    return Error{.message = "what is offered has been changed meanwhile", .path = path};
  });
}

Result<ExtensionStep> CheckOffer(NetworkElement& network, const ExtensionChange& change,
                                 const ExtensionChanges::Find& find) {
  if (change.state) return Back(network, change);
  if (change.words.size() != 1) return Error{.message = "'offer' names one port"};
  if (auto checked = CheckWords(change, OfferRules(), {"ports", "port", "service"}); !checked) return checked.error();
  const auto port = find(change.words[0], PathKind::kOutput);
  if (!port) return port.error();
  const std::string path = (*port)->path();
  if (!(*port)->is_proxy() && (*port)->direction() == Port::Direction::kInput) {
    return Error{.message = "is an input, which has no values of its own", .path = path, .hint = "offer what feeds it"};
  }
  const OfferOptions offer = OfferSaid([&](const char* name) { return SaidIn(change, name); });
  const bool removes = Removes(change);
  if (!removes) {
    if (const auto is_own = network.CheckIsOwn(**port); !is_own) return is_own.error();
    const auto form =
        ValueForm::Make((*port)->type(), offer.as, offer.frame, offer.child_frame, network.options().messages.get());
    if (!form) return form.error();
    if (const auto fits = CheckTopicType(network, **port, offer, **form); !fits) return fits.error();
    if (const auto wrong = WhatIsWrong(offer)) return *wrong;
  }
  return StepOf(network, change, [&network, path, offer, removes](const Offers& offers) -> Result<Offers> {
    OfferList list{network.options().member.name, offers};
    const auto changed = removes ? list.Remove(path, offer.topic) : list.Add(path, offer);
    return changed ? Result<Offers>(std::move(list.offers)) : changed.error();
  });
}

Result<ExtensionStep> CheckTake(NetworkElement& network, const ExtensionChange& change,
                                const ExtensionChanges::Find& find) {
  if (change.words.size() != 2) return Error{.message = "'take' names a topic and an input"};
  if (auto checked = CheckWords(change, TakeRules(), {"topic", "to", "service"}); !checked) return checked.error();
  const std::string& topic = change.words[0];
  if (const auto checked = CheckRosName(topic); !checked) return checked.error();
  const auto to = find(change.words[1], PathKind::kInput);
  if (!to) return to.error();
  ExtensionStep step;
  if (Removes(change)) {
    std::vector<std::string> topics;
    for (const NetworkElement::Take& each : network.takes()) {
      topics.push_back(each.options.topic);
      if (each.options.topic == topic) step.changes.push_back(DisconnectPorts{each.output->path(), change.words[1]});
    }
    if (!step.changes.empty()) return step;
    return Error{.message = "'" + topic + "' is not taken", .hint = NearestNameHint(topic, topics)};
  }
  TakeOptions take = TakeSaid([&](const char* name) { return SaidIn(change, name); });
  take.topic = topic;
  take.is_live = take.is_live || network.options().is_live;
  take.position = network.options().position;
  const auto output = network.AddTake(take, (*to)->type());
  if (!output) return output.error();
  step.changes.push_back(ConnectPorts{(*output)->path(), change.words[1]});
  return step;
}

void Rename(Offered& offered, std::vector<OfferRenaming>& known, const std::string& network, const std::string& from,
            const std::string& to) {
  constexpr std::size_t kMostKnown = 100;
  const auto undone = std::ranges::find_if(
      known, [&](const OfferRenaming& each) { return each.from == to && each.to == from && each.after == offered; });
  if (undone != known.end()) {
    offered = std::move(undone->before);
    known.erase(undone);
    return;
  }
  const Offered before = offered;
  OfferList list{network, std::move(offered.ports)};
  list.Rename(from, to);
  offered.ports = std::move(list.offers);
  for (ServiceOfferOptions& each : offered.services) MovePath(each.port, from, to);
  if (known.size() == kMostKnown) known.erase(known.begin());
  known.push_back({from, to, before, offered});
}

ExtensionStep StepOfRenaming(NetworkElement& network, const std::string& from, const std::string& to) {
  using State = std::pair<Offered, std::vector<OfferRenaming>>;
  const auto set = [&network](State state) {
    network.set_offers(std::move(state.first.ports));
    network.set_services(std::move(state.first.services));
    network.renamings() = std::move(state.second);
  };
  auto before = std::make_shared<std::optional<State>>();
  ExtensionStep step;
  step.apply = [&network, from, to, before, set]() -> Result<void> {
    State state{{network.options().offers, network.options().services}, network.renamings()};
    *before = state;
    Rename(state.first, state.second, network.options().member.name, from, to);
    set(std::move(state));
    network.NoteRenamed(from);
    return {};
  };
  step.undo = [before, set] {
    if (*before) set(std::move(**before));
    before->reset();
  };
  return step;
}

}  // namespace

void AddNetworkChanges(Runtime& runtime) {
  auto changes = std::make_unique<ExtensionChanges>();
  const auto add = [&](const char* verb, auto check) {
    changes->verbs[verb] = [&runtime, check](const ExtensionChange& change,
                                             const ExtensionChanges::Find& find) -> Result<ExtensionStep> {
      NetworkElement* const network = FindNetwork(runtime);
      if (network == nullptr) return Error{.message = "the application with the network has gone"};
      return check(*network, change, find);
    };
  };
  add("offer", CheckOffer);
  add("take", CheckTake);
  changes->rename = [&runtime](const std::string& from, const std::string& to) {
    NetworkElement* const network = FindNetwork(runtime);
    return network != nullptr ? StepOfRenaming(*network, from, to) : ExtensionStep();
  };
  changes->is_offered = [&runtime](const Port& port) {
    NetworkElement* const network = FindNetwork(runtime);
    return network != nullptr && std::ranges::count(network->options().offers, port.path(), &OfferOptions::port) > 0;
  };
  runtime.root().Annotate(std::move(changes));
}

}  // namespace runnel
