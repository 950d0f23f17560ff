#include "plugins/values/foxglove_channel.h"

#include <array>

#include "core/log/log_sink.h"
#include "core/types/type_info.h"
#include "plugins/values/internal/message_parts.h"
#include "plugins/values/json_reader.h"
#include "plugins/values/json_writer.h"

namespace runnel {

std::string TopicOf(const FrameworkElement& element) {
  std::vector<const std::string*> names;
  for (const FrameworkElement* at = &element; at->parent() != nullptr; at = at->parent()) {
    if (at->kind() != ElementKind::kPortGroup) names.push_back(&at->name());
  }
  if (names.size() > 1) names.pop_back();  // the application
  std::string topic;
  for (auto name = names.rbegin(); name != names.rend(); ++name) topic += "/" + **name;
  return topic;
}

const Port* RobotPose(std::span<const Port* const> ports) {
  const Port* best = nullptr;
  std::size_t most = 0;
  for (const Port* port : ports) {
    if (port->is_proxy() || port->direction() != Port::Direction::kOutput) continue;
    if (port->type().semantic_tag() != "pose") continue;
    const std::size_t readers = port->Sinks().size();
    if (best != nullptr && readers <= most) continue;
    best = port;
    most = readers;
  }
  return best;
}

namespace {

using internal::Drawing;

constexpr std::array<const Drawing*, 8> kDrawings{&internal::kPoseDrawing,      &internal::kPathDrawing,
                                                  &internal::kRangeScanDrawing, &internal::kImageDrawing,
                                                  &internal::kPointDrawing,     &internal::kHitAndLeavePointsDrawing,
                                                  &internal::kDrawingDrawing,   &internal::kWorldMapDrawing};

bool IsList(const TypeInfo& type) { return type.kind() == TypeKind::kSequence || type.kind() == TypeKind::kMatrix; }

// Foxglove refuses a channel whose schema has lists of lists, and reads it well without a schema.
bool IsListOfLists(const TypeInfo& type) {
  return type.kind() == TypeKind::kMatrix || (type.kind() == TypeKind::kSequence && IsList(*type.elements().type));
}

// Messages are objects; what is none is put into one.
std::string WrappedSchema(const TypeInfo& type) {
  return JsonObjectText([&](JsonObject& schema) {
    schema.Add("type", "object").Add("title", type.name());
    JsonObject(schema.Key("properties")).AddJson("value", JsonSchemaOf(type));
    schema.AddJson("required", R"(["value"])");
  });
}

FoxgloveChannel PlainChannel(const TypeInfo& type, std::string_view topic, const JsonLimits& limits) {
  const bool is_object = type.kind() == TypeKind::kStructure;
  FoxgloveChannel channel{std::string(topic), type.name(), "", {}};
  if (!type.HasPart(IsListOfLists)) {
    channel.schema = is_object ? JsonSchemaOf(type) : WrappedSchema(type);
  }
  channel.append = [&type, is_object, limits](const void* value, Time, std::string& json) {
    if (!is_object) json += "{\"value\":";
    AppendJson(type, value, json, limits);
    if (!is_object) json += '}';
  };
  return channel;
}

FoxgloveChannel DrawnChannel(const Drawing& drawing, const TypeInfo& type, std::string topic) {
  return {std::move(topic), std::string("foxglove.").append(drawing.schema), internal::FoxgloveSchema(drawing.schema),
          [&type, append = drawing.append](const void* value, Time timestamp, std::string& json) {
            append({type, value}, timestamp, json);
          }};
}

// By the numbers of foxglove.LogLevel, of which 5 is fatal.
int NumberOf(LogLevel level) { return level == LogLevel::kOff ? 0 : static_cast<int>(level) + 1; }

// Where in a source it was said is not known.
void AppendLog(const LogMessage& said, Time timestamp, std::string& json) {
  JsonObject message(json);
  internal::AppendTime(timestamp, message.Key("timestamp"));
  message.Add("level", NumberOf(said.level)).Add("message", said.TextWithCount());
  message.Add("name", said.path).Add("file", "").Add("line", 0);
}

}  // namespace

std::vector<FoxgloveChannel> ChannelsFor(const TypeInfo& type, std::string_view topic, const JsonLimits& limits) {
  std::vector<FoxgloveChannel> channels;
  if (!type.is_transparent()) return channels;
  channels.push_back(PlainChannel(type, topic, limits));
  for (const Drawing* drawing : kDrawings) {
    if (drawing->tag != type.semantic_tag() || !drawing->fits(type)) continue;
    channels.push_back(DrawnChannel(*drawing, type, std::string(topic) + "/foxglove"));
  }
  return channels;
}

Result<void> SetFromMessage(const TypeInfo& type, std::string_view json, void* value) {
  const auto message = JsonPart::Parse(json);
  if (!message) return message.error();
  if (type.kind() == TypeKind::kStructure) return SetFromJson(type, *message, value);
  JsonMembers members(*message);
  const JsonPart* const wrapped = members.Find("value");
  return SetFromJson(type, wrapped != nullptr ? *wrapped : *message, value);
}

std::optional<FoxgloveChannel> TransformChannelFor(const TypeInfo& type) {
  const Drawing& drawing = internal::kTransformDrawing;
  if (drawing.tag != type.semantic_tag() || !drawing.fits(type)) return std::nullopt;
  return DrawnChannel(drawing, type, "/tf");
}

FoxgloveChannel LogChannel() {
  return {"/log", "foxglove.Log", internal::FoxgloveSchema("Log"),
          [](const void* value, Time timestamp, std::string& json) {
            AppendLog(*static_cast<const LogMessage*>(value), timestamp, json);
          }};
}

}  // namespace runnel
