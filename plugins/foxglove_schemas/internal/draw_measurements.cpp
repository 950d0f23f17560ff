#include "core/types/type_of.h"
#include "plugins/foxglove_schemas/internal/drawing.h"
#include "plugins/foxglove_schemas/internal/fields.h"
#include "plugins/foxglove_schemas/internal/message_parts.h"
#include "plugins/foxglove_schemas/internal/schema_texts.h"
#include "plugins/json_values/base64.h"
#include "plugins/json_values/json_values.h"

namespace runnel::internal {

namespace {

// Pixels lie one behind the other in all lists that anybody uses for them; the others are copied.
void AppendBytes(const ListField& list, const void* structure, std::string& json) {
  const std::size_t count = list.Size(structure);
  json += '"';
  if (count > 0) {
    const auto* const first = static_cast<const char*>(list.At(structure, 0));
    const auto* const last = static_cast<const char*>(list.At(structure, count - 1));
    if (last == first + count - 1) {
      AppendBase64({first, count}, json);
    } else {
      std::string bytes;
      for (std::size_t i = 0; i < count; ++i) {
        bytes += *static_cast<const char*>(list.At(structure, i));
      }
      AppendBase64(bytes, json);
    }
  }
  json += '"';
}

struct ImageFields {
  NumberField width, height, stride;
  const FieldInfo* encoding;
  ListField data;
};

std::optional<ImageFields> FindImage(const TypeInfo& type) {
  const auto width = NumberField::Find(type, "width"), height = NumberField::Find(type, "height");
  const auto stride = NumberField::Find(type, "row_stride");
  const FieldInfo* const encoding = type.FindField("encoding");
  const auto data = ListField::Find(type, "data");
  if (!width || !height || !stride || !data) return std::nullopt;
  if (encoding == nullptr || encoding->type != &TypeOf<std::string>()) return std::nullopt;
  if (&data->element_type() != &TypeOf<std::uint8_t>()) return std::nullopt;
  return ImageFields{*width, *height, *stride, encoding, *data};
}

}  // namespace

std::optional<Drawing> DrawRangeScan(const TypeInfo& type, const FoxgloveOptions& options) {
  const auto start = NumberField::Find(type, "start_angle");
  const auto step = NumberField::Find(type, "angle_step");
  const auto ranges = ListField::Find(type, "ranges");
  if (!start || !step || !ranges) return std::nullopt;
  const ReadNumber range = NumberReaderOf(ranges->element_type());
  if (range == nullptr) return std::nullopt;
  const FieldInfo* const list = type.FindField("ranges");
  return Drawing{"foxglove.LaserScan", LaserScanSchema(),
                 [start = *start, step = *step, ranges = *ranges, list, frame = options.body_frame](
                     const void* value, Time timestamp, std::string& json) {
                   const double first = start.Get(value), each = step.Get(value);
                   const std::size_t count = ranges.Size(value);
                   JsonObject message(json);
                   AppendTime(timestamp, message.Key("timestamp"));
                   message.Add("frame_id", frame);
                   AppendPose({}, message.Key("pose"));
                   message.Add("start_angle", first);
                   message.Add("end_angle",
                               first + each * (count > 0 ? static_cast<double>(count - 1) : 0.0));
                   // As they are: what has met nothing is infinitely far, and not drawn.
                   AppendJson(*list->type, list->address(ForLooking(value)), message.Key("ranges"));
                   message.AddJson("intensities", "[]");
                 }};
}

std::optional<Drawing> DrawImage(const TypeInfo& type, const FoxgloveOptions& options) {
  const auto fields = FindImage(type);
  if (!fields) return std::nullopt;
  return Drawing{"foxglove.RawImage", RawImageSchema(),
                 [fields = *fields, frame = options.body_frame](const void* value, Time timestamp,
                                                                std::string& json) {
                   const auto count = [&](const NumberField& field) {
                     return static_cast<std::uint32_t>(field.Get(value));
                   };
                   JsonObject message(json);
                   AppendTime(timestamp, message.Key("timestamp"));
                   message.Add("frame_id", frame);
                   message.Add("width", count(fields.width));
                   message.Add("height", count(fields.height));
                   message.Add("encoding", *static_cast<const std::string*>(
                                               fields.encoding->address(ForLooking(value))));
                   message.Add("step", count(fields.stride));
                   AppendBytes(fields.data, value, message.Key("data"));
                 }};
}

}  // namespace runnel::internal
