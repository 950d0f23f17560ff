#include "plugins/ros_services/service_endpoints.h"

#include <cstring>
#include <utility>

#include "plugins/ros_messages/names.h"
#include "plugins/ros_services/ros_time.h"

namespace runnel {

namespace {

// "clientid=1.f.…;": nodes on Cyclone know by it which reader and which writer are of one client, or one service.
std::string UserData(ServiceEndpoints::Side side, const WireId& participant, std::uint32_t identity) {
  WireId id = participant;
  std::memcpy(id.data() + id.size() - sizeof identity, &identity, sizeof identity);
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text = side == ServiceEndpoints::Side::kServer ? "serviceid=" : "clientid=";
  for (const std::uint8_t octet : id) {
    text += kDigits[octet >> 4];
    text += kDigits[octet & 15];
    text += '.';
  }
  text.back() = ';';
  return text;
}

}  // namespace

void ServiceInbox::Put(ServiceMessage message) {
  const std::lock_guard lock(mutex_);
  if (messages_.size() >= kMost) {
    lost_.fetch_add(1, std::memory_order_relaxed);
  } else {
    messages_.push_back(std::move(message));
  }
}

std::optional<ServiceMessage> ServiceInbox::Take() {
  const std::lock_guard lock(mutex_);
  if (messages_.empty()) return {};
  std::optional<ServiceMessage> first = std::move(messages_.front());
  messages_.pop_front();
  return first;
}

Result<std::unique_ptr<ServiceEndpoints>> ServiceEndpoints::Start(Side side, const ServiceTopics& topics,
                                                                  WireParticipant& participant, std::uint32_t identity,
                                                                  std::function<void()> on_news) {
  std::unique_ptr<ServiceEndpoints> made(new ServiceEndpoints(topics, std::move(on_news)));
  ServiceEndpoints& self = *made;
  const WireEndpointOptions request{.topic = DdsRequestTopic(topics.service),
                                    .type = topics.request_type,
                                    .qos = {.depth = topics.depth},
                                    .user_data = UserData(side, participant.id(), identity)};
  WireEndpointOptions reply = request;
  reply.topic = DdsReplyTopic(topics.service);
  reply.type = topics.response_type;
  const bool is_server = side == Side::kServer;
  auto writer = participant.MakeWriter(is_server ? reply : request, [&self](std::size_t count) {
    self.readers_.store(count, std::memory_order_relaxed);
    self.on_news_();
  });
  if (!writer) return writer.error();
  self.writer_ = std::move(*writer);
  std::uint64_t halves[2];
  std::memcpy(halves, self.writer_->id().data(), sizeof halves);
  self.client_ = halves[0] ^ halves[1];
  auto reader = participant.MakeReader(
      is_server ? request : reply,
      [&self, is_server](const WireSample& sample) {
        auto message = SplitCallId(sample.octets);
        if (!message || (!is_server && message->id.client != self.client_)) return;
        message->writer = sample.writer;
        self.inbox_.Put(std::move(*message));
        self.on_news_();
      },
      [&self](std::size_t count) {
        self.writers_.store(count, std::memory_order_relaxed);
        self.on_news_();
      });
  if (!reader) return reader.error();
  self.reader_ = std::move(*reader);
  return made;
}

Result<void> ServiceEndpoints::Send(const CallId& id, std::span<const std::byte> message) {
  return writer_->Write(std::make_shared<const Octets>(WithCallId(id, message)),
                        SinceEpoch().time_since_epoch().count());
}

}  // namespace runnel
