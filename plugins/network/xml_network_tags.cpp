
#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/types/duration_text.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/type_names.h"
#include "plugins/network/network_element.h"
#include "plugins/network/network_engines.h"
#include "plugins/network/xml_network_words.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

namespace {

constexpr std::size_t kLargestDomain = 101;  // those beyond may collide with ports that the system gives out
constexpr std::size_t kSmallestDatagram = 1000;
constexpr std::size_t kLargestDatagram = 65'500;
constexpr Duration kShortestLease = std::chrono::seconds(1);
constexpr Duration kLongestLease = std::chrono::hours(1);
const std::vector<std::string> kReaches = {"loopback", "machine", "network"};
const std::vector<std::string> kFarCommands = {"set", "swap"};

bool IsTrue(const TagUse& use, std::string_view name) { return use.xml.TextOr(name) == "true"; }

void ReadDomain(const TagUse& use, WireMemberOptions& member) {
  const XmlAttribute* const said = use.Find("domain");
  const char* const environment = std::getenv("ROS_DOMAIN_ID");
  if (said == nullptr && (environment == nullptr || *environment == '\0')) return;
  const auto number = ParseCount(said != nullptr ? said->value : environment);
  if (number && *number <= kLargestDomain) {
    member.domain = static_cast<std::uint32_t>(*number);
    return;
  }
  use.Report({.message = std::string(said != nullptr ? "" : "ROS_DOMAIN_ID: ") + "a domain is a number from 0 to " +
                         std::to_string(kLargestDomain)},
             said != nullptr ? said->value_position : use.xml.position());
}

// What others may ask for.
void ReadCommands(const TagUse& use, NetworkOptions& options) {
  const XmlAttribute* const said = use.Find("commands");
  if (said == nullptr) return;
  for (const std::string& each : SplitPaths(said->value)) {
    if (std::ranges::count(kFarCommands, each) == 0) {
      use.Report({.message = "others cannot be allowed to '" + each + "'", .hint = NearestNameHint(each, kFarCommands)},
                 said->value_position);
    }
    options.commands.push_back(each);
  }
}

// Of files beside the application's, besides those of ROS 2.
void ReadMessages(const TagUse& use, NetworkOptions& options) {
  const XmlAttribute* const said = use.Find("messages");
  if (said == nullptr) return;
  auto messages = std::make_shared<MessageLibrary>();
  for (const std::string& place : SplitPaths(said->value)) {
    const auto read = messages->Read((use.context.FolderOf(use.xml.position()) / place).lexically_normal());
    if (!read) use.Report(read.error(), said->value_position);
  }
  options.messages = std::move(messages);
}

FrameworkElement* HandleNetwork(const TagUse& use) {
  if (const NetworkElement* const first = NetworkElement::FindIn(use.parent)) {
    use.Report({.message = "there is a network already",
                .hint = "the first is in line " + std::to_string(first->options().position.line)},
               use.xml.position());
    return nullptr;
  }
  NetworkOptions options{.position = use.xml.position()};
  WireMemberOptions& member = options.member;
  ReadDomain(use, member);
  member.name = use.xml.TextOr("name", use.parent.name());
  if (const XmlAttribute* const reach = use.Find("reach")) {
    member.reach = static_cast<WireReach>(std::ranges::find(kReaches, reach->value) - kReaches.begin());
  }
  member.peers = SplitPaths(use.xml.TextOr("peers"));
  CheckPeers(use, member);
  member.interface = use.xml.TextOr("interface");
  member.has_multicast = use.xml.TextOr("multicast") != "false";
  if (const XmlAttribute* const interface = use.Find("interface");
      interface != nullptr && member.reach != WireReach::kNetwork) {
    use.Report({.message = "an interface is chosen only where the network is reached",
                .hint = "say reach=\"network\", or leave it out"},
               interface->position);
  }
  if (const XmlAttribute* const datagram = use.Find("datagram")) {
    const std::size_t octets = *ParseCount(datagram->value);
    member.datagram = static_cast<std::uint32_t>(octets);
    if (octets < kSmallestDatagram || octets > kLargestDatagram) {
      use.Report({.message = "a datagram has from " + std::to_string(kSmallestDatagram) + " to " +
                             std::to_string(kLargestDatagram) + " octets"},
                 datagram->value_position);
    }
  }
  if (const XmlAttribute* const lease = use.Find("lease")) {
    member.lease = ParseDuration(lease->value).value();
    if (member.lease < kShortestLease || member.lease > kLongestLease) {
      use.Report({.message = "a lease is from 1 s to 1 h long", .hint = "<on_stale> sees sooner that nothing comes"},
                 lease->value_position);
    }
  }
  ReadCommands(use, options);
  ReadMessages(use, options);
  options.is_live = IsTrue(use, "live");
  options.engine = use.xml.TextOr("engine", options.engine);
  const auto engine = FindWireEngine(options.engine, use.context.plugins());
  if (!engine)
    use.Report(engine.error(), use.Find("engine") != nullptr ? use.Find("engine")->value_position : use.xml.position());
  auto& network = use.context.runtime().Create<NetworkElement>(use.parent, "network", std::move(options));
  network.set_know_types([&plugins = use.context.plugins(), known = std::optional<std::size_t>()]() mutable {
    const std::size_t types = plugins.modules().All().size();
    if (std::exchange(known, types) != types) MakePortTypesKnown(plugins);
  });
  AddNetworkChanges(use.context.runtime());
  return &use.parent;
}

void AddOffer(const TagUse& use, OfferOptions offer) {
  if (const XmlAttribute* const path = use.Find("port")) {
    const Port* const port = SearchPort(PathIn(*path, use.parent), PathKind::kOutput, use.context);
    if (port == nullptr || OfferService(use, *port)) return;
    offer.port = port->path();
    const NetworkElement& element = *NetworkElement::FindIn(use.parent);
    if (const auto is_own = element.CheckIsOwn(*port); !is_own) return use.Report(is_own.error(), path->value_position);
    const NetworkOptions& network = element.options();
    const auto form = ValueForm::Make(port->type(), offer.as, offer.frame, offer.child_frame, network.messages.get());
    if (!form) {
      const XmlAttribute* const as = use.Find("as");
      return use.Report(form.error(), (as != nullptr ? as : path)->value_position);
    }
    const auto fits = CheckTopicType(element, *port, offer, **form);
    if (!fits) return use.Report(fits.error(), use.Get("topic").value_position);
    if (const auto once = CheckIsOfferedOnce(element, offer); !once)
      return use.Report(once.error(), path->value_position);
  }
  if (offer.port.empty()) CheckPatterns(use, offer);
  NetworkElement::FindIn(use.parent)->AddOffer(std::move(offer));
}

FrameworkElement* HandleOffer(const TagUse& use) {
  OfferOptions offer = OfferSaid([&](const char* name) { return use.xml.TextOr(name); });
  offer.position = use.xml.position();
  const XmlAttribute* const ports = use.Find("ports");
  if ((ports == nullptr) == (use.Find("port") == nullptr)) {
    use.Report({.message = "<offer> says which ports, or which port",
                .hint = "ports=\"laser/* !**/debug\", or port=\"laser/scan\""},
               use.xml.position());
    return &use.parent;
  }
  if (const auto wrong = WhatIsWrong(offer))
    use.Report(*wrong, use.Get(offer.strength == kTooStrong ? "strength" : "rate").value_position);
  if (ports != nullptr) {
    for (const char* const only : {"topic", "service", "as", "frame", "child_frame"}) {
      if (const XmlAttribute* const said = use.Find(only)) {
        use.Report({.message = std::string(only) + " is said of one port", .hint = "write port=\"…\" instead of ports"},
                   said->position);
        return &use.parent;
      }
    }
    offer.patterns = SplitPaths(ports->value);
    const auto patterns = PortPatterns::Make(offer.patterns);
    if (!patterns) use.Report(patterns.error(), ports->value_position);
  }
  if (!CheckNameIn(use, "topic")) return &use.parent;
  use.context.Defer(BuildStage::kConnections, [use, offer = std::move(offer)] { AddOffer(use, offer); });
  return &use.parent;
}

void AddTake(const TagUse& use, const TakeOptions& take) {
  NetworkElement& network = *NetworkElement::FindIn(use.parent);
  for (const PathUse& to_use : PathsIn(use.Get("to"), use.parent)) {
    Port* const to = SearchPort(to_use, PathKind::kInput, use.context);
    if (to == nullptr) continue;
    const auto output = network.AddTake(take, to->type());
    const auto connected = output ? Port::Connect(**output, *to) : Result<void>(output.error());
    if (connected) continue;
    use.context.MarkUnfed(*to);
    const XmlAttribute* const field = output ? nullptr : use.Find("field");
    use.Report(connected.error(), field != nullptr ? field->value_position : to_use.position);
  }
}

FrameworkElement* HandleTake(const TagUse& use) {
  if (use.Find("service") != nullptr) return TakeService(use);
  if (use.Find("topic") == nullptr) {
    use.Report({.message = "<take> says which topic, or which service",
                .hint = "topic=\"/cmd_vel\", or service=\"/save_map\""},
               use.xml.position());
  }
  TakeOptions take = TakeSaid([&](const char* name) { return use.xml.TextOr(name); });
  take.is_live = take.is_live || NetworkElement::FindIn(use.parent)->options().is_live;
  take.position = use.xml.position();
  const bool is_right = use.Find("topic") != nullptr && CheckNameIn(use, "topic");
  use.context.Defer(BuildStage::kConnections, [use, is_right, take = std::move(take)] {
    if (is_right) return AddTake(use, take);
    for (const PathUse& to : PathsIn(use.Get("to"), use.parent)) {
      if (Port* const port = FindPort(to, PathKind::kInput)) use.context.MarkUnfed(*port);
    }
  });
  return &use.parent;
}

FrameworkElement* HandleRos(const TagUse& use) {
  NetworkElement& network = *NetworkElement::FindIn(use.parent);
  if (network.options().ros) {
    use.Report({.message = "<ros> stands there already"}, use.xml.position());
    return &use.parent;
  }
  CheckReachOfNodes(use, network.options().member);
  RosOptions ros{.distribution = use.xml.TextOr("distribution"),
                 .node = use.xml.TextOr("node", NearestRosName("/" + network.options().member.name)),
                 .sends_clock = IsTrue(use, "clock"),
                 .follows_clock = use.xml.TextOr("clock") == "follow",
                 .sends_log = IsTrue(use, "log"),
                 .sends_diagnostics = IsTrue(use, "diagnostics"),
                 .stop_releases = IsTrue(use, "stop_releases")};
  if (use.Find("parameters") != nullptr) {
    const auto parameters = std::ranges::find(RosParameterUses(), use.xml.TextOr("parameters"));
    ros.parameters = static_cast<RosParameterUse>(parameters - RosParameterUses().begin());
  }
  if (const auto checked = CheckRosName(ros.node); !checked)
    use.Report(checked.error(), use.Get("node").value_position);
  const char* const environment = std::getenv("ROS_DISTRO");
  if (ros.distribution.empty() && environment != nullptr && *environment != 0) {
    const auto& known = RosDistributions();
    if (std::ranges::find(known, environment) != known.end()) {
      ros.distribution = environment;
    } else {
      use.context.Warn({.message = "ROS_DISTRO names no distribution of ROS 2: '" + std::string(environment) + "'",
                        .hint = NearestNameHint(environment, known)},
                       use.xml.position(), use.parent);
    }
  }
  if (ros.distribution.empty()) {
    use.context.Warn(
        {.message = "the application is in no list of nodes, as nobody says of which ROS 2 the others are",
         .hint = "distribution=\"jazzy\", or ROS_DISTRO; others than those that are there end for want of memory"},
        use.xml.position(), use.parent);
  }
  network.set_ros(std::move(ros));
  return &use.parent;
}

}  // namespace

