#pragma once

#include "plugins/application_files/xml_tag.h"
#include "plugins/network/network_element.h"

namespace runnel {

// What <network> and its tags say that would do nothing, or not what is meant, without anybody being told.

/// Reports addresses that are none; warns of names that nobody knows here, and of peers out of reach.
void CheckPeers(const TagUse& use, const WireMemberOptions& member);

/// Warns of <ros> where no node that is set as usual can be met.
void CheckReachOfNodes(const TagUse& use, const WireMemberOptions& member);

/// Warns of patterns of <offer ports="…"> that mean no port.
void CheckPatterns(const TagUse& use, const OfferOptions& offer);

/// Errors: the topic that is said has values of another type already, of another port.
Result<void> CheckTopicType(const NetworkElement& network, const Port& port, const OfferOptions& offer, const ValueForm& form);

}  // namespace runnel
