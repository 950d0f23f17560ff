// A node that calls services and has one, as those of ROS 2 on its default middleware do (rmw_fastrtps): by Fast DDS's own
// interface and Fast CDR, and nothing of Runnel is in it. It says on standard output what comes:
//
//     fast_service_node DOMAIN call         calls /lamp/switch (SetBool) and /lamp/warm (Trigger)
//     fast_service_node DOMAIN serve        has /house/switch (SetBool), which refuses each second call
//     fast_service_node DOMAIN serve_plain  the same, and answers to the writers of requests, as DDS without ROS does

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

namespace {

namespace dds = eprosima::fastdds::dds;
namespace cdr = eprosima::fastcdr;
namespace rtps = eprosima::fastrtps::rtps;

/// What is in requests and responses of std_srvs.
struct Message {
  bool flag = false;      // "data" of a request, "success" of a response
  std::string text = {};  // "message" of a response
};

enum class Kind { kSetBoolRequest, kTriggerRequest, kResponse };

class MessageType final : public dds::TopicDataType {
 public:
  MessageType(Kind kind, const std::string& name) : kind_(kind) {
    setName(name.c_str());
    m_typeSize = kRoom;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& message = *static_cast<const Message*>(data);
    cdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    cdr::Cdr to(buffer, cdr::Cdr::DEFAULT_ENDIAN, cdr::Cdr::DDS_CDR);
    payload->encapsulation = to.endianness() == cdr::Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
    to.serialize_encapsulation();
    if (kind_ == Kind::kTriggerRequest) {
      to << std::uint8_t{0};  // structure_needs_at_least_one_member
    } else {
      to << message.flag;
    }
    if (kind_ == Kind::kResponse) to << message.text;
    payload->length = static_cast<std::uint32_t>(to.getSerializedDataLength());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    auto& message = *static_cast<Message*>(data);
    cdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    cdr::Cdr from(buffer, cdr::Cdr::DEFAULT_ENDIAN, cdr::Cdr::DDS_CDR);
    try {
      from.read_encapsulation();
      if (kind_ != Kind::kTriggerRequest) from >> message.flag;
      if (kind_ == Kind::kResponse) from >> message.text;
    } catch (const cdr::exception::Exception& wrong) {
      std::printf("unreadable: %s\n", wrong.what());
      return false;
    }
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return kRoom; };
  }
  void* createData() override { return new Message; }
  void deleteData(void* data) override { delete static_cast<Message*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }

 private:
  static constexpr std::uint32_t kRoom = 1000;
  const Kind kind_;
};

template <typename Qos>
Qos ServiceQos(Qos qos) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 10;
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  return qos;
}

void Pause() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

/// A writer and a reader, of which one is of requests and the other of replies.
class Ends {
 public:
  Ends(dds::DomainParticipant& participant, const std::string& service, const std::string& type, Kind request,
       bool is_server) {
    const auto topic = [&](const std::string& name, Kind kind, const std::string& suffix) {
      const dds::TypeSupport support(new MessageType(kind, "std_srvs::srv::dds_::" + type + suffix));
      (void)support.register_type(&participant);
      return participant.create_topic(name, support.get_type_name(), dds::TOPIC_QOS_DEFAULT);
    };
    dds::Topic* const requests = topic("rq/" + service + "Request", request, "_Request_");
    dds::Topic* const replies = topic("rr/" + service + "Reply", Kind::kResponse, "_Response_");
    reader_ = participant.create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT)
                  ->create_datareader(is_server ? requests : replies, ServiceQos(dds::DATAREADER_QOS_DEFAULT));
    writer_ = participant.create_publisher(dds::PUBLISHER_QOS_DEFAULT)
                  ->create_datawriter(is_server ? replies : requests, ServiceQos(dds::DATAWRITER_QOS_DEFAULT));
  }
  [[nodiscard]] dds::DataWriter& writer() const { return *writer_; }
  [[nodiscard]] dds::DataReader& reader() const { return *reader_; }

  /// The next message, with what is said beside it.
  std::pair<Message, dds::SampleInfo> Take() const {
    for (;;) {
      std::pair<Message, dds::SampleInfo> taken;
      const bool has_come =
          reader_->take_next_sample(&taken.first, &taken.second) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
      if (has_come && taken.second.valid_data) return taken;
      if (!has_come) Pause();
    }
  }
  void WaitUntilMatched() const {
    for (;;) {
      dds::PublicationMatchedStatus readers;
      dds::SubscriptionMatchedStatus writers;
      (void)writer_->get_publication_matched_status(readers);
      (void)reader_->get_subscription_matched_status(writers);
      if (readers.current_count > 0 && writers.current_count > 0) return;
      Pause();
    }
  }

 private:
  dds::DataReader* reader_;
  dds::DataWriter* writer_;
};

