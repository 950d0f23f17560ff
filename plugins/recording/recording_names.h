#pragma once

namespace runnel {

/// What recordings of Runnel have beside their messages.

/// Metadata: application, file, settings, clock ("simulated" or "real"), version, ports, started.
inline constexpr const char* kAboutMetadata = "runnel";
/// Metadata, the last one counts: by port, how many values were not written.
inline constexpr const char* kDropsMetadata = "runnel.dropped";
/// Attachment: the application file.
inline constexpr const char* kApplicationAttachment = "application.xml";
/// Of channels: the type as Runnel calls it.
inline constexpr const char* kTypeKey = "type";

inline constexpr const char* kMessageEncoding = "json";
inline constexpr const char* kSchemaEncoding = "jsonschema";

}  // namespace runnel
