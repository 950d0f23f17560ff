#pragma once

#include "plugins/application_files/xml_tag.h"

namespace runnel {

/// Adds what application files say of keys, within <network>:
///
///     <security keys="keys/robot"/>
///
/// a folder with the six files of SROS 2, each of which an attribute may name instead.
void AddSecurityTag(XmlTagRegistry& tags);

}  // namespace runnel
