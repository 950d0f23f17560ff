#include "plugins/wire_fast/fast_endpoints.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/common/SerializedPayload.h>

#include "plugins/wire/matched_ends.h"
#include "plugins/wire_fast/fast_settings.h"

namespace runnel {

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint32_t kUsualSize = 256;  // room grows where values are larger
constexpr std::size_t kEncapsulation = 4;

/// A type of which only the name is known: what is written is `const Octets`, what is read `Octets`.
class OctetsType final : public dds::TopicDataType {
 public:
  explicit OctetsType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = kUsualSize;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& octets = *static_cast<const Octets*>(data);
    if (octets.size() < kEncapsulation || octets.size() > payload->max_size) return false;
    std::memcpy(payload->data, octets.data(), octets.size());
    payload->length = static_cast<std::uint32_t>(octets.size());
    payload->encapsulation = octets[1] == std::byte{1} ? CDR_LE : CDR_BE;
    return true;
  }
  // The length is read once: in memory that processes share it may change meanwhile.
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    const std::uint32_t length = payload->length;
    if (length < kEncapsulation || length > payload->max_size) return false;
    const auto* const begin = reinterpret_cast<const std::byte*>(payload->data);
    static_cast<Octets*>(data)->assign(begin, begin + length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [size = static_cast<std::uint32_t>(static_cast<const Octets*>(data)->size())] { return size; };
  }
  void* createData() override { return new Octets; }
  void deleteData(void* data) override { delete static_cast<Octets*>(data); }
  // Values without keys are all of one instance.
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

WireId IdOfHandle(const rtps::InstanceHandle_t& handle) {
  WireId id;
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = handle.value[i];
  return id;
}

WireIdentity IdentityOf(const rtps::SampleIdentity& identity) {
  const auto number = static_cast<std::int64_t>(identity.sequence_number().to64long());
  return {IdOf(identity.writer_guid()), std::max<std::int64_t>(number, 0)};
}

rtps::SampleIdentity SampleIdentityOf(const WireIdentity& identity) {
  rtps::SampleIdentity made;
  std::copy_n(identity.writer.begin(), rtps::GuidPrefix_t::size, made.writer_guid().guidPrefix.value);
  std::copy_n(identity.writer.begin() + rtps::GuidPrefix_t::size, rtps::EntityId_t::size,
              made.writer_guid().entityId.value);
  if (identity.number > 0) made.sequence_number(rtps::SequenceNumber_t(static_cast<std::uint64_t>(identity.number)));
  return made;
}

/// Lets callbacks in, one at a time, until it is shut; shutting waits for one that runs.
class Gate {
 public:
  template <typename Callback>
  void Pass(const Callback& callback) {
    const std::lock_guard lock(mutex_);
    if (is_open_) CallBack(callback);
  }
  void Shut() {
    const std::lock_guard lock(mutex_);
    is_open_ = false;
  }

 private:
  std::mutex mutex_;
  bool is_open_ = true;
};

/// How many there are at the other ends, without those of the same participant, which Fast DDS matches, too.
class Matches {
 public:
  Matches(const WireId& own, OnMatched on_matched) : own_(own), on_matched_(std::move(on_matched)) {}
  void Change(const rtps::InstanceHandle_t& other, std::int32_t change) {
    if (change == 0 || AreOfOneMember(IdOfHandle(other), own_)) return;
    const std::size_t count = ends_.Change(HandleOf(IdOfHandle(other)), change > 0);
    if (on_matched_) on_matched_(count);
  }
  [[nodiscard]] bool Has(std::uint64_t handle) const { return ends_.Has(handle); }

 private:
  const WireId own_;
  const OnMatched on_matched_;
  MatchedEnds ends_;
};

WireEndpoint OwnEndpoint(const WireId& id, const FastMember& member, const WireEndpointOptions& options,
                         bool is_writer) {
  return {.handle = HandleOf(id),
          .id = id,
          .participant = member.id(),
          .is_writer = is_writer,
          .is_own = true,
          .options = options};
}

class FastWriter final : public WireWriter, private dds::DataWriterListener {
 public:
  FastWriter(FastMember& member, OnMatched on_matched)
      : member_(member), matches_(member.id(), std::move(on_matched)) {}
  ~FastWriter() override {
    gate_.Shut();
    if (writer_ != nullptr) {
      member_.discovery().TellGone(id_);
      (void)member_.publisher().delete_datawriter(writer_);
    }
    if (topic_ != nullptr) member_.GiveBack(topic_);
  }

  Result<void> Begin(const WireEndpointOptions& options) {
    const auto topic = member_.TakeTopic(options.topic, options.type);
    if (!topic) return topic.error();
    topic_ = *topic;
    writer_ = member_.publisher().create_datawriter(topic_, WriterQosOf(options), this,
                                                    dds::StatusMask::publication_matched());
    if (writer_ == nullptr) return FastError("'" + options.topic + "' cannot be written");
    id_ = IdOf(writer_->guid());
    member_.discovery().Tell(OwnEndpoint(id_, member_, options, true));
    return {};
  }

  [[nodiscard]] const WireId& id() const noexcept override { return id_; }
  [[nodiscard]] bool HasReader(std::uint64_t reader) const override { return matches_.Has(reader); }

  Result<void> Write(const std::shared_ptr<const Octets>& octets, std::int64_t source_time) override {
    rtps::WriteParams parameters;
    return Write(*octets, source_time, parameters);
  }
  Result<WireIdentity> WriteRelated(const std::shared_ptr<const Octets>& octets, std::int64_t source_time,
                                    const WireIdentity& related) override {
    rtps::WriteParams parameters;
    parameters.related_sample_identity(SampleIdentityOf(related));
    if (const auto written = Write(*octets, source_time, parameters); !written) return written.error();
    return IdentityOf(parameters.sample_identity());
  }

