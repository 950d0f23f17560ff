#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/xml/xml_document.h"
#include "plugins/application_files/xml_tag.h"
#include "plugins/network/network_element.h"
#include "plugins/structure/change.h"

namespace runnel {

namespace internal {
class FileUpdate;
}

// The words of <offer> and <take>, which files, terminals and browsers have in common.

[[nodiscard]] std::vector<AttributeRule> OfferRules();
[[nodiscard]] std::vector<AttributeRule> TakeRules();

/// What is said under a name; "": nothing.
using SaidOf = std::function<std::string(const char* name)>;
/// All but the ports, of what has been checked by the rules.
[[nodiscard]] OfferOptions OfferSaid(const SaidOf& said);
/// Stands for a strength that is too great, as what is said is a count.
inline constexpr std::int32_t kTooStrong = -1;
/// What does not go together, of what each word alone allows.
[[nodiscard]] std::optional<Error> WhatIsWrong(const OfferOptions& offer);
[[nodiscard]] TakeOptions TakeSaid(const SaidOf& said);

/// The same as words, without those that are usual: what a file or a change says besides ports and topic of a take.
[[nodiscard]] std::vector<Setting> WordsOf(const OfferOptions& offer);
[[nodiscard]] std::vector<Setting> WordsOf(const TakeOptions& take);

// What <network> and its tags say that would do nothing, or not what is meant, without anybody being told.

/// Whether the attribute, if it is said, is a name of ROS 2; else that is reported.
bool CheckNameIn(const TagUse& use, const char* attribute);
/// Reports addresses that are none; warns of names that nobody knows here, and of peers out of reach.
void CheckPeers(const TagUse& use, const WireMemberOptions& member);
/// Warns of <ros> where no node that is set as usual can be met.
void CheckReachOfNodes(const TagUse& use, const WireMemberOptions& member);
/// Warns of patterns of <offer ports="…"> that mean no port.
void CheckPatterns(const TagUse& use, const OfferOptions& offer);
/// Errors: the topic that is said has values of another type already, of another port.
Result<void> CheckTopicType(const NetworkElement& network, const Port& port, const OfferOptions& offer,
                            const ValueForm& form);

/// Errors: that port is offered as that topic by a tag before, of which one would count only.
Result<void> CheckIsOfferedOnce(const NetworkElement& network, const OfferOptions& offer);

// What tags of files do.

/// <offer port="mapper/save" service="/save_map"/>: whether the port is a service, or was to be one. Mistakes are reported.
bool OfferService(const TagUse& use, const Port& port);
/// <take service="/save_map" to="planner/save"/>.
FrameworkElement* TakeService(const TagUse& use);
/// Brings <network> of a file, and what is offered and taken there, up to what it is now (XmlTag::update).
void UpdateNetworkTag(XmlElement tag, FrameworkElement& application, internal::FileUpdate& update);
/// Lets what is offered and taken be changed while the application runs, by the changes `offer` and `take`
/// (ExtensionChanges), which can be undone. Under the structure lock.
void AddNetworkChanges(Runtime& runtime);

/// Adds what application files say of the network:
///
///     <network domain="0" name="base" reach="loopback">
///       <offer ports="laser/scan localisation/pose !**/debug"/>
///       <offer port="laser/scan" topic="/scan" as="sensor_msgs/msg/LaserScan" qos="sensor" rate="20"/>
///       <take topic="/cmd_vel" as="geometry_msgs/msg/Twist" to="drive/twist"/>
///     </network>
void AddNetworkTags(XmlTagRegistry& tags);
/// … of keys, within <network>: <security keys="keys/robot"/>, a folder with the six files of SROS 2, each of which an
/// attribute may name instead.
void AddSecurityTag(XmlTagRegistry& tags);

}  // namespace runnel
