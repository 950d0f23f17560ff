#include <algorithm>
#include <concepts>
#include <limits>
#include <vector>

#include "core/types/leaf_types.h"
#include "core/types/type_info.h"
#include "plugins/values/json_values.h"
#include "plugins/values/json_writer.h"

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
        return WriteLeaf(type, schema);
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
  static void WriteLeaf(const TypeInfo& type, JsonObject& schema) {
    WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
      if constexpr (std::same_as<T, bool>) {
        schema.Add("type", "boolean");
      } else if constexpr (std::integral<T>) {
        schema.Add("type", "integer");
        // The ends of 64 bits are no doubles, by which many readers compare.
        if constexpr (std::unsigned_integral<T>) schema.Add("minimum", 0);
        if constexpr (std::signed_integral<T> && sizeof(T) < 8) {
          schema.Add("minimum", std::numeric_limits<T>::lowest());
        }
        if constexpr (sizeof(T) < 8) schema.Add("maximum", std::numeric_limits<T>::max());
      } else if constexpr (std::floating_point<T>) {
        schema.Add("type", "number").Add("nullable", true);
      } else if constexpr (std::same_as<T, Duration> || std::same_as<T, Time>) {
        WriteSeconds(type, schema);
      } else {
        schema.Add("type", "string");
      }
    });
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
    schema.Add("type", "object").Add("title", type.name());
    const bool is_inside_itself = std::ranges::find(open_, &type) != open_.end();
    if (is_inside_itself) return (void)schema.AddJson("properties", "{}");
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
