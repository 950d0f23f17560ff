// What the thread of a network does when something has changed, here or elsewhere.

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/base/erase_where.h"
#include "core/element/runtime.h"
#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/paths/path_search.h"
#include "core/types/type_info.h"
#include "plugins/network/network_link.h"
#include "plugins/network/network_ports.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

/// A port that is to be offered.
struct NetworkLink::Wanted {
  Port* port;  // under the structure lock
  std::string path;
  const TypeInfo* type;
  OfferOptions options;
};

void NetworkLink::Follow() {
  new_troubles_.clear();
  std::vector<Wanted> wanted;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    wanted = FindOffers();
  }
  for (const Wanted& each : wanted) MakeOffer(each);
  {
    const ChangeScope changes(runtime_);
    wanted = FindOffers();  // anew: the lock has been free
    // Those whose ports have gone stay, for these may come back; but not under a name that nobody offers any more, nor under
    // one of before, which a pattern may fit, too.
    const auto find = [&](const std::unique_ptr<OfferedPort>& each) {
      return std::ranges::find_if(wanted, [&](const Wanted& one) {
        return one.path == each->path() && one.options.topic == each->options().topic;
      });
    };
    EraseWhere(offered_, [&](const auto& each) {
      const bool is_there = runtime_.root().Find(each->path()).has_value();
      return find(each) == wanted.end() && (is_there || each->is_renamed() || !IsMeant(each->path(), each->options()));
    });
    for (const auto& each : offered_) {
      const auto found = find(each);
      each->Attach(found == wanted.end() ? nullptr : found->port);
      each->set_renamed(false);  // it may have been called so again meanwhile
    }
  }
  FollowDistantPorts();
  FollowTakes();
  services_.Follow(*participant_, [this](const std::string& of, const Error& error) { Trouble(of, error); });
  FollowNodes();
  TellNode();
  TellStructure();
  TellMembers();
  TellTroubles();
}

bool NetworkLink::IsMeant(const std::string& path, const OfferOptions& as) const {
  const NetworkOptions& options = element_.options();
  return std::ranges::any_of(options.offers, [&](const OfferOptions& each) {
    const std::string topic = each.topic.empty() ? TopicOfPort(options.member.name, path) : each.topic;
    if (topic != as.topic) return false;
    if (!each.port.empty()) return PlainPortPath(each.port) == PlainPortPath(path);
    const auto patterns = PortPatterns::Make(each.patterns);
    return patterns && patterns->Fit(path);
  });
}

std::vector<NetworkLink::Wanted> NetworkLink::FindOffers() {
  std::vector<Wanted> wanted;
  const auto add = [&](Port& port, const OfferOptions& offer) {
    Wanted found{&port, port.path(), &port.type(), offer};
    // What only finds it.
    found.options.patterns.clear();
    found.options.position = {};
    found.options.unit = port.unit();
    if (offer.topic.empty()) found.options.topic = TopicOfPort(element_.options().member.name, port.path());
    const auto same =
        std::ranges::find(wanted, found.options.topic, [](const Wanted& each) { return each.options.topic; });
    const bool is_meant = same != wanted.end() && !offer.topic.empty() && same->path != found.path;  // /tf, for one
    if (same == wanted.end() || is_meant) {
      wanted.push_back(std::move(found));
    } else if (same->path != found.path) {
      Trouble(found.path,
              {.message = "is not offered, as " + same->path + " is the topic " + found.options.topic + " already",
               .hint = "offer it by another topic: <offer port=\"…\" topic=\"…\"/>"});
    }
  };
  // First those that name a port: what they say of it counts, whatever pattern fits it, too.
  for (const OfferOptions& offer : element_.options().offers) {
    if (offer.port.empty()) continue;
    const auto port = PathSearch(runtime_).FindPort(offer.port, PathKind::kOutput);
    if (port && (*port)->life_cycle() != LifeCycle::kDeleted) add(**port, offer);
  }
  for (const OfferOptions& offer : element_.options().offers) {
    if (!offer.port.empty()) continue;
    const auto patterns = PortPatterns::Make(offer.patterns);
    if (!patterns) continue;  // told when the file was read
    application_.VisitAll<Port>([&](Port& port) {
      if (port.direction() != Port::Direction::kOutput || port.IsAtOrBelow(element_)) return;
      // Interface ports only pass on: only who names one wants it.
      if (port.FindAnnotation<Callable>() != nullptr) return;  // offered by name only
      const bool is_meant = port.is_proxy() ? patterns->Name(port.path()) : patterns->Fit(port.path());
      if (is_meant && port.life_cycle() != LifeCycle::kDeleted) add(port, offer);
    });
  }
  return wanted;
}

void NetworkLink::MakeOffer(const Wanted& wanted) {
  const bool is_there = std::ranges::any_of(offered_, [&](const auto& each) {
    return each->path() == wanted.path && each->options() == wanted.options && &each->type() == wanted.type;
  });
  if (is_there) return;
  auto form = ValueForm::Make(*wanted.type, wanted.options.as, wanted.options.frame, wanted.options.child_frame,
                              element_.options().messages.get());
  if (!form) return Trouble(wanted.path, form.error());
  {
    // One of before, whose port has another type now: first, since an engine may have one type of a topic only.
    const std::lock_guard lock(runtime_.structure_mutex());
    EraseWhere(offered_, [&](const auto& each) {
      return each->path() == wanted.path && each->options().topic == wanted.options.topic;
    });
  }
  auto made = std::make_unique<OfferedPort>(*beside_, "offer_" + std::to_string(++made_), *wanted.type, wanted.path,
                                            wanted.options, std::move(*form), clock_, wake_);
  made->set_on_matched([this] { LookAgain(); });
  if (const auto begun = made->Begin(*participant_); !begun) return Trouble(wanted.path, begun.error());
  const std::lock_guard lock(runtime_.structure_mutex());
  offered_.push_back(std::move(made));
}

