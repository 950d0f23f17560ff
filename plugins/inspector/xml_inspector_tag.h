#pragma once

#include <optional>

#include "plugins/application_files/xml_tag.h"
#include "plugins/inspector/inspector_place.h"

namespace runnel {

/// Adds what application files say of the inspector:
///
///     <inspector port="8765" address="127.0.0.1" read_only="false" token="…" token_file="…" all_users="false"
///                certificate="…" key="…" insecure="false"/>
void AddInspectorTag(XmlTagRegistry& tags);

/// What the application file says; nothing without <inspector>.
[[nodiscard]] std::optional<InspectorPlace> InspectorPlaceOf(const FrameworkElement& application);

}  // namespace runnel
