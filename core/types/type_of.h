#pragma once

#include <atomic>
#include <cstddef>

#include "core/types/builtin_types.h"
#include "core/types/text_format.h"
#include "core/types/type_builder.h"
#include "core/types/type_info.h"

namespace runnel {

namespace internal {

template <typename T>
concept Described = requires(TypeBuilder<T>& builder) {
  Describe(builder);
};

/// How the code that asks was compiled.
struct TypeLayout {
  std::size_t size;
  std::size_t alignment;
};

/// TypeRegistry::Get(), without its header.
const TypeInfo& GetType(std::type_index cpp_type, const TypeLayout& layout, void (*describe)(TypeInfo&));

}  // namespace internal

/// The description of T, one and the same in all libraries of the process.
///
/// Threads:     any; the first call for a type locks and allocates, later ones do not.
/// Errors:      throws ProgrammingError if two types claim one name, or if a library knows another
///              layout or description of T than the one that asked first.
template <typename T>
[[gnu::visibility("hidden")]] const TypeInfo& TypeOf() {
  static_assert(internal::Described<T>,
                "this type has no description here: include the header that has it, or write `inline void "
                "Describe(runnel::TypeBuilder<T>& type) { type.Name(\"T\"); }` beside the type");
  // Not a static reference: its initialisation would wait for itself in a type that contains lists
  // of itself. release/acquire: who sees the pointer sees the description.
  static constinit std::atomic<const TypeInfo*> known{nullptr};
  if (const TypeInfo* type = known.load(std::memory_order_acquire)) return *type;
  const TypeInfo& type = internal::GetType(typeid(T), {sizeof(T), alignof(T)}, [](TypeInfo& info) {
    TypeBuilder<T> builder(info);
    Describe(builder);
  });
  if (type.is_complete()) known.store(&type, std::memory_order_release);
  return type;
}

/// The text format: "0.25", "left", "{x: 1, y: 2}", "[1, 2, 3]". A string stands for itself.
template <typename T>
[[nodiscard]] std::string TextOf(const T& value) {
  return ToText(TypeOf<T>(), &value);
}
/// The value of a text format. Fields that a structure's text leaves out are as T{} has them.
template <typename T>
[[nodiscard]] Result<T> FromText(std::string_view text) {
  T value{};
  if (auto read = SetFromText(TypeOf<T>(), text, &value); !read) return read.error();
  return value;
}

}  // namespace runnel
