#pragma once

#include "plugins/wire/wire.h"

namespace runnel::test {

/// Does not care who is there.
class Nobody final : public WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}
};

}  // namespace runnel::test