// Says whose replies it reads, and takes that one which belongs to its request.
Message CallOnce(const Ends& client, Message request) {
  rtps::WriteParams parameters;
  parameters.related_sample_identity().writer_guid(client.reader().guid());
  if (!client.writer().write(&request, parameters)) std::printf("the request cannot be written\n");
  for (;;) {
    const auto [reply, info] = client.Take();
    const rtps::SampleIdentity& belongs_to = info.related_sample_identity;
    if (belongs_to.writer_guid() == client.reader().guid() &&
        belongs_to.sequence_number() == parameters.sample_identity().sequence_number()) {
      return reply;
    }
    std::printf("a reply to somebody else\n");
  }
}

void Call(dds::DomainParticipant& participant) {
  const Ends lamp(participant, "lamp/switch", "SetBool", Kind::kSetBoolRequest, false);
  lamp.WaitUntilMatched();
  for (int count = 1; count <= 3; ++count) {
    const Message reply = CallOnce(lamp, {.flag = count != 2});
    std::printf("switch %d: %s '%s'\n", count, reply.flag ? "done" : "refused", reply.text.c_str());
  }
  const Ends warm(participant, "lamp/warm", "Trigger", Kind::kTriggerRequest, false);
  warm.WaitUntilMatched();
  const Message reply = CallOnce(warm, {});
  std::printf("warm: %s '%s'\n", reply.flag ? "done" : "refused", reply.text.c_str());
}

void Serve(dds::DomainParticipant& participant, bool is_plain) {
  const Ends house(participant, "house/switch", "SetBool", Kind::kSetBoolRequest, true);
  for (int count = 1;; ++count) {
    const auto [request, info] = house.Take();
    std::printf("asked %d: %s\n", count, request.flag ? "on" : "off");
    std::fflush(stdout);
    rtps::WriteParams to;
    to.related_sample_identity() = info.sample_identity;
    const rtps::GUID_t reader = info.related_sample_identity.writer_guid();
    if (!is_plain && reader != rtps::GUID_t::unknown()) to.related_sample_identity().writer_guid(reader);
    rtps::WriteParams to_somebody_else = to;  // nobody of Runnel's may take it
    to_somebody_else.related_sample_identity().writer_guid(house.writer().guid());
    Message wrong{.flag = true, .text = "the lights of others"};
    (void)house.writer().write(&wrong, to_somebody_else);
    Message reply{.flag = count % 2 == 1, .text = count % 2 == 1 ? "lights are on" : "the fuse is out"};
    (void)house.writer().write(&reply, to);
  }
}

dds::DomainParticipant* Join(int domain) {
  dds::DomainParticipantQos qos;
  qos.name("/");
  const std::string enclave = "enclave=/;";
  qos.user_data().data_vec({enclave.begin(), enclave.end()});
  qos.transport().use_builtin_transports = false;  // shared memory would be left behind by who is killed
  qos.transport().user_transports.push_back(std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>());
  return dds::DomainParticipantFactory::get_instance()->create_participant(static_cast<std::uint32_t>(domain), qos);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  auto* const participant = Join(std::atoi(argv[1]));
  const std::string what = argv[2];
  if (participant == nullptr) return 1;
  if (what == "call") Call(*participant);
  if (what == "serve" || what == "serve_plain") Serve(*participant, what == "serve_plain");
  std::fflush(stdout);
  std::_Exit(0);  // what it has made need not be taken apart
}
