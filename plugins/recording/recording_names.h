#pragma once

#include <string>

#include "plugins/mcap/mcap_records.h"
#include "plugins/values/foxglove_channel.h"

namespace runnel {

/// What recordings of Runnel have beside their messages.

/// Metadata: application, file, settings, clock ("simulated" or "real"), version, ports, started.
inline constexpr const char* kAboutMetadata = "runnel";
/// Metadata, the last one counts: by port, how many values were not written.
inline constexpr const char* kDropsMetadata = "runnel.dropped";
/// Attachment: the application file.
inline constexpr const char* kApplicationAttachment = "application.xml";
/// Of channels with the values of a port: its path. Others show the same values to viewers in schemas
/// that these know.
inline constexpr const char* kPortKey = "port";
inline constexpr const char* kViewOfKey = "view_of";

inline constexpr const char* kMessageEncoding = "json";
inline constexpr const char* kSchemaEncoding = "jsonschema";

/// How the values of a type are recorded: as Foxglove wants them, and whole.
[[nodiscard]] inline JsonLimits WholeValues() { return {}; }

/// The path of the port whose values a channel has: as Runnel notes it, or else the topic.
[[nodiscard]] inline std::string PortOf(const McapChannel& channel) {
  const std::string* const port = FindText(channel.metadata, kPortKey);
  return port != nullptr ? *port : channel.topic;
}
/// Whether a channel only shows what another one has.
[[nodiscard]] inline bool IsView(const McapChannel& channel) {
  return FindText(channel.metadata, kViewOfKey) != nullptr;
}

}  // namespace runnel
