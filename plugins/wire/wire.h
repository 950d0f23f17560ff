#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace runnel {

/// Octets as they go over the wire, with the four of the encapsulation in front.
using Octets = std::vector<std::byte>;

/// What names an endpoint or a participant in the whole network.
using WireId = std::array<std::uint8_t, 16>;

/// How values of a topic are kept and sent. A reader matches a writer that offers at least as much.
struct WireQos {
  bool is_reliable = true;
  bool is_latched = false;    ///< who comes late gets what has been written last (transient local)
  std::uint32_t depth = 1;    ///< newest values kept, at least 1
  bool is_exclusive = false;  ///< of several writers only the strongest counts (exclusive ownership)
  std::int32_t strength = 0;  ///< of a writer, if exclusive
  Duration lifespan{};        ///< of a writer's values, which nobody gets that are older; 0: for ever

  bool operator==(const WireQos&) const = default;
};

/// Policies that endpoints here leave as they are, of somebody else's endpoint; numbers as DDS has them.
struct OtherPolicies {
  int durability = 0;  ///< 2 and more: values outlive their writer
  int liveliness = 0;  ///< more than 0: who writes says itself that it is there
  bool has_deadline = false, has_lease = false;
  std::vector<std::string> partitions = {};
  std::vector<int> representations = {};  ///< of octets: 0 is XCDR1, 2 XCDR2

  /// What of it keeps the endpoint from being matched with those here, in words; "" if nothing does.
  [[nodiscard]] std::string Unmet(bool is_writer) const;
};

/// Why a reader that asks for `asked` gets nothing of a writer that offers `offered`, in words; "" if it does.
[[nodiscard]] std::string QosMisfit(const WireQos& offered, const WireQos& asked);
/// "reliable, latched, newest 1".
[[nodiscard]] std::string QosText(const WireQos& qos);

/// A writer or a reader that somebody is to have.
struct WireEndpointOptions {
  std::string topic = {};
  std::string type = {};
  WireQos qos = {};
  std::string user_data = {};  ///< told to all others
  std::string unmet = {};      ///< of one elsewhere: OtherPolicies::Unmet()
};

/// One that somebody has, here or elsewhere.
struct WireEndpoint {
  std::uint64_t handle = 0;  ///< by which this process knows it, see WireSample::writer
  WireId id = {};
  WireId participant = {};
  bool is_writer = false;
  bool is_own = false;  ///< of the participant that is told
  WireEndpointOptions options = {};
};

struct WireMember {
  WireId id = {};
  std::string name = {};
  std::string user_data = {};
};

/// Told who is in the network. Called by threads of the engine (CallBack()), one at a time for a participant; must return soon, and
/// may not call the participant.
class WireDiscovery {
 public:
  virtual void OnMember(const WireMember& member) = 0;
  virtual void OnMemberGone(const WireId& id) = 0;
  virtual void OnEndpoint(const WireEndpoint& endpoint) = 0;
  virtual void OnEndpointGone(const WireId& id) = 0;
  /// Somebody who is not let in, with the engine's words for why: again and again, as often as they try.
  virtual void OnRefused(const std::string& why) { (void)why; }
  /// One of the above has thrown, or there was no memory for what it is told. Nobody says that again.
  virtual void OnMissed() noexcept {}

 protected:
  ~WireDiscovery() = default;
};

/// What names one value in the whole network, where the engine tells (WireEngine::has_identities).
struct WireIdentity {
  WireId writer = {};
  std::int64_t number = 0;  ///< of the writer's values, from 1 on; 0: not known

  bool operator==(const WireIdentity&) const = default;
};

/// One value that has come.
struct WireSample {
  std::span<const std::byte> octets;  ///< gone when the callback returns, or, if there is a `holder`, when that goes
  std::int64_t source_time = 0;       ///< nanoseconds since 1970 on the writer's clock
  std::uint64_t writer = 0;           ///< WireEndpoint::handle
  WireIdentity identity = {};         ///< its own
  WireIdentity related = {};          ///< as its writer says: of the value that it answers, or where an answer is to go
  std::shared_ptr<const void> holder = {};  ///< whoever has it keeps the octets as they are; nullptr: they go
  std::string_view flaw = {};               ///< why there are no octets, though a value has come; else ""
};

/// How many there are at the other ends, after each change. Called by threads of the engine, as CallBack() does.
using OnMatched = std::function<void(std::size_t count)>;
/// Called by threads of the engine, one at a time for a reader, as CallBack() does.
using OnSample = std::function<void(const WireSample& sample)>;

/// For engines, beneath whose threads nobody catches anything. False: whoever has thrown, for want of memory, has not been told.
template <typename Callback>
bool CallBack(const Callback& callback) noexcept {
  try {
    callback();
    return true;
  } catch (...) {  // the next one may find memory again
    return false;
  }
}

