#pragma once

#include <cstddef>

namespace runnel {

class TypeInfo;

/// How many bytes a value has, an object of the type: its fields, and the elements of its lists and the letters of its
/// texts instead of what keeps them; without gaps between fields. What an opaque type has is its size.
///
/// Threads:  as for the object. Allocates nothing; lists are walked through only where their elements have lists.
[[nodiscard]] std::size_t BytesOf(const TypeInfo& type, const void* value);

}  // namespace runnel
