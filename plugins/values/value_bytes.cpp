#include "plugins/values/value_bytes.h"

#include <algorithm>
#include <string>

#include "core/types/builtin_types.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

constexpr std::string_view kBase64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

void AppendBase64(std::string_view bytes, std::string& text) {
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += kBase64Digits[three >> 18 & 63];
    text += kBase64Digits[three >> 12 & 63];
    text += i + 1 < bytes.size() ? kBase64Digits[three >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? kBase64Digits[three & 63] : '=';
  }
}

void AppendBase64(const TypeInfo& list, const void* value, std::string& json) {
  const ElementOperations& elements = list.elements();
  const std::size_t count = elements.columns(value);
  const auto at = [&](std::size_t index) {
    return static_cast<const char*>(elements.element(ForLooking(value), index));
  };
  json += '"';
  if (count > 0 && elements.are_plain_numbers) {
    AppendBase64({at(0), count}, json);
  } else {
    std::string bytes;
    for (std::size_t i = 0; i < count; ++i) bytes += *at(i);
    AppendBase64(bytes, json);
  }
  json += '"';
}

std::optional<std::string> FromBase64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char character : text) {
    const std::size_t digit = kBase64Digits.find(character);
    if (digit == std::string_view::npos) return std::nullopt;
    bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

namespace {

bool IsTold(const TypeInfo& type) { return type.kind() == TypeKind::kLeaf || type.kind() == TypeKind::kEnumeration; }

// Whether values of the type may differ in their bytes. A type can contain itself only in lists, where this ends.
bool Varies(const TypeInfo& type) {
  switch (type.kind()) {
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return !type.elements().is_fixed || Varies(*type.elements().type);
    case TypeKind::kStructure:
      return std::ranges::any_of(type.fields(), [](const FieldInfo& field) { return Varies(*field.type); });
    default:
      return &type == &TypeOf<std::string>();
  }
}

std::size_t BytesOfElements(const TypeInfo& type, const void* value) {
  const ElementOperations& elements = type.elements();
  const std::size_t count = elements.rows(value) * elements.columns(value);
  if (count == 0) return 0;
  if (IsTold(*elements.type) && elements.type != &TypeOf<std::string>()) {
    return count * elements.type->size();
  }
  const auto bytes_at = [&](std::size_t i) { return BytesOf(*elements.type, elements.element(ForLooking(value), i)); };
  if (!Varies(*elements.type)) return count * bytes_at(0);
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < count; ++i) bytes += bytes_at(i);
  return bytes;
}

}  // namespace

std::size_t BytesOf(const TypeInfo& type, const void* value) {
  if (&type == &TypeOf<std::string>()) return static_cast<const std::string*>(value)->size();
  switch (type.kind()) {
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return BytesOfElements(type, value);
    case TypeKind::kStructure: {
      std::size_t bytes = 0;
      for (const FieldInfo& field : type.fields()) {
        bytes += BytesOf(*field.type, field.address(ForLooking(value)));
      }
      return bytes;
    }
    default:
      return type.size();
  }
}

}  // namespace runnel
