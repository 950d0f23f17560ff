#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/types/type_info.h"

namespace runnel::internal {

/// What a description gives is a way to write; those who only look say so by this.
[[nodiscard]] inline void* ForLooking(const void* value) { return const_cast<void*>(value); }

/// How a number of a type is read as a double; nullptr if values of the type are no numbers.
using ReadNumber = double (*)(const void* value);
[[nodiscard]] ReadNumber NumberReaderOf(const TypeInfo& type);

/// A number in a structure, by the name of its field.
class NumberField {
 public:
  [[nodiscard]] static std::optional<NumberField> Find(const TypeInfo& type, std::string_view name);
  [[nodiscard]] double Get(const void* structure) const {
    return read_(field_->address(ForLooking(structure)));
  }

 private:
  NumberField(const FieldInfo& field, ReadNumber read) : field_(&field), read_(read) {}
  const FieldInfo* field_;
  ReadNumber read_;
};

struct Place {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// Anything with x and y, and perhaps z.
class PlaceReader {
 public:
  [[nodiscard]] static std::optional<PlaceReader> For(const TypeInfo& type);
  [[nodiscard]] Place Get(const void* structure) const {
    return {x_.Get(structure), y_.Get(structure), z_ ? z_->Get(structure) : 0.0};
  }

 private:
  PlaceReader(NumberField x, NumberField y, std::optional<NumberField> z) : x_(x), y_(y), z_(z) {}
  NumberField x_, y_;
  std::optional<NumberField> z_;
};

struct PlaceAndHeading {
  Place place;
  double heading = 0;  // rad
};

/// A place with a heading.
class PoseReader {
 public:
  [[nodiscard]] static std::optional<PoseReader> For(const TypeInfo& type);
  [[nodiscard]] PlaceAndHeading Get(const void* structure) const {
    return {place_.Get(structure), heading_.Get(structure)};
  }

 private:
  PoseReader(PlaceReader place, NumberField heading) : place_(place), heading_(heading) {}
  PlaceReader place_;
  NumberField heading_;
};

/// A list in a structure, by the name of its field.
class ListField {
 public:
  [[nodiscard]] static std::optional<ListField> Find(const TypeInfo& type, std::string_view name);
  [[nodiscard]] const TypeInfo& element_type() const { return *field_->type->elements().type; }
  [[nodiscard]] std::size_t Size(const void* structure) const {
    return field_->type->elements().columns(List(structure));
  }
  [[nodiscard]] const void* At(const void* structure, std::size_t index) const {
    return field_->type->elements().element(List(structure), index);
  }

 private:
  explicit ListField(const FieldInfo& field) : field_(&field) {}
  [[nodiscard]] void* List(const void* structure) const {
    return field_->address(ForLooking(structure));
  }
  const FieldInfo* field_;
};

/// A list of places in a structure.
class PlacesField {
 public:
  [[nodiscard]] static std::optional<PlacesField> Find(const TypeInfo& type, std::string_view name);
  [[nodiscard]] std::size_t Size(const void* structure) const { return list_.Size(structure); }
  [[nodiscard]] Place At(const void* structure, std::size_t index) const {
    return place_.Get(list_.At(structure, index));
  }

 private:
  PlacesField(ListField list, PlaceReader place) : list_(list), place_(place) {}
  ListField list_;
  PlaceReader place_;
};

}  // namespace runnel::internal
