#pragma once

#include <memory>
#include <string>

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include "plugins/wire/wire.h"

namespace runnel {

/// A value as Cyclone carries it: octets that it does not look into.
struct OctetsValue : ddsi_serdata {
  std::shared_ptr<const Octets> octets;
};

/// A type of which only the name is known. The caller hands it to a topic, or gives it back by ddsi_sertype_unref().
[[nodiscard]] ddsi_sertype* MakeOctetsType(const std::string& name);
/// With a count of one, which writing takes over. Precondition: the size is a multiple of four.
[[nodiscard]] ddsi_serdata* MakeOctetsValue(const ddsi_sertype& type, std::shared_ptr<const Octets> octets,
                                            std::int64_t source_time);

}  // namespace runnel
