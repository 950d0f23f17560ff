#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/types/type_info.h"
#include "plugins/json_values/internal/leaf_kind.h"
#include "plugins/json_values/json_values.h"
#include "plugins/json_values/json_writer.h"

namespace runnel {

namespace {

std::string DescriptionOf(const FieldInfo& field) {
  if (field.unit.empty()) return field.description;
  return field.description + (field.description.empty() ? "" : " ") + "[" + field.unit + "]";
}

class SchemaWriter {
 public:
  explicit SchemaWriter(std::string& json) : json_(json) {}

  void Write(const TypeInfo& type, const std::string& description) {
    JsonObject schema(json_);
    if (!description.empty()) schema.Add("description", description);
    switch (type.kind()) {
      case TypeKind::kOpaque:
        schema.Add("type", "null");
        return;
      case TypeKind::kLeaf:
        return WriteLeaf(KindOfLeaf(type), type, schema);
      case TypeKind::kEnumeration:
        return WriteEnumeration(type, schema);
      case TypeKind::kStructure:
        return WriteStructure(type, schema);
      case TypeKind::kSequence:
        return WriteSequence(type, schema);
      case TypeKind::kMatrix:
        return WriteMatrix(type, schema);
    }
  }

 private:
  template <typename N>
  static void WriteRange(JsonObject& schema) {
    schema.Add("type", "integer");
    schema.Add("minimum", std::numeric_limits<N>::lowest());
    schema.Add("maximum", std::numeric_limits<N>::max());
  }

  void WriteLeaf(LeafKind kind, const TypeInfo& type, JsonObject& schema) {
    switch (kind) {
      case LeafKind::kBool:
        return schema.Add("type", "boolean");
      case LeafKind::kInt8:
        return WriteRange<std::int8_t>(schema);
      case LeafKind::kInt16:
        return WriteRange<std::int16_t>(schema);
      case LeafKind::kInt32:
        return WriteRange<std::int32_t>(schema);
      case LeafKind::kUint8:
        return WriteRange<std::uint8_t>(schema);
      case LeafKind::kUint16:
        return WriteRange<std::uint16_t>(schema);
      case LeafKind::kUint32:
        return WriteRange<std::uint32_t>(schema);
      case LeafKind::kUint64:
        schema.Add("type", "integer");
        return schema.Add("minimum", 0);
      case LeafKind::kInt64:
        return schema.Add("type", "integer");
      case LeafKind::kFloat:
      case LeafKind::kDouble:
        schema.Add("type", "number");
        return schema.Add("nullable", true);
      case LeafKind::kDuration:
      case LeafKind::kTime:
        return WriteSeconds(type, schema);
      case LeafKind::kString:
      case LeafKind::kOther:
        return schema.Add("type", "string");
    }
  }

  // As viewers know times and durations, by their titles.
  static void WriteSeconds(const TypeInfo& type, JsonObject& schema) {
    schema.Add("type", "object");
    schema.Add("title", type.name());
    schema.AddJson("properties", R"({"sec":{"type":"integer"},)"
                                 R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}})");
    schema.AddJson("required", R"(["sec","nsec"])");
  }

  static void WriteEnumeration(const TypeInfo& type, JsonObject& schema) {
    schema.Add("type", "string");
    JsonArray names(schema.Key("enum"));
    for (const EnumeratorInfo& each : type.enumerators()) names.Add(each.name);
  }

  void WriteStructure(const TypeInfo& type, JsonObject& schema) {
    schema.Add("type", "object");
    schema.Add("title", type.name());
    const bool is_inside_itself = std::ranges::find(open_, &type) != open_.end();
    if (is_inside_itself) return schema.AddJson("properties", "{}");
    open_.push_back(&type);
    {
      JsonObject properties(schema.Key("properties"));
      for (const FieldInfo& field : type.fields()) {
        properties.Key(field.name);
        Write(*field.type, DescriptionOf(field));
      }
    }
    JsonArray required(schema.Key("required"));
    for (const FieldInfo& field : type.fields()) required.Add(field.name);
    open_.pop_back();
  }

  void WriteSequence(const TypeInfo& type, JsonObject& schema) {
    schema.Add("type", "array");
    schema.Key("items");
    Write(*type.elements().type, "");
    if (!type.elements().is_fixed) return;
    // Only a value can tell how many there are; whoever has none, has no number either.
    const auto example = type.Make();
    if (!example) return;
    schema.Add("minItems", type.elements().columns(example.get()));
    schema.Add("maxItems", type.elements().columns(example.get()));
  }

  void WriteMatrix(const TypeInfo& type, JsonObject& schema) {
    schema.Add("type", "array");
    JsonObject rows(schema.Key("items"));
    rows.Add("type", "array");
    rows.Key("items");
    Write(*type.elements().type, "");
  }

  std::string& json_;
  std::vector<const TypeInfo*> open_;
};

}  // namespace

std::string JsonSchemaOf(const TypeInfo& type) {
  std::string json;
  SchemaWriter(json).Write(type, "");
  return json;
}

}  // namespace runnel