void NetworkLink::TellStructure() {
  structure_topic_->Follow([this](const std::string& name, const Error& why) { Trouble("structure of " + name, why); });
  if (const auto& why = structure_topic_->refusal()) Trouble("structure", *why);
  if (!structure_) return;
  std::string text;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    text = structure_();
  }
  structure_topic_->Tell(text);
}

// What nodes of ROS 2 say of themselves.
void NetworkLink::FollowNodes() {
  if (nodes_ != nullptr || table_.Partners(kNodesTopic, true).empty()) return;
  auto reader =
      participant_->MakeReader({.topic = kNodesTopic, .type = kNodesType, .qos = {.is_latched = true, .depth = 1000}},
                               [this](const WireSample& sample) { table_.OnNodes(sample.octets); }, {});
  if (!reader) return Trouble("nodes", reader.error());
  nodes_ = std::move(*reader);
}

void NetworkLink::TellNode() {
  if (node_ == nullptr) return;
  std::vector<WireId> readers;
  std::vector<WireId> writers;
  for (const auto& each : offered_) writers.push_back(each->id());
  for (const auto& each : taken_) {
    if (const auto id = each->id()) readers.push_back(*id);
  }
  services_.AddIds(readers, writers);
  if (const auto id = structure_topic_->id()) writers.push_back(*id);
  node_->Tell(std::move(readers), std::move(writers));
}

void NetworkLink::FollowTakes() {
  std::vector<NetworkElement::Take> takes;
  std::vector<std::unique_ptr<TakenPort>> before;  // to go without the lock
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    takes = element_.takes();
    for (const auto& each : takes) {
      auto known = std::ranges::find(taken_, each.output, [](const auto& one) { return &one->output(); });
      if (known != taken_.end() && (*known)->options() == each.options) continue;
      before.push_back(std::make_unique<TakenPort>(*each.output, each.options, each.form, clock_, table_));
      if (known == taken_.end()) known = taken_.emplace(known);
      before.back().swap(*known);
    }
    for (const auto& each : taken_) each->NoteConnections();
  }
  before.clear();  // from now on only those publish that are made now
  for (const auto& each : taken_) {
    if (const auto followed = each->Follow(*participant_); !followed) {
      Trouble(each->output().path(), followed.error());
    }
  }
}

// What the thread of a network does for "//robot/pose.x" when others come and tell what they have.

namespace {

std::vector<LateConnection> Awaited(Runtime& runtime) {
  std::vector<LateConnection> awaited;
  const LateConnections* const late = LateConnections::FindIn(runtime);
  if (late == nullptr) return awaited;
  for (const LateConnection& each : late->all()) {
    if (each.waits_for && IsDistantPath(each.from)) awaited.push_back(each);
  }
  return awaited;
}

/// Outputs that have been taken out of the tree: destroyed when the lock is free again.
struct GoneOutputs {
  Runtime& runtime;
  std::vector<UnlistedElement> all = {};

  ~GoneOutputs() {
    std::erase_if(all, [](const UnlistedElement& each) { return !each; });
    runtime.Destroy(std::move(all));
  }
};

}  // namespace

void NetworkLink::FollowDistantPorts() {
  std::vector<std::unique_ptr<TakenPort>> before;  // to go without the lock
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    const NetworkPorts* const ports = NetworkPorts::Of(element_);
    if (ports == nullptr) return;
    bool is_any_due = !Awaited(runtime_).empty();
    for (const NetworkElement::Take& each : element_.takes()) {
      std::string why_not;
      const bool is_due = ports->OtherType(each, why_not).has_value();
      if (!why_not.empty()) Trouble(each.output->path(), {.message = "has values of another type there: " + why_not});
      is_any_due = is_any_due || is_due;
      const auto reader = std::ranges::find(taken_, each.output, [](const auto& one) { return &one->output(); });
      if (!is_due || reader == taken_.end()) continue;
      before.push_back(std::move(*reader));
      taken_.erase(reader);
    }
    if (!is_any_due) return;
  }
  before.clear();  // from now on nothing publishes there
  {
    GoneOutputs gone{runtime_};
    const ChangeScope changes(runtime_);
    NetworkPorts* const ports = NetworkPorts::Of(element_);
    if (ports == nullptr) return;  // the lock has been free
    const std::vector<NetworkElement::Take> takes = element_.takes();
    for (const NetworkElement::Take& each : takes) {
      const bool is_read = std::ranges::any_of(taken_, [&](const auto& one) { return &one->output() == each.output; });
      std::string why_not;
      const auto type = is_read ? std::nullopt : ports->OtherType(each, why_not);
      if (!type) continue;
      const std::string path = each.output->path();
      const auto renewed = ports->Renew(*each.output, *type, gone.all.emplace_back());
      if (!renewed) Trouble(path, renewed.error());
    }
    for (const LateConnection& each : Awaited(runtime_)) {
      if (const auto made = ports->MakeAwaited(each.from); !made) Trouble(each.to, made.error());
    }
    if (LateConnections* const late = LateConnections::FindIn(runtime_)) late->LookAgain();
  }
  const std::lock_guard lock(runtime_.structure_mutex());
  for (const LateConnection& each : Awaited(runtime_))
    Trouble(each.to, {.message = "waits for " + each.SourceText() + ": " + *each.waits_for});
}

void NetworkLink::TellAwaited(std::string& text) const {
  for (const LateConnection& each : Awaited(runtime_))
    text += "waits for " + each.SourceText() + " to " + each.to + ": " + *each.waits_for + "\n";
}

}  // namespace runnel
