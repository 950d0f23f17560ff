#include "plugins/ros_services/service_endpoints.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/ranges.h>

#include "core/base/erase_where.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/network_discovery/value_form.h"
#include "plugins/ros_messages/names.h"
#include "plugins/ros_services/ros_time.h"

namespace runnel {

namespace {

constexpr const char* kClientId = "clientid=";

// "clientid=1.f.…;typehash=RIHS01_…;": nodes on Cyclone know by the first which reader and which writer are of one client, or
// one service.
std::string UserData(ServiceEndpoints::Side side, const WireId& participant, std::uint32_t identity,
                     const ServiceType& type) {
  WireId id = participant;
  std::memcpy(id.data() + id.size() - sizeof identity, &identity, sizeof identity);
  return fmt::format("{}{:02x};{}", side == ServiceEndpoints::Side::kServer ? "serviceid=" : kClientId,
                     fmt::join(id, "."), type.hash.empty() ? "" : TypeHashText(type.hash));
}

// What eight octets can have of sixteen.
WireId Folded(const WireId& id) {
  WireId folded{};
  for (std::size_t i = 0; i < id.size() / 2; ++i) folded[i] = static_cast<std::uint8_t>(id[i] ^ id[i + id.size() / 2]);
  return folded;
}

// Of eight octets each: what follows is aligned as without it.
constexpr std::size_t kIdSize = sizeof(std::uint64_t) + sizeof(CallId::number);

constexpr std::size_t kMostClocks = 64;

}  // namespace

Result<std::unique_ptr<ServiceEndpoints>> ServiceEndpoints::Start(Side side, const ServiceTopics& topics,
                                                                  WireParticipant& participant, std::uint32_t identity,
                                                                  std::function<void()> on_news) {
  std::unique_ptr<ServiceEndpoints> made(new ServiceEndpoints(side, topics, std::move(on_news)));
  ServiceEndpoints& self = *made;
  const WireEndpointOptions request{.topic = DdsRequestTopic(topics.service),
                                    .type = topics.request.name,
                                    .qos = {.is_latched = topics.is_latched, .depth = topics.depth},
                                    .user_data = UserData(side, participant.id(), identity, topics.request)};
  WireEndpointOptions reply = request;
  reply.topic = DdsReplyTopic(topics.service);
  reply.type = topics.response.name;
  reply.user_data = UserData(side, participant.id(), identity, topics.response);
  const bool is_server = side == Side::kServer;
  auto writer = participant.MakeWriter(is_server ? reply : request, [&self](std::size_t count) {
    self.readers_.store(count, std::memory_order_relaxed);
    self.on_news_();
  });
  if (!writer) return writer.error();
  self.writer_ = std::move(*writer);
  auto reader = participant.MakeReader(
      is_server ? request : reply,
      [&self](const WireSample& sample) {
        try {
          auto message = self.Read(sample);
          if (!message) return;
          self.Keep(std::move(*message));
        } catch (...) {  // for want of memory
          self.lost_.fetch_add(1, std::memory_order_relaxed);
        }
        self.on_news_();
      },
      [&self](std::size_t count) {
        self.writers_.store(count, std::memory_order_relaxed);
        self.on_news_();
      });
  if (!reader) return reader.error();
  self.reader_ = std::move(*reader);
  self.client_ = topics.dialect == ServiceDialect::kBeside ? self.reader_->id() : Folded(self.writer_->id());
  return made;
}

// By a thread of the engine, which does not know yet whose the replies are.
std::optional<ServiceMessage> ServiceEndpoints::Read(const WireSample& sample) {
  std::optional<ServiceMessage> message;
  if (topics_.dialect == ServiceDialect::kInFront) {
    message = SplitCallId(sample.octets);
  } else {
    message.emplace();
    message->message.assign(sample.octets.begin(), sample.octets.end());
    message->id = {sample.related.writer, sample.related.number};
    // Of a request, its own number counts, and where its reply goes may not be said.
    if (side_ == Side::kServer) message->id.number = sample.identity.number;
    if (side_ == Side::kServer && message->id.client == WireId{}) message->id.client = sample.identity.writer;
  }
  if (!message) return message;
  message->id.writer = sample.writer;
  if (clocks_.size() >= kMostClocks && !clocks_.contains(sample.writer))
    clocks_.clear();  // each call may be of a new client
  WriterClock& clock = clocks_[sample.writer];
  (void)clock.HeldUp(SinceEpoch().time_since_epoch() - Duration(sample.source_time), SteadyClock().Now());
  message->sent = clock.sent();
  return message;
}

// Servers that look only at who has written the request, as DDS without ROS has them, answer to the writer.
bool ServiceEndpoints::IsForThis(const CallId& id) const noexcept {
  if (id.number <= 0) return false;  // whoever answers does not say which call
  return id.client == client_ || (topics_.dialect == ServiceDialect::kBeside && id.client == writer_->id());
}

void ServiceEndpoints::Keep(ServiceMessage message) {
  const std::lock_guard lock(mutex_);
  if (messages_.size() >= std::max<std::size_t>(kMostMessages, topics_.depth)) {
    lost_.fetch_add(1, std::memory_order_relaxed);
  } else {
    messages_.push_back(std::move(message));
  }
}

std::size_t ServiceEndpoints::waiting() {
  const std::lock_guard lock(mutex_);
  return messages_.size();
}

std::optional<ServiceMessage> ServiceEndpoints::Take() {
  const std::lock_guard lock(mutex_);
  while (!messages_.empty()) {
    ServiceMessage first = std::move(messages_.front());
    messages_.pop_front();
    if (side_ == Side::kServer || IsForThis(first.id)) return first;
  }
  return {};
}

Result<std::int64_t> ServiceEndpoints::Send(const CallId& id, std::span<const std::byte> message) {
  const std::int64_t now = SinceEpoch().time_since_epoch().count();
  if (topics_.dialect == ServiceDialect::kInFront) {
    const auto sent = writer_->Write(std::make_shared<const Octets>(WithCallId(id, message)), now);
    return sent ? Result<std::int64_t>(id.number) : sent.error();
  }
  const auto octets = std::make_shared<const Octets>(message.begin(), message.end());
  const auto sent = writer_->WriteRelated(octets, now, {.writer = id.client, .number = id.number});
  return sent ? Result<std::int64_t>(sent->number) : sent.error();
}

Result<std::int64_t> ServiceEndpoints::Request(std::span<const std::byte> message) {
  return Send({client_, topics_.dialect == ServiceDialect::kInFront ? ++made_ : 0}, message);
}

// Whether the reader of the answer is one that is there, or is to come, and is not matched yet: on Fast DDS the one that the
// request names, on Cyclone the one with the same clientid as who has sent it.
bool ServiceEndpoints::IsAwaited(const CallId& id) const {
  constexpr std::uint8_t kIsReader = 4;  // in the last octet of its id; else it names who has sent the request
  const bool is_beside = topics_.dialect == ServiceDialect::kBeside;
  const auto client = topics_.table != nullptr ? topics_.table->FindWriter(id.writer) : std::nullopt;
  if (!client || (is_beside && (id.client.back() & kIsReader) == 0)) return false;
  const std::string& said = client->options.user_data;
  const std::size_t begin = said.find(kClientId);
  if (!is_beside && begin == std::string::npos) return false;
  const std::string name = is_beside ? "" : said.substr(begin, said.find(';', begin) + 1 - begin);
  return std::ranges::none_of(
      topics_.table->Partners(DdsReplyTopic(topics_.service), false), [&](const WireEndpoint& each) {
        const bool is_it = is_beside ? each.id == id.client : each.options.user_data.find(name) != std::string::npos;
        return is_it && writer_->HasReader(each.handle);
      });
}

void ServiceEndpoints::SendKept() {
  constexpr auto kLongest = std::chrono::seconds(10);
  const Time now = SteadyClock().Now();
  EraseWhere(kept_, [&](const KeptReply& each) {
    if (IsAwaited(each.id)) return now - each.since > kLongest;
    (void)Send(each.id, each.message);
    return true;
  });
}

Result<void> ServiceEndpoints::Reply(const CallId& id, std::span<const std::byte> message) {
  if (kept_.size() < kMostMessages && IsAwaited(id)) {
    kept_.push_back({id, Octets(message.begin(), message.end()), SteadyClock().Now()});
    return {};
  }
  const auto sent = Send(id, message);
  return sent ? Result<void>() : sent.error();
}

Octets WithCallId(const CallId& id, std::span<const std::byte> message) {
  Octets octets;
  CdrWriter writer(octets);
  std::uint64_t client;
  std::memcpy(&client, id.client.data(), sizeof client);
  writer.Put(client);
  writer.Put(id.number);
  const auto rest = message.subspan(std::min(message.size(), CdrWriter::kHeader));
  octets.insert(octets.end(), rest.begin(), rest.end());
  return octets;
}

std::optional<ServiceMessage> SplitCallId(std::span<const std::byte> octets) {
  ServiceMessage split;
  auto reader = CdrReader::Begin(octets);
  std::uint64_t client = 0;
  if (!reader || !reader->Get(client) || !reader->Get(split.id.number)) return {};
  std::memcpy(split.id.client.data(), &client, sizeof client);
  const auto header = octets.first(CdrWriter::kHeader), rest = octets.subspan(CdrWriter::kHeader + kIdSize);
  split.message.assign(header.begin(), header.end());
  split.message.insert(split.message.end(), rest.begin(), rest.end());
  return split;
}

}  // namespace runnel
