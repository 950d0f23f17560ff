#include "plugins/wire_cyclone/cyclone_wire.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

#include <dds/dds.h>

#include "plugins/wire_cyclone/cyclone_discovery.h"
#include "plugins/wire_cyclone/cyclone_domain.h"
#include "plugins/wire_cyclone/octets_type.h"

namespace runnel {

namespace {

constexpr std::size_t kAlignment = 4;

WireId IdOf(dds_entity_t entity) {
  WireId id{};
  dds_guid_t guid{};
  if (dds_get_guid(entity, &guid) == DDS_RETCODE_OK) std::memcpy(id.data(), guid.v, sizeof id);
  return id;
}

class CycloneWriter final : public WireWriter {
 public:
  explicit CycloneWriter(OnMatched on_matched) : on_matched_(std::move(on_matched)) {}
  ~CycloneWriter() override {
    if (writer_ > 0) (void)dds_delete(writer_);  // waits for callbacks
  }

  Result<void> Begin(dds_entity_t participant, dds_entity_t topic, const ddsi_sertype* type,
                     const WireEndpointOptions& options) {
    type_ = type;
    dds_qos_t* const qos = MakeQos(options, true);
    dds_listener_t* const listener = dds_create_listener(this);
    dds_lset_publication_matched(listener, [](dds_entity_t, dds_publication_matched_status_t status, void* self) {
      const auto& on_matched = static_cast<CycloneWriter*>(self)->on_matched_;
      if (on_matched) CallBack([&] { on_matched(status.current_count); });
    });
    writer_ = dds_create_writer(participant, topic, qos, listener);
    dds_delete_listener(listener);
    dds_delete_qos(qos);
    if (writer_ < 0) return CycloneError("'" + options.topic + "' cannot be written", writer_);
    id_ = IdOf(writer_);
    return {};
  }

  [[nodiscard]] const WireId& id() const noexcept override { return id_; }

  [[nodiscard]] bool HasReader(std::uint64_t reader) const override {
    std::vector<dds_instance_handle_t> readers(dds_get_matched_subscriptions(writer_, nullptr, 0) + 16);
    const dds_return_t count = dds_get_matched_subscriptions(writer_, readers.data(), readers.size());
    readers.resize(std::min(readers.size(), static_cast<std::size_t>(std::max(count, 0))));
    return std::ranges::find(readers, reader) != readers.end();
  }

  Result<void> Write(const std::shared_ptr<const Octets>& octets, std::int64_t source_time) override {
    std::shared_ptr<const Octets> whole = octets;
    if (octets->size() % kAlignment != 0) {
      auto padded = std::make_shared<Octets>(*octets);
      padded->resize((octets->size() + kAlignment - 1) / kAlignment * kAlignment);
      whole = std::move(padded);
    }
    const dds_return_t written = dds_forwardcdr(writer_, MakeOctetsValue(*type_, std::move(whole), source_time));
    if (written != DDS_RETCODE_OK) return CycloneError("a value could not be written", written);
    return {};
  }

 private:
  const OnMatched on_matched_;
  const ddsi_sertype* type_ = nullptr;  // the topic's, which the writer keeps
  dds_entity_t writer_ = 0;
  WireId id_{};
};

class CycloneReader final : public WireReader {
 public:
  CycloneReader(OnSample on_sample, OnMatched on_matched)
      : on_sample_(std::move(on_sample)), on_matched_(std::move(on_matched)) {}
  ~CycloneReader() override {
    if (reader_ > 0) (void)dds_delete(reader_);
  }

  Result<void> Begin(dds_entity_t participant, dds_entity_t topic, const WireEndpointOptions& options) {
    dds_qos_t* const qos = MakeQos(options, false);
    dds_listener_t* const listener = dds_create_listener(this);
    dds_lset_data_available(
        listener, [](dds_entity_t reader, void* self) { static_cast<CycloneReader*>(self)->TakeAll(reader); });
    dds_lset_subscription_matched(listener, [](dds_entity_t, dds_subscription_matched_status_t status, void* self) {
      const auto& on_matched = static_cast<CycloneReader*>(self)->on_matched_;
      if (on_matched) CallBack([&] { on_matched(status.current_count); });
    });
    reader_ = dds_create_reader(participant, topic, qos, listener);
    dds_delete_listener(listener);
    dds_delete_qos(qos);
    if (reader_ < 0) return CycloneError("'" + options.topic + "' cannot be read", reader_);
    id_ = IdOf(reader_);
    return {};
  }

  [[nodiscard]] const WireId& id() const noexcept override { return id_; }

