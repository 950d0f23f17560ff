#include "plugins/wire_cyclone/cyclone_discovery.h"

#include <algorithm>
#include <cstring>

namespace runnel {

namespace {

constexpr std::size_t kAtOnce = 16;

WireId IdOf(const dds_guid_t& guid) {
  WireId id;
  static_assert(sizeof guid.v == sizeof id);
  std::memcpy(id.data(), guid.v, sizeof id);
  return id;
}

// Each built-in sample that waits, with what is known of it. False: not all could be visited.
template <typename Sample, typename Visit>
bool TakeAll(dds_entity_t reader, const Visit& visit) {
  for (bool is_told = true;;) {
    void* samples[kAtOnce] = {};
    dds_sample_info_t infos[kAtOnce];
    const dds_return_t count = dds_take(reader, samples, infos, kAtOnce, kAtOnce);
    if (count <= 0) return is_told;
    for (dds_return_t i = 0; i < count; ++i)
      is_told = CallBack([&] { visit(*static_cast<const Sample*>(samples[i]), infos[i]); }) && is_told;
    (void)dds_return_loan(reader, samples, count);
  }
}

bool IsThere(const dds_sample_info_t& info) { return info.valid_data && info.instance_state == DDS_IST_ALIVE; }

OtherPolicies OtherPoliciesOf(const dds_qos_t* qos) {
  OtherPolicies other;
  dds_durability_kind_t durability;
  dds_liveliness_kind_t liveliness;
  dds_duration_t time = DDS_INFINITY;
  std::uint32_t count = 0;
  char** partitions = nullptr;
  dds_data_representation_id_t* representations = nullptr;
  if (dds_qget_durability(qos, &durability)) other.durability = durability;
  other.has_deadline = dds_qget_deadline(qos, &time) && time != DDS_INFINITY;
  if (dds_qget_liveliness(qos, &liveliness, &time)) {
    other.liveliness = liveliness;
    other.has_lease = time != DDS_INFINITY;
  }
  if (dds_qget_partition(qos, &count, &partitions)) {
    for (std::uint32_t i = 0; i < count; dds_free(partitions[i++])) other.partitions.emplace_back(partitions[i]);
    dds_free(partitions);
  }
  if (dds_qget_data_representation(qos, &count, &representations)) {
    other.representations.assign(representations, representations + count);
    dds_free(representations);
  }
  return other;
}

}  // namespace

WireQos QosOf(const dds_qos_t* qos) {
  WireQos found;
  dds_reliability_kind_t reliability;
  dds_duration_t time;
  if (dds_qget_reliability(qos, &reliability, &time)) found.is_reliable = reliability == DDS_RELIABILITY_RELIABLE;
  dds_durability_kind_t durability;
  if (dds_qget_durability(qos, &durability)) found.is_latched = durability != DDS_DURABILITY_VOLATILE;
  dds_history_kind_t history;
  std::int32_t depth = 1;
  if (dds_qget_history(qos, &history, &depth)) found.depth = static_cast<std::uint32_t>(std::max(depth, 1));
  dds_ownership_kind_t ownership;
  if (dds_qget_ownership(qos, &ownership)) found.is_exclusive = ownership == DDS_OWNERSHIP_EXCLUSIVE;
  (void)dds_qget_ownership_strength(qos, &found.strength);
  return found;
}

dds_qos_t* MakeQos(const WireEndpointOptions& options, bool is_writer) {
  constexpr dds_duration_t kLongestWait = DDS_MSECS(2);
  const WireQos& wanted = options.qos;
  dds_qos_t* const qos = dds_create_qos();
  dds_qset_reliability(qos, wanted.is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, kLongestWait);
  dds_qset_durability(qos, wanted.is_latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  const auto depth = static_cast<std::int32_t>(wanted.depth);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  if (is_writer && wanted.is_latched) {
    dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, depth, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED);
  }
  if (wanted.is_exclusive) {
    dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
    if (is_writer) dds_qset_ownership_strength(qos, wanted.strength);
  }
  dds_qset_ignorelocal(qos, DDS_IGNORELOCAL_PARTICIPANT);
  if (is_writer && wanted.lifespan > Duration{}) dds_qset_lifespan(qos, wanted.lifespan.count());
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos, 1, &representation);
  if (!options.user_data.empty()) dds_qset_userdata(qos, options.user_data.data(), options.user_data.size());
  return qos;
}

std::string UserDataOf(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return {};
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

CycloneDiscovery::CycloneDiscovery(dds_entity_t participant, const WireId& own, WireDiscovery& listener)
    : own_(own),
      listener_(listener),
      members_(Read(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT,
                    [](dds_entity_t at, void* self) { static_cast<CycloneDiscovery*>(self)->TakeMembers(at); })),
      writers_(
          Read(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION,
               [](dds_entity_t at, void* self) { static_cast<CycloneDiscovery*>(self)->TakeEndpoints(at, true); })),
      readers_(Read(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, [](dds_entity_t at, void* self) {
        static_cast<CycloneDiscovery*>(self)->TakeEndpoints(at, false);
      })) {
  // What was there before the listeners.
  TakeMembers(members_);
  TakeEndpoints(writers_, true);
  TakeEndpoints(readers_, false);
}

CycloneDiscovery::~CycloneDiscovery() {
  for (const dds_entity_t reader : {members_, writers_, readers_}) (void)dds_delete(reader);
}

dds_entity_t CycloneDiscovery::Read(dds_entity_t participant, dds_entity_t topic, dds_on_data_available_fn on_data) {
  dds_listener_t* const listener = dds_create_listener(this);
  dds_lset_data_available(listener, on_data);
  const dds_entity_t reader = dds_create_reader(participant, topic, nullptr, listener);
  dds_delete_listener(listener);
  return reader;
}

void CycloneDiscovery::TakeMembers(dds_entity_t reader) {
  const std::lock_guard lock(mutex_);
  const bool is_told = TakeAll<dds_builtintopic_participant_t>(reader, [&](const auto& sample, const auto& info) {
    if (!IsThere(info)) return listener_.OnMemberGone(IdOf(sample.key));
    WireMember member{.id = IdOf(sample.key), .user_data = UserDataOf(sample.qos)};
    char* name = nullptr;
    if (dds_qget_entity_name(sample.qos, &name) && name != nullptr) member.name = name;
    dds_free(name);
    listener_.OnMember(member);
  });
  if (!is_told) listener_.OnMissed();
}

void CycloneDiscovery::TakeEndpoints(dds_entity_t reader, bool is_writer) {
  const std::lock_guard lock(mutex_);
  const bool is_told = TakeAll<dds_builtintopic_endpoint_t>(reader, [&](const auto& sample, const auto& info) {
    if (!IsThere(info)) return listener_.OnEndpointGone(IdOf(sample.key));
    WireEndpoint endpoint{.handle = info.instance_handle,
                          .id = IdOf(sample.key),
                          .participant = IdOf(sample.participant_key),
                          .is_writer = is_writer};
    endpoint.is_own = endpoint.participant == own_;
    if (sample.topic_name != nullptr) endpoint.options.topic = sample.topic_name;
    if (sample.type_name != nullptr) endpoint.options.type = sample.type_name;
    endpoint.options.qos = QosOf(sample.qos);
    endpoint.options.unmet = OtherPoliciesOf(sample.qos).Unmet(is_writer);
    endpoint.options.user_data = UserDataOf(sample.qos);
    listener_.OnEndpoint(endpoint);
  });
  if (!is_told) listener_.OnMissed();
}

}  // namespace runnel
