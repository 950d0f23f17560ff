#pragma once

#include "plugins/application_files/xml_tag.h"

namespace runnel {

/// The words that every application file may use: what a registry of words begins with.
///
///     XmlTagRegistry tags = ApplicationTags();
[[nodiscard]] XmlTagRegistry ApplicationTags();

}  // namespace runnel
