#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/base/clock.h"
#include "plugins/foxglove/internal/directory.h"

/// What the server says, as the protocol has it.
namespace runnel::internal {

struct FoxgloveShared;

enum class StatusLevel { kInformation = 0, kWarning = 1, kError = 2 };

[[nodiscard]] std::string ServerInfoMessage(const FoxgloveShared& shared);
[[nodiscard]] std::string StatusMessage(StatusLevel level, std::string_view text);
[[nodiscard]] std::string AdvertiseMessageFor(std::span<const DirectoryChannel* const> channels);
/// `op` and `key`: "unadvertise", "channelIds"; "unadvertiseServices", "serviceIds".
[[nodiscard]] std::string UnadvertiseMessageFor(std::string_view op, std::string_view key,
                                                std::span<const std::uint32_t> ids);
[[nodiscard]] std::string AdvertiseServicesMessage(std::span<const DirectoryService* const> services);
[[nodiscard]] std::string ServiceFailureMessage(std::uint32_t service, std::uint32_t call, std::string_view why);
/// Binary.
[[nodiscard]] std::string ServiceReplyMessage(std::uint32_t service, std::uint32_t call, std::string_view json);
/// What has changed between two moments.
[[nodiscard]] std::string GraphMessage(const std::map<std::string, GraphTopic>& before,
                                       const std::map<std::string, GraphTopic>& now);

/// The head of a binary message with a value; the value follows.
void AppendMessageHead(std::uint32_t subscription, Time timestamp, std::string& bytes);
[[nodiscard]] std::string TimeMessage(Time now);

}  // namespace runnel::internal
