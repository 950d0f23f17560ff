#include "plugins/foxglove/internal/server_messages.h"

#include <algorithm>

#include "plugins/foxglove/internal/foxglove_shared.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

template <typename N>
void AppendLittleEndian(N number, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof(N); ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
}

std::uint64_t Nanoseconds(Time time) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, time.time_since_epoch().count()));
}

void AddTopics(JsonObject& message, const char* field, const char* ids,
               const std::map<std::string, const std::vector<std::string>*>& topics) {
  JsonArray list(message.Key(field));
  for (const auto& [name, paths] : topics) {
    JsonObject topic(list.Next());
    AppendList(*paths, topic.Add("name", name).Key(ids), AppendJsonString);
  }
}

}  // namespace

std::string ServerInfoMessage(const FoxgloveShared& shared) {
  return JsonObjectText([&](JsonObject& message) {
    message.Add("op", "serverInfo").Add("name", shared.application.name);
    // The last two for all, since whoever may look may press STOP.
    message.AddJson("capabilities",
                    R"(["time","parameters","parametersSubscribe","connectionGraph","clientPublish","services"])");
    message.AddJson("supportedEncodings", R"(["json"])");
    JsonObject(message.Key("metadata")).Add("runnel", shared.application.version);
    message.Add("sessionId", shared.session);
  });
}

std::string StatusMessage(StatusLevel level, std::string_view text) {
  return JsonObjectText([&](JsonObject& message) {
    message.Add("op", "status").Add("level", static_cast<int>(level)).Add("message", text);
  });
}

std::string AdvertiseMessageFor(std::span<const DirectoryChannel* const> channels) {
  return JsonObjectText([&](JsonObject& message) {
    JsonArray list(message.Add("op", "advertise").Key("channels"));
    for (const DirectoryChannel* each : channels) {
      JsonObject channel(list.Next());
      channel.Add("id", each->id).Add("topic", each->topic).Add("encoding", "json");
      channel.Add("schemaName", each->encoding->schema_name);
      channel.Add("schema", each->encoding->schema).Add("schemaEncoding", "jsonschema");
    }
  });
}

std::string UnadvertiseMessageFor(std::string_view op, std::string_view key, std::span<const std::uint32_t> ids) {
  return JsonObjectText(
      [&](JsonObject& message) { AppendList(ids, message.Add("op", op).Key(key), AppendJsonNumber<std::uint32_t>); });
}

std::string AdvertiseServicesMessage(std::span<const DirectoryService* const> services) {
  return JsonObjectText([&](JsonObject& message) {
    JsonArray list(message.Add("op", "advertiseServices").Key("services"));
    for (const DirectoryService* each : services) {
      JsonObject service(list.Next());
      service.Add("id", each->id).Add("name", each->name).Add("type", each->type);
      // Both ways in which versions of the protocol have it.
      service.Add("requestSchema", each->request_schema).Add("responseSchema", each->reply_schema);
      const auto add = [&](const char* key, const std::string& schema) {
        JsonObject(service.Key(key))
            .Add("encoding", "json")
            .Add("schemaName", each->type + " " + key)
            .Add("schemaEncoding", "jsonschema")
            .Add("schema", schema);
      };
      add("request", each->request_schema);
      add("response", each->reply_schema);
    }
  });
}

std::string ServiceFailureMessage(std::uint32_t service, std::uint32_t call, std::string_view why) {
  return JsonObjectText([&](JsonObject& message) {
    message.Add("op", "serviceCallFailure").Add("serviceId", service).Add("callId", call).Add("message", why);
  });
}

std::string ServiceReplyMessage(std::uint32_t service, std::uint32_t call, std::string_view json) {
  constexpr std::string_view kEncoding = "json";
  std::string bytes = "\x03";
  AppendLittleEndian(service, bytes);
  AppendLittleEndian(call, bytes);
  AppendLittleEndian(static_cast<std::uint32_t>(kEncoding.size()), bytes);
  return bytes.append(kEncoding).append(json);
}

std::string GraphMessage(const std::map<std::string, GraphTopic>& before,
                         const std::map<std::string, GraphTopic>& now) {
  std::map<std::string, const std::vector<std::string>*> published, subscribed;
  for (const auto& [name, topic] : now) {
    const auto old = before.find(name);
    if (old != before.end() && old->second == topic) continue;
    published[name] = &topic.publishers;
    subscribed[name] = &topic.subscribers;
  }
  return JsonObjectText([&](JsonObject& message) {
    message.Add("op", "connectionGraphUpdate");
    AddTopics(message, "publishedTopics", "publisherIds", published);
    AddTopics(message, "subscribedTopics", "subscriberIds", subscribed);
    message.AddJson("advertisedServices", "[]");
    {
      JsonArray removed(message.Key("removedTopics"));
      for (const auto& [name, topic] : before) {
        if (!now.contains(name)) removed.Add(name);
      }
    }
    message.AddJson("removedServices", "[]");
  });
}

void AppendMessageHead(std::uint32_t subscription, Time timestamp, std::string& bytes) {
  bytes += '\x01';
  AppendLittleEndian(subscription, bytes);
  AppendLittleEndian(Nanoseconds(timestamp), bytes);
}

std::string TimeMessage(Time now) {
  std::string bytes = "\x02";
  AppendLittleEndian(Nanoseconds(now), bytes);
  return bytes;
}

}  // namespace runnel::internal
