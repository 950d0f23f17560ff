#include <algorithm>

#include <arpa/inet.h>
#include <netdb.h>

#include "core/base/nearest_name.h"
#include "core/element/runtime.h"
#include "core/paths/path_search.h"
#include "plugins/application_files/build_context.h"
#include "plugins/network/xml_network_words.h"
#include "plugins/network_discovery/distant_type.h"
#include "plugins/ros_messages/names.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

namespace {

bool IsAddress(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

bool IsKnownName(const std::string& name) {
  addrinfo* found = nullptr;
  const bool is_known = getaddrinfo(name.c_str(), nullptr, nullptr, &found) == 0;
  if (found != nullptr) freeaddrinfo(found);
  return is_known;
}

// The first words of a path, at most so many, and none from the first with a * on: "gate" of "gate/*".
std::string BeginOf(const std::string& path, std::size_t most) {
  std::string begin;
  for (const std::string& word : PartsOf(path)) {
    if (most-- == 0 || word.find('*') != std::string::npos) break;
    begin += (begin.empty() ? "" : "/") + word;
  }
  return begin;
}

}  // namespace

bool CheckNameIn(const TagUse& use, const char* attribute) {
  const XmlAttribute* const name = use.Find(attribute);
  if (name == nullptr) return true;
  const auto checked = CheckRosName(name->value);
  if (!checked) use.Report(checked.error(), name->value_position);
  return checked.has_value();
}

void CheckPeers(const TagUse& use, const WireMemberOptions& member) {
  const XmlAttribute* const said = use.Find("peers");
  if (said == nullptr) return;
  for (const std::string& peer : member.peers) {
    const std::string host = peer.substr(0, peer.find(':'));
    const bool is_number = host.find_first_not_of("0123456789.") == std::string::npos;
    const bool is_here = host.starts_with("127.") || host == "localhost";
    if (is_number && !IsAddress(host)) {
      use.Report({.message = "'" + peer + "' is no address",
                  .hint = "four numbers from 0 to 255, 10.0.0.2, or the name of a machine"},
                 said->value_position);
    } else if (member.reach == WireReach::kLoopback && !is_here) {
      use.context.Warn({.message = "'" + peer + "' is not asked, as no other machine is reached by reach=\"loopback\"",
                        .hint = "say reach=\"network\""},
                       said->value_position, use.parent);
    } else if (!is_number && !IsKnownName(host)) {
      use.context.Warn({.message = "no machine is known here by the name '" + host + "', so nobody is asked there",
                        .hint = "write its address, or look after /etc/hosts"},
                       said->value_position, use.parent);
    }
  }
}

void CheckReachOfNodes(const TagUse& use, const WireMemberOptions& member) {
  if (member.reach != WireReach::kLoopback) return;
  use.context.Warn(
      {.message =
           "nodes of ROS 2 are not met by reach=\"loopback\", unless they have ROS_LOCALHOST_ONLY=1 (up to Humble)",
       .hint = "<network reach=\"machine\"> for those of this machine, reach=\"network\" for all"},
      use.xml.position(), use.parent);
}

void CheckPatterns(const TagUse& use, const OfferOptions& offer) {
  std::vector<std::string> paths;
  const NetworkElement* const network = NetworkElement::FindIn(use.parent);
  use.parent.VisitAll<const Port>([&](const Port& port) {
    if (port.direction() == Port::Direction::kOutput && !port.IsAtOrBelow(*network)) paths.push_back(port.path());
  });
  for (const std::string& pattern : offer.patterns) {
    const auto alone = PortPatterns::Make({pattern});
    const bool is_exclusion = pattern.starts_with('!');
    if (!alone || is_exclusion || std::ranges::any_of(paths, [&](const std::string& path) { return alone->Fit(path); }))
      continue;
    const std::string begin = BeginOf(pattern, pattern.size());
    std::vector<std::string> begins;
    for (const std::string& path : paths) begins.push_back(BeginOf(ShortPortPath(path), PartsOf(begin).size()));
    const std::string nearest = begin.empty() ? "" : NearestName(begin, begins);
    use.context.Warn({.message = "'" + pattern + "' means no port that is there",
                      .hint = nearest.empty() ? ""
                                              : "did you mean '" + nearest +
                                                    pattern.substr(pattern.find(begin) + begin.size()) + "'?"},
                     use.Get("ports").value_position, use.parent);
  }
}

Result<void> CheckTopicType(const NetworkElement& network, const Port& port, const OfferOptions& offer,
                            const ValueForm& form) {
  const NetworkOptions& options = network.options();
  for (const OfferOptions& each : options.offers) {
    if (offer.topic.empty() || each.topic != offer.topic || each.port.empty() || each.port == port.path()) continue;
    const auto other = PathSearch(network.runtime()).FindPort(each.port, PathKind::kOutput);
    if (!other) continue;
    const auto its = ValueForm::Make((*other)->type(), each.as, each.frame, each.child_frame, options.messages.get());
    if (!its || (*its)->codec->dds_type() == form.codec->dds_type()) continue;
    return Error{.message = "the topic " + offer.topic + " has values of " + each.port + " already, of another type (" +
                            (*its)->codec->ros_type() + ", and not " + form.codec->ros_type() + ")",
                 .path = port.path(),
                 .hint = "say another topic of one of them"};
  }
  return {};
}

Result<void> CheckIsOfferedOnce(const NetworkElement& network, const OfferOptions& offer) {
  const NetworkOptions& options = network.options();
  const auto topic_of = [&](const OfferOptions& each) {
    return each.topic.empty() ? TopicOfPort(options.member.name, each.port) : each.topic;
  };
  for (const OfferOptions& each : options.offers) {
    if (each.port != offer.port || topic_of(each) != topic_of(offer)) continue;
    return Error{
        .message = "is offered as " + topic_of(offer) + " already, in line " + std::to_string(each.position.line),
        .path = offer.port,
        .hint = "say all of it in one tag, or another topic"};
  }
  return {};
}

}  // namespace runnel
