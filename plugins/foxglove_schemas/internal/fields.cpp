#include "plugins/foxglove_schemas/internal/fields.h"

#include <array>
#include <utility>

#include "core/types/type_of.h"

namespace runnel::internal {

namespace {

template <typename N>
std::pair<const TypeInfo*, ReadNumber> Reader() {
  return {&TypeOf<N>(),
          [](const void* value) { return static_cast<double>(*static_cast<const N*>(value)); }};
}

}  // namespace

ReadNumber NumberReaderOf(const TypeInfo& type) {
  static const std::array kReaders = {Reader<double>(),        Reader<float>(),
                                      Reader<std::int8_t>(),   Reader<std::int16_t>(),
                                      Reader<std::int32_t>(),  Reader<std::int64_t>(),
                                      Reader<std::uint8_t>(),  Reader<std::uint16_t>(),
                                      Reader<std::uint32_t>(), Reader<std::uint64_t>()};
  for (const auto& [known, reader] : kReaders) {
    if (known == &type) return reader;
  }
  return nullptr;
}

std::optional<NumberField> NumberField::Find(const TypeInfo& type, std::string_view name) {
  const FieldInfo* const field = type.FindField(name);
  if (field == nullptr) return std::nullopt;
  const ReadNumber read = NumberReaderOf(*field->type);
  if (read == nullptr) return std::nullopt;
  return NumberField(*field, read);
}

std::optional<PlaceReader> PlaceReader::For(const TypeInfo& type) {
  const auto x = NumberField::Find(type, "x"), y = NumberField::Find(type, "y");
  if (!x || !y) return std::nullopt;
  return PlaceReader(*x, *y, NumberField::Find(type, "z"));
}

std::optional<PoseReader> PoseReader::For(const TypeInfo& type) {
  const auto place = PlaceReader::For(type);
  const auto heading = NumberField::Find(type, "heading");
  if (!place || !heading) return std::nullopt;
  return PoseReader(*place, *heading);
}

std::optional<ListField> ListField::Find(const TypeInfo& type, std::string_view name) {
  const FieldInfo* const field = type.FindField(name);
  if (field == nullptr || field->type->kind() != TypeKind::kSequence) return std::nullopt;
  return ListField(*field);
}

std::optional<PlacesField> PlacesField::Find(const TypeInfo& type, std::string_view name) {
  const auto list = ListField::Find(type, name);
  if (!list) return std::nullopt;
  const auto place = PlaceReader::For(list->element_type());
  if (!place) return std::nullopt;
  return PlacesField(*list, *place);
}

}  // namespace runnel::internal
