#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/clock.h"
#include "core/types/type_builder.h"

namespace runnel {

/// That something has happened: a value without content, of which only counts that it came, and when. Anything
/// can be connected to an input of signals.
struct Signal {
  friend bool operator==(const Signal&, const Signal&) = default;
};

void Describe(TypeBuilder<Signal>& type);

/// The types that need no description by anybody else. Duration reads and writes "20ms", a Time is
/// the duration since its clock's start. Lists are called after their elements: "double[]",
/// "Pose2[3]", "Point2?".
void Describe(TypeBuilder<bool>& type);
void Describe(TypeBuilder<std::int8_t>& type);
void Describe(TypeBuilder<std::int16_t>& type);
void Describe(TypeBuilder<std::int32_t>& type);
void Describe(TypeBuilder<std::int64_t>& type);
void Describe(TypeBuilder<std::uint8_t>& type);
void Describe(TypeBuilder<std::uint16_t>& type);
void Describe(TypeBuilder<std::uint32_t>& type);
void Describe(TypeBuilder<std::uint64_t>& type);
void Describe(TypeBuilder<float>& type);
void Describe(TypeBuilder<double>& type);
void Describe(TypeBuilder<std::string>& type);
void Describe(TypeBuilder<Duration>& type);
void Describe(TypeBuilder<Time>& type);

/// What ElementOperations::are_plain_numbers is about.
template <typename E>
inline constexpr bool kIsPlainNumber = std::is_arithmetic_v<E> && !std::same_as<E, bool>;

/// Vectors of bool have no elements that could be pointed at.
template <typename E>
requires(!std::same_as<E, bool>) void Describe(TypeBuilder<std::vector<E>>& type) {
  using List = std::vector<E>;
  type.Name(TypeOf<E>().name() + "[]")
      .Elements(TypeKind::kSequence,
                {.type = &TypeOf<E>(),
                 .columns = [](const void* at) { return static_cast<const List*>(at)->size(); },
                 .resize =
                     [](void* at, std::size_t, std::size_t columns) {
                       if constexpr (std::default_initializable<E>) {
                         static_cast<List*>(at)->resize(columns);
                         return true;
                       } else {
                         return columns == static_cast<List*>(at)->size();
                       }
                     },
                 .element = [](void* at, std::size_t index) -> void* { return &(*static_cast<List*>(at))[index]; },
                 .are_plain_numbers = kIsPlainNumber<E>});
}

template <typename E, std::size_t count>
void Describe(TypeBuilder<std::array<E, count>>& type) {
  using List = std::array<E, count>;
  type.Name(TypeOf<E>().name() + "[" + std::to_string(count) + "]")
      .Elements(TypeKind::kSequence,
                {.type = &TypeOf<E>(),
                 .is_fixed = true,
                 .columns = [](const void*) { return count; },
                 .resize = [](void*, std::size_t, std::size_t columns) { return columns == count; },
                 .element = [](void* at, std::size_t index) -> void* { return &(*static_cast<List*>(at))[index]; },
                 .are_plain_numbers = kIsPlainNumber<E>});
}

/// As a list of one element or none: "[]", "[{x: 1, y: 2}]".
template <typename E>
void Describe(TypeBuilder<std::optional<E>>& type) {
  using Optional = std::optional<E>;
  type.Name(TypeOf<E>().name() + "?")
      .Elements(TypeKind::kSequence,
                {.type = &TypeOf<E>(),
                 .columns = [](const void* at) -> std::size_t {
                   return static_cast<const Optional*>(at)->has_value() ? 1 : 0;
                 },
                 .resize =
                     [](void* at, std::size_t, std::size_t columns) {
                       auto& optional = *static_cast<Optional*>(at);
                       if (columns == 0) optional.reset();
                       if (columns == 1 && !optional) optional.emplace();
                       return columns <= 1;
                     },
                 .element = [](void* at, std::size_t) -> void* { return &**static_cast<Optional*>(at); }});
}

}  // namespace runnel