 private:
  void TakeAll(dds_entity_t reader) {
    constexpr std::uint32_t kFew = 8;
    const std::lock_guard lock(mutex_);
    for (;;) {
      ddsi_serdata* values[kFew] = {};
      dds_sample_info_t infos[kFew];
      const dds_return_t count = dds_takecdr(reader, values, kFew, infos, DDS_ANY_STATE);
      if (count <= 0) return;
      for (dds_return_t i = 0; i < count; ++i) {
        if (infos[i].valid_data) {
          const auto& octets = *static_cast<const OctetsValue*>(values[i])->octets;
          CallBack([&] { on_sample_({octets, infos[i].source_timestamp, infos[i].publication_handle}); });
        }
        ddsi_serdata_unref(values[i]);
      }
    }
  }

  const OnSample on_sample_;
  const OnMatched on_matched_;
  std::mutex mutex_;
  dds_entity_t reader_ = 0;
  WireId id_{};
};

class CycloneParticipant final : public WireParticipant {
 public:
  CycloneParticipant(std::shared_ptr<CycloneDomain> domain, dds_entity_t participant, WireDiscovery& discovery,
                     std::shared_ptr<void> refusals)
      : domain_(std::move(domain)),
        participant_(participant),
        id_(IdOf(participant)),
        refusals_(std::move(refusals)),
        discovery_(std::make_unique<CycloneDiscovery>(participant, id_, discovery)) {}
  ~CycloneParticipant() override {
    discovery_.reset();
    (void)dds_delete(participant_);
  }

  [[nodiscard]] const WireId& id() const noexcept override { return id_; }

  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) override {
    auto writer = std::make_unique<CycloneWriter>(std::move(on_matched));
    const auto begun = WithTopic(options, [&](dds_entity_t topic, const ddsi_sertype* type) {
      return writer->Begin(participant_, topic, type, options);
    });
    if (!begun) return WithPermissionHint(begun.error(), refusals_ != nullptr, options, true);
    return std::unique_ptr<WireWriter>(std::move(writer));
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                 OnMatched on_matched) override {
    auto reader = std::make_unique<CycloneReader>(std::move(on_sample), std::move(on_matched));
    const auto begun = WithTopic(
        options, [&](dds_entity_t topic, const ddsi_sertype*) { return reader->Begin(participant_, topic, options); });
    if (!begun) return WithPermissionHint(begun.error(), refusals_ != nullptr, options, false);
    return std::unique_ptr<WireReader>(std::move(reader));
  }

 private:
  // Endpoints keep the topic; the entity itself is needed only to make them.
  template <typename Use>
  Result<void> WithTopic(const WireEndpointOptions& options, const Use& use) {
    ddsi_sertype* type = MakeOctetsType(options.type);
    const dds_entity_t topic =
        dds_create_topic_sertype(participant_, options.topic.c_str(), &type, nullptr, nullptr, nullptr);
    if (topic < 0) {
      ddsi_sertype_unref(type);
      return CycloneError("there can be no topic '" + options.topic + "'", topic);
    }
    const Result<void> used = use(topic, type);
    (void)dds_delete(topic);
    return used;
  }

  const std::shared_ptr<CycloneDomain> domain_;
  const dds_entity_t participant_;
  const WireId id_;
  const std::shared_ptr<void> refusals_;
  std::unique_ptr<CycloneDiscovery> discovery_;
};

class CycloneWire final : public WireEngine {
 public:
  Result<std::unique_ptr<WireParticipant>> Join(const WireMemberOptions& options, WireDiscovery& discovery) override {
    auto domain = CycloneDomain::Join(options);
    if (!domain) return domain.error();
    dds_qos_t* const qos = dds_create_qos();
    if (!options.user_data.empty()) dds_qset_userdata(qos, options.user_data.data(), options.user_data.size());
    if (!options.name.empty()) dds_qset_entity_name(qos, options.name.c_str());
    if (options.security) {
      if (const auto set = SetSecurity(*qos, *options.security); !set) {
        dds_delete_qos(qos);
        return set.error();
      }
    }
    const dds_entity_t participant = dds_create_participant(options.domain, qos, nullptr);
    dds_delete_qos(qos);
    if (participant < 0) {
      Error error = CycloneError("the network cannot be joined", participant);
      if (options.security) error.hint = KeyFilesHint(*options.security);
      return error;
    }
    std::shared_ptr<void> refusals;
    if (options.security) {
      refusals = HearRefusals([&discovery](const std::string& why) { discovery.OnRefused(why); });
    }
    return std::unique_ptr<WireParticipant>(
        new CycloneParticipant(std::move(*domain), participant, discovery, std::move(refusals)));
  }
};

}  // namespace

std::shared_ptr<WireEngine> MakeCycloneWire() { return std::make_shared<CycloneWire>(); }

}  // namespace runnel