/// Destroying it waits for callbacks that run.
class WireWriter {
 public:
  virtual ~WireWriter() = default;
  [[nodiscard]] virtual const WireId& id() const noexcept = 0;
  /// Whether what is written now goes to the reader that has this WireEndpoint::handle. Any thread.
  [[nodiscard]] virtual bool HasReader(std::uint64_t reader) const = 0;
  /// `octets` stay as they are until nobody but the caller has them any more. Never waits for readers beyond the
  /// engine's bound for reliable ones (milliseconds). One thread at a time. Allocates.
  virtual Result<void> Write(const std::shared_ptr<const Octets>& octets, std::int64_t source_time) = 0;
  /// As Write(), of a value that is related to another one, as requests and replies of ROS 2's default middleware are:
  /// a request says {reader of the replies, 0}, a reply {that reader, the request's number}. Tells the value's own
  /// identity. Errors: the engine has none.
  virtual Result<WireIdentity> WriteRelated(const std::shared_ptr<const Octets>& octets, std::int64_t source_time,
                                            const WireIdentity& related);
};

/// Destroying it waits for callbacks that run.
class WireReader {
 public:
  virtual ~WireReader() = default;
  [[nodiscard]] virtual const WireId& id() const noexcept = 0;
};

/// Who can be reached, and can reach this one.
enum class WireReach {
  kLoopback,  ///< processes of this machine that say the same: sockets on 127.0.0.1 only
  kMachine,   ///< this machine, also processes that are open to the network
  kNetwork,   ///< whoever is in the network
};

/// The files by which members know each other and encrypt (DDS Security), as SROS 2 names them: PEM, signed S/MIME.
struct WireSecurity {
  std::string identity_ca = {};     ///< who says who is who
  std::string certificate = {};     ///< who this member is
  std::string key = {};             ///< that it is
  std::string permissions_ca = {};  ///< who signs the two below
  std::string governance = {};      ///< what is encrypted
  std::string permissions = {};     ///< what this member may write and read
};

/// A hint for an engine that has joined no network with these keys and does not say which file is wrong.
[[nodiscard]] inline std::string KeyFilesHint(const WireSecurity& security) {
  return "the key must be that of the certificate, and that of the authority: look at " + security.certificate + ", " +
         security.key + ", " + security.identity_ca + "; the other two signed by " + security.permissions_ca + ": " +
         security.governance + ", " + security.permissions;
}

/// `error` of making an endpoint, with the hint what the member's permissions are to have, if it has keys and `error` has none.
[[nodiscard]] Error WithPermissionHint(Error error, bool has_keys, const WireEndpointOptions& options, bool is_writer);

struct WireMemberOptions {
  std::uint32_t domain = 0;  ///< up to 232
  WireReach reach = WireReach::kLoopback;
  std::vector<std::string> peers = {};  ///< addresses besides, where nothing is sent to all at once
  bool has_multicast = true;            ///< false: only peers, and this machine, are asked
  std::string interface = {};           ///< name or address of the only one to be used, with kNetwork; "": any
  std::string name = {};
  std::string user_data = {};
  std::optional<WireSecurity> security = {};  ///< nothing: whoever is within reach may join, and listen
  std::uint32_t datagram = 0;                 ///< octets of the largest one, 1000 to 65500; 0: as is best for the reach
  Duration lease = std::chrono::seconds(10);  ///< so long after its last sign of life it counts as gone; 1 s at least
};

/// Octets of the largest datagram. Beyond this machine it fits into a frame: of one that is cut into many, none of which may get
/// lost, the system keeps what has come for half a minute, and has little room for that.
[[nodiscard]] constexpr std::uint32_t LargestDatagram(const WireMemberOptions& options) {
  return options.datagram != 0 ? options.datagram : options.reach == WireReach::kNetwork ? 1400 : 65'500;
}

/// One member of the network.
///
/// Ownership:  of the engine's threads, which are made by who joins and inherit its scheduling: not by real-time
///             threads. Writers and readers must go first.
/// Threads:    any.
class WireParticipant {
 public:
  virtual ~WireParticipant() = default;
  [[nodiscard]] virtual const WireId& id() const noexcept = 0;
  virtual Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) = 0;
  virtual Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                         OnMatched on_matched) = 0;
};

/// A way to send octets: Cyclone DDS, Fast DDS, or a fake of this process.
class WireEngine {
 public:
  virtual ~WireEngine() = default;
  /// Whether values have identities, and say to which others they are related.
  [[nodiscard]] virtual bool has_identities() const noexcept { return false; }
  /// `discovery` must outlive the participant. Errors: what the engine says of options and network.
  virtual Result<std::unique_ptr<WireParticipant>> Join(const WireMemberOptions& options, WireDiscovery& discovery) = 0;
};

}  // namespace runnel