void AddNetworkTags(XmlTagRegistry& tags) {
  tags.AddTag(
      {.name = "network",
       .summary = "connects the application with other processes, machines and nodes of ROS 2",
       .parents = {"application"},
       .attributes =
           {KindRule("domain", AttributeKind::kCount,
                     "only members of one domain see each other; 0 to 101; ROS_DOMAIN_ID, or else 0"),
            KindRule("name", AttributeKind::kName, "of the application in the network; its own by default"),
            WordRule("reach", kReaches,
                     "loopback: only processes of this machine that say so, too (the default); machine: "
                     "also nodes of ROS 2 on it; network: whoever is there"),
            {.name = "peers",
             .summary = "addresses of others, where not all can be asked at once; separated by blanks"},
            {.name = "interface", .summary = "the only one that is used, by its name or address"},
            WordRule("multicast", {"true", "false"}, "false: only peers, and this machine, are asked"),
            KindRule("datagram", AttributeKind::kCount,
                     "octets of the largest one: 1400 where the reach is the network, so that it fits into a frame; "
                     "else 65500"),
            KindRule("lease", AttributeKind::kDuration,
                     "so long after its last sign of life the application counts as gone, as after kill -9; 10 s"),
            {.name = "commands",
             .summary = "what applications that can reach this one may have it do: set, swap; nothing if left out"},
            WordRule("live", {"true", "false"},
                     "true: what is taken may come although time is simulated, of which runs are not repeatable then"),
            {.name = "messages",
             .summary = ".msg and .srv files, and folders with <package>/msg/*.msg and <package>/srv/*.srv, beside ROS "
                        "2's own; separated by blanks"},
            KindRule("engine", AttributeKind::kName, "cyclone (the default), or fast: Fast DDS")},
       .handle = HandleNetwork,
       .update = UpdateNetworkTag});
  tags.AddTag({.name = "offer",
               .summary = "ports that others may read",
               .parents = {"network"},
               .attributes = OfferRules(),
               .handle = HandleOffer});
  tags.AddTag(
      {.name = "ros",
       .summary = "what nodes of ROS 2 are told besides topics",
       .parents = {"network"},
       .attributes =
           {WordRule("distribution", RosDistributions(),
                     "of the other nodes, which decides how a node is told; ROS_DISTRO if left out"),
            {.name = "node", .summary = "name of the node: /base; /<name of the application> by default"},
            WordRule("clock", {"true", "false", "follow"},
                     "true: publishes the application's time on /clock; follow: the application, which has "
                     "<clock type=\"outside\"/>, takes its time from there"),
            WordRule("log", {"true", "false"}, "true: publishes what modules say on /rosout"),
            WordRule("diagnostics", {"true", "false"},
                     "true: publishes faults, silent inputs and late threads on /diagnostics"),
            WordRule("parameters", RosParameterUses(),
                     "read: nodes may look at the application's parameters; write: and set them; none by default"),
            WordRule("stop_releases", {"true", "false"},
                     "true: false, sent to the service ~/stop, releases the STOP of the robot; else it does nothing")},
       .handle = HandleRos});
  tags.AddTag({.name = "take",
               .summary = "a topic whose values go to ports of this application, or a service that they call",
               .parents = {"network"},
               .attributes = TakeRules(),
               .handle = HandleTake});
}

}  // namespace runnel