 private:
  Result<void> Write(const Octets& octets, std::int64_t source_time, rtps::WriteParams& parameters) {
    parameters.source_timestamp().seconds(static_cast<std::int32_t>(source_time / kSecond));
    parameters.source_timestamp().nanosec(static_cast<std::uint32_t>(source_time % kSecond));
    if (writer_->write(const_cast<Octets*>(&octets), parameters)) return {};
    return FastError("a value could not be written");
  }
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override {
    gate_.Pass([&] { matches_.Change(status.last_subscription_handle, status.current_count_change); });
  }

  FastMember& member_;
  Gate gate_;
  Matches matches_;
  dds::Topic* topic_ = nullptr;
  dds::DataWriter* writer_ = nullptr;
  WireId id_{};
};

class FastReader final : public WireReader, private dds::DataReaderListener {
 public:
  FastReader(FastMember& member, OnSample on_sample, OnMatched on_matched)
      : member_(member), on_sample_(std::move(on_sample)), matches_(member.id(), std::move(on_matched)) {}
  ~FastReader() override {
    gate_.Shut();
    if (reader_ != nullptr) {
      member_.discovery().TellGone(id_);
      (void)member_.subscriber().delete_datareader(reader_);
    }
    if (topic_ != nullptr) member_.GiveBack(topic_);
  }

  Result<void> Begin(const WireEndpointOptions& options) {
    const auto topic = member_.TakeTopic(options.topic, options.type);
    if (!topic) return topic.error();
    topic_ = *topic;
    reader_ = member_.subscriber().create_datareader(topic_, ReaderQosOf(options), this,
                                                     dds::StatusMask::data_available()
                                                         << dds::StatusMask::subscription_matched());
    if (reader_ == nullptr) return FastError("'" + options.topic + "' cannot be read");
    id_ = IdOf(reader_->guid());
    member_.discovery().Tell(OwnEndpoint(id_, member_, options, false));
    return {};
  }

  [[nodiscard]] const WireId& id() const noexcept override { return id_; }

 private:
  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    gate_.Pass([&] { matches_.Change(status.last_publication_handle, status.current_count_change); });
  }
  // Taken at once: what stays would be in the way of what comes.
  void on_data_available(dds::DataReader* reader) override {
    gate_.Pass([&] {
      dds::SampleInfo info;
      while (reader->take_next_sample(&octets_, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
        if (info.valid_data) CallBack([&] { Look(info); });
      }
    });
  }
  void Look(const dds::SampleInfo& info) {
    const WireId writer = IdOf(info.sample_identity.writer_guid());
    if (AreOfOneMember(writer, member_.id())) return;
    on_sample_({octets_, info.source_timestamp.to_ns(), HandleOf(writer), IdentityOf(info.sample_identity),
                IdentityOf(info.related_sample_identity)});
  }

  FastMember& member_;
  const OnSample on_sample_;
  Gate gate_;
  Matches matches_;
  Octets octets_;
  dds::Topic* topic_ = nullptr;
  dds::DataReader* reader_ = nullptr;
  WireId id_{};
};

}  // namespace

FastMember::FastMember(dds::DomainParticipant& participant, FastDiscovery& discovery)
    : participant_(participant),
      discovery_(discovery),
      id_(IdOf(participant.guid())),
      publisher_(participant.create_publisher(dds::PublisherQos(), nullptr, dds::StatusMask::none())),
      subscriber_(participant.create_subscriber(dds::SubscriberQos(), nullptr, dds::StatusMask::none())) {}

FastMember::~FastMember() {
  (void)participant_.delete_publisher(publisher_);
  (void)participant_.delete_subscriber(subscriber_);
}

Result<dds::Topic*> FastMember::TakeTopic(const std::string& name, const std::string& type) {
  const std::lock_guard lock(mutex_);
  for (auto& [topic, count] : topics_) {
    if (topic->get_name() != name) continue;
    if (topic->get_type_name() != type) {
      return Error{
          .message = "the topic '" + name + "' is of type " + topic->get_type_name() + " here already, and not " + type,
          .hint = "Fast DDS has one type for each topic of an application; Cyclone DDS has several"};
    }
    ++count;
    return topic;
  }
  if (participant_.find_type(type).empty()) {
    (void)participant_.register_type(dds::TypeSupport(new OctetsType(type)), type);
  }
  dds::Topic* const topic = participant_.create_topic(name, type, dds::TopicQos());
  if (topic == nullptr) return FastError("there can be no topic '" + name + "'");
  topics_[topic] = 1;
  return topic;
}

void FastMember::GiveBack(dds::Topic* topic) {
  const std::lock_guard lock(mutex_);
  if (--topics_[topic] > 0) return;
  topics_.erase(topic);
  (void)participant_.delete_topic(topic);
}

Result<std::unique_ptr<WireWriter>> MakeFastWriter(FastMember& member, const WireEndpointOptions& options,
                                                   OnMatched on_matched) {
  auto writer = std::make_unique<FastWriter>(member, std::move(on_matched));
  if (const auto begun = writer->Begin(options); !begun) return begun.error();
  return std::unique_ptr<WireWriter>(std::move(writer));
}

Result<std::unique_ptr<WireReader>> MakeFastReader(FastMember& member, const WireEndpointOptions& options,
                                                   OnSample on_sample, OnMatched on_matched) {
  auto reader = std::make_unique<FastReader>(member, std::move(on_sample), std::move(on_matched));
  if (const auto begun = reader->Begin(options); !begun) return begun.error();
  return std::unique_ptr<WireReader>(std::move(reader));
}

}  // namespace runnel
